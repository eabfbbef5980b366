// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any bytes as the payload of one chunk in a file that is otherwise good: the first byte picks a
// file of tests/conformance, the second one of its chunks.
#include "tests/fuzz/fuzz_asset.h"
#include "tests/fuzz/fuzz_files.h"

using namespace anicodec;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 2)
    return 0;
  static const std::vector<FuzzFile> files = fuzz_files();
  const FuzzFile& good = files[data[0] % files.size()];
  FuzzParts changed = good;
  if (changed.parts.empty())
    return 0;
  changed.parts[data[1] % changed.parts.size()].payload.assign(data + 2, data + size);
  const Bytes file = changed.write();
  CappedMemory memory;
  const anic_options options = memory.options();
  anic_asset* asset = nullptr;
  const size_t most_heap = announced_heap(file, options);
  anic_status status;
  {
    const HeapCount heap;
    status = anic_open_asset(file.data(), file.size(), &options, &asset, nullptr);
    require(heap.peak() <= most_heap);
  }
  require(status != ANIC_E_INTERNAL && status != ANIC_E_MEMORY);
  if (asset) {
    const Script script = script_of(data, size);
    sample(asset, &memory, script);
    look(asset, script);
  }
  anic_close_asset(asset);
  require(memory.held == 0);
  return 0;
}
