// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any bytes as a stream, in pieces of any size: it fails or becomes what the whole file is, and
// what is playable before that, plays. A good container may be continued: what follows fails or plays, too.
#include "format/continuation.h"
#include "tests/fuzz/fuzz_asset.h"

using namespace anicodec;

namespace {

/// The file, and at times what continues it: itself without its meshes, itself, or both.
Bytes live_stream(const Bytes& file, Script& script) {
  Bytes all = file;
  ContainerReader reader;
  const uint32_t more = script.byte() % 8;
  if (more < 4 || !reader.open(file).ok())
    return all;
  const Bytes next = without_meshes(reader);
  if (more != 5)
    all.insert(all.end(), next.begin(), next.end());
  if (more >= 5)
    all.insert(all.end(), file.begin(), file.end());
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Script script = script_of(data, size);
  const Bytes file = script.byte() % 8 == 7 ? Bytes(data, data + size) : repaired({data, size});
  CappedMemory memory, whole_memory;
  const anic_options options = memory.options(), whole_options = whole_memory.options();
  anic_asset* whole = nullptr;
  const anic_status expected =
      anic_open_asset(file.data(), file.size(), &whole_options, &whole, nullptr);
  anic_close_asset(whole);

  const Bytes all = live_stream(file, script);
  anic_stream* stream = nullptr;
  require(anic_create_stream(&options, &stream) == ANIC_OK);
  anic_stream_info info = ANIC_INIT(anic_stream_info);
  anic_status status = ANIC_OK;
  int opened = 0;
  uint64_t before = 0;  // bytes of the files before the one at hand
  for (size_t at = 0; at < all.size() && status == ANIC_OK;) {
    const size_t piece = std::min<size_t>(1 + script.below(2048), all.size() - at);
    const uint32_t layers = info.arrived_layers;
    status = anic_push_bytes(stream, all.data() + at, piece);
    at += piece;
    anic_get_stream_info(stream, &info);
    require(info.arrived_layers >= layers);
    while (status == ANIC_OK) {
      require(before + info.received_bytes + info.waiting_bytes == at);
      if (info.playable && (opened < 4 || (info.complete && opened < 8))) {
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
        // Bytes behind the end of a file are the next one of the stream.
        if (info.complete && info.file_number == 0 && expected != ANIC_E_TRAILING_BYTES)
          require(open == expected);
        if (asset)
          sample(asset, &memory, script);
        anic_close_asset(asset);
      }
      if (!info.complete || info.waiting_bytes == 0)
        break;
      before += info.file_bytes;
      status = anic_advance_stream(stream);
      anic_get_stream_info(stream, &info);
    }
    require(status == ANIC_OK || info.file_number > 0 || expected != ANIC_OK);
  }
  if (expected == ANIC_OK)
    require(info.complete || info.file_number > 0);
  anic_destroy_stream(stream);
  require(memory.held == 0 && whole_memory.held == 0);
  return 0;
}
