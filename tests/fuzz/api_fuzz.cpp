// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any bytes through the C interface of a host with limits and little memory: what opens, takes what
// was announced, plays, and gives everything back. The last bytes decide what is done with it, and
// whether checksums are repaired first.
#include "tests/fuzz/fuzz_asset.h"
#include "tests/fuzz/fuzz_drawing.h"

#include <algorithm>

using namespace anicodec;

namespace {

/// Opens through a callback.
anic_status open_reader(const Bytes& file, const anic_options& options, anic_asset** out,
                        anic_failure* failure) {
  anic_reader reader = {};
  reader.user = const_cast<Bytes*>(&file);
  reader.read = [](void* user, uint64_t offset, void* to, size_t size) {
    const auto& bytes = *static_cast<const Bytes*>(user);
    require(size > 0 && offset <= bytes.size() && size <= bytes.size() - offset);
    std::copy_n(bytes.data() + offset, size, static_cast<uint8_t*>(to));
    return 0;
  };
  return anic_open_asset_from_reader(&reader, file.size(), &options, out, failure);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Script script = script_of(data, size);
  const uint32_t mode = script.byte();
  const Bytes file = mode % 8 == 7 ? Bytes(data, data + size) : repaired({data, size});
  CappedMemory memory;
  anic_options options = memory.options();
  options.quality = mode % 4 == 2 ? 0.5 : 0;
  options.flags = mode % 4 == 1 ? ANIC_OPEN_BOUNDS : 0;
  if (options.flags)
    options.max_frames = 50;  // bounds cost playing all of them
  if (mode % 8 >= 4)
    options.flags |= ANIC_OPEN_IN_PLACE;
  if (mode % 16 >= 8)
    options.flags |= ANIC_OPEN_INEXACT;

  anic_requirements needs = ANIC_INIT(anic_requirements);
  const anic_status query = anic_get_requirements(file.data(), file.size(), &options, &needs);
  anic_requirements of_prefix = ANIC_INIT(anic_requirements);
  const anic_status early = anic_get_requirements(
      file.data(), script.below(static_cast<uint32_t>(file.size()) + 1), &options, &of_prefix);
  require(early != ANIC_E_INTERNAL);
  require(memory.held == 0);
  memory.peak = 0;
  anic_asset* asset = nullptr;
  anic_failure failure = ANIC_INIT(anic_failure);
  const bool by_reader = mode % 4 == 3;
  const size_t most_heap = announced_heap(file, options);
  anic_status status;
  {
    const HeapCount heap;
    status = by_reader ? open_reader(file, options, &asset, &failure)
                       : anic_open_asset(file.data(), file.size(), &options, &asset, &failure);
    require(heap.peak() <= most_heap);
  }
  require(failure.status == status && (asset != nullptr) == (status == ANIC_OK));
  require(status != ANIC_E_INTERNAL && status != ANIC_E_MEMORY);
  require(query == ANIC_OK || status != ANIC_OK);
  if (query == ANIC_OK)
    require(memory.peak <= needs.opening_bytes + (by_reader ? file.size() : 0));
  if (asset) {
    require(memory.held <= needs.resident_bytes + needs.resident_bytes / 20 + 4096);
    const anic_status verified = anic_verify_asset(asset);
    require(verified == ANIC_OK || verified == ANIC_E_HASH || verified == ANIC_E_STATE);
    sample(asset, &memory, script);
    look(asset, script);
    draw(asset, script);
  }
  anic_close_asset(asset);
  require(memory.held == 0);
  read_unopened(file, script);
  return 0;
}
