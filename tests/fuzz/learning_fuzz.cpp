// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Files of a live stream that are lost, come twice or in another order, any of their bytes changed: each opens or is
// refused, and one that opens plays as it did before.
#include "tests/fuzz/fuzz_asset.h"

#include <algorithm>
#include <vector>

using namespace anicodec;

namespace {

constexpr size_t kMostFiles = 8, kMostOpenings = 16;

/// The files that a stream is cut into by what their headers say, made right.
std::vector<Bytes> files_of(ByteView stream) {
  std::vector<Bytes> files;
  while (stream.size >= kHeaderBytes && files.size() < kMostFiles) {
    ByteReader header({stream.data + 24, 8});
    const auto size = static_cast<size_t>(std::min<uint64_t>(header.u64(), stream.size));
    const size_t taken = std::max(size, kHeaderBytes);
    files.push_back(repaired({stream.data, taken}));
    stream = {stream.data + taken, stream.size - taken};
  }
  return files;
}

/// Bits of the positions in frame 0; none where the first mesh is not there.
Bytes first_frame(const anic_asset* asset) {
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  require(anic_get_mesh(asset, 0, &mesh) == ANIC_OK);
  Bytes positions(size_t{12} * mesh.vertex_count);
  anic_output out = ANIC_INIT(anic_output);
  out.data = positions.data();
  out.size = positions.size();
  const uint32_t first = 0;
  if (anic_write_frames(asset, 0, &first, 1, 0, mesh.vertex_count, &out) != ANIC_OK)
    positions.clear();
  return positions;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Script script = script_of(data, size);
  const std::vector<Bytes> files = files_of({data, size});
  CappedMemory memory;
  const anic_options options = memory.options();
  anic_stream* stream = nullptr;
  require(anic_create_stream(&options, &stream) == ANIC_OK);
  anic_status status = ANIC_OK;
  size_t next = 0;
  for (size_t i = 0; i < kMostOpenings && status == ANIC_OK && !files.empty(); ++i) {
    // The next one as a rule.
    const size_t number =
        script.byte() % 4 == 0 ? script.below(static_cast<uint32_t>(files.size())) : next;
    next = (number + 1) % files.size();
    status = anic_push_bytes(stream, files[number].data(), files[number].size());
    anic_stream_info info = ANIC_INIT(anic_stream_info);
    anic_get_stream_info(stream, &info);
    if (status != ANIC_OK || !info.complete)
      break;
    Bytes seen;
    for (int again = 0; again < 2; ++again) {
      anic_asset* asset = nullptr;
      const anic_status opened = anic_open_asset_from_stream(stream, &asset, nullptr);
      require(opened != ANIC_E_INTERNAL);
      if (asset && again == 0)
        seen = first_frame(asset);
      else if (asset)
        require(first_frame(asset) == seen);
      require((asset != nullptr) == (opened == ANIC_OK));
      anic_close_asset(asset);
    }
    status = anic_advance_stream(stream);
  }
  anic_destroy_stream(stream);
  require(memory.held == 0);
  return 0;
}
