// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any bytes as a stream, in pieces of any size: it fails or becomes what the whole file is, and
// what is playable before that, plays.
#include "tests/fuzz/fuzz_asset.h"

using namespace anicodec;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Script script = script_of(data, size);
  const Bytes file = script.byte() % 8 == 7 ? Bytes(data, data + size) : repaired({data, size});
  CappedMemory memory, whole_memory;
  const anic_options options = memory.options(), whole_options = whole_memory.options();
  anic_asset* whole = nullptr;
  const anic_status expected =
      anic_open_asset(file.data(), file.size(), &whole_options, &whole, nullptr);
  anic_close_asset(whole);

  anic_stream* stream = nullptr;
  require(anic_create_stream(&options, &stream) == ANIC_OK);
  anic_stream_info info = ANIC_INIT(anic_stream_info);
  int opened = 0;
  for (size_t at = 0; at < file.size();) {
    const size_t piece = std::min<size_t>(1 + script.below(2048), file.size() - at);
    const anic_status status = anic_push_bytes(stream, file.data() + at, piece);
    at += piece;
    const uint32_t before = info.arrived_layers;
    anic_get_stream_info(stream, &info);
    if (status != ANIC_OK) {
      require(expected != ANIC_OK);
      break;
    }
    require(info.received_bytes == at && info.arrived_layers >= before);
    if (!info.playable || (opened >= 4 && !info.complete))
      continue;
    ++opened;
    anic_asset* asset = nullptr;
    anic_failure failure = ANIC_INIT(anic_failure);
    const size_t most_heap = announced_heap(file, options);
    anic_status open;
    {
      const HeapCount heap;
      open = anic_open_asset_from_stream(stream, &asset, &failure);
      require(heap.peak() <= most_heap);
    }
    require(open != ANIC_E_INTERNAL && open != ANIC_E_MEMORY);
    if (info.complete)
      require(open == expected);
    if (asset)
      sample(asset, &memory, script);
    anic_close_asset(asset);
  }
  if (expected == ANIC_OK)
    require(info.complete);
  anic_destroy_stream(stream);
  require(memory.held == 0 && whole_memory.held == 0);
  return 0;
}
