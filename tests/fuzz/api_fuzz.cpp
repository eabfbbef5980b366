// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any bytes through the C interface of a host with limits and little memory: what opens, takes what
// was announced, plays, and gives everything back. The last bytes decide what is done with it, and
// whether checksums are repaired first.
#include "tests/fuzz/fuzz_asset.h"

using namespace anicodec;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Script script = script_of(data, size);
  const uint32_t mode = script.byte();
  const format::Bytes file =
      mode % 8 == 7 ? format::Bytes(data, data + size) : repaired({data, size});
  CappedMemory memory;
  anic_options options = memory.options();
  options.quality = mode % 4 == 2 ? 0.5 : 0;
  options.flags = mode % 4 == 1 ? ANIC_OPEN_BOUNDS : 0;
  if (options.flags)
    options.limits.frames = 50;  // bounds cost playing all of them

  anic_requirements needs;
  const anic_status query = anic_query(file.data(), file.size(), &options, &needs);
  require(memory.held == 0);
  memory.peak = 0;
  anic_asset* asset = nullptr;
  anic_failure failure;
  const anic_status status = anic_asset_open(file.data(), file.size(), &options, &asset, &failure);
  require(failure.status == status && (asset != nullptr) == (status == ANIC_OK));
  require(status != ANIC_E_INTERNAL && status != ANIC_E_MEMORY);
  require(query == ANIC_OK || status != ANIC_OK);
  if (query == ANIC_OK)
    require(memory.peak <= needs.opening_bytes);
  if (asset) {
    require(memory.held <= needs.resident_bytes + needs.resident_bytes / 20 + 4096);
    const anic_status verified = anic_asset_verify(asset);
    require(verified == ANIC_OK || verified == ANIC_E_HASH || verified == ANIC_E_STATE);
    sample(asset, &memory, script);
    look(asset, script);
  }
  anic_asset_close(asset);
  require(memory.held == 0);
  return 0;
}
