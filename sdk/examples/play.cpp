// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Plays a clip there and back, its positions in 16 bits within the clip's bounds, in ranges that
// could be jobs.
#include <anicodec/anicodec.hpp>

#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

struct File {
  explicit File(const char* path) : handle(std::fopen(path, "rb")) {}

  ~File() {
    if (handle)
      std::fclose(handle);
  }

  uint64_t size() const {
    std::fseek(handle, 0, SEEK_END);
    return static_cast<uint64_t>(std::ftell(handle));
  }

  bool operator()(uint64_t offset, void* to, size_t count) const {
    return std::fseek(handle, static_cast<long>(offset), SEEK_SET) == 0 &&
           std::fread(to, 1, count, handle) == count;
  }

  std::FILE* handle;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: play CLIP.anic\n");
    return 1;
  }
  const File file(argv[1]);
  anic_options options = ANIC_INIT(anic_options);
  options.flags = ANIC_OPEN_BOUNDS;
  anic_failure failure = ANIC_INIT(anic_failure);
  anic::Asset clip;
  if (!file.handle || !clip.open(file.size(), file, &options, &failure)) {
    std::fprintf(stderr, "%s: %s\n", argv[1], anic_get_status_text(failure.status));
    return 1;
  }
  anic::Context context;
  anic_box bounds;
  if (!context.create(clip) || !clip.bounds(&bounds))
    return 1;

  const uint32_t vertices = clip.mesh().vertex_count;
  std::vector<uint32_t> indices(size_t{3} * clip.mesh().triangle_count);
  if (anic::Status status = clip.write_indices<uint32_t>(indices); !status) {
    std::fprintf(stderr, "triangles: %s\n", status.text());
    return 1;
  }
  std::vector<uint16_t> points(size_t{4} * vertices);
  const anic_asset_info info = clip.info();
  for (double t = 0; t < info.duration; t += 0.1) {
    if (!context.seek(t, ANIC_SAMPLE_CUBIC, ANIC_WRAP_PING_PONG))
      return 1;
    // Any thread may make any range; multiples of 16 are best.
    const uint32_t range = (vertices / 8 + 16) / 16 * 16;
    for (uint32_t first = 0; first < vertices; first += range) {
      const uint32_t count = vertices - first < range ? vertices - first : range;
      const anic_output out = anic::within(
          anic::output(&points[size_t{4} * first], size_t{8} * count, ANIC_FORMAT_UNORM16X4),
          bounds);
      if (anic::Status status = context.write_positions(out, first, count); !status) {
        std::fprintf(stderr, "%.2f s: %s\n", t, status.text());
        return 1;
      }
    }
    std::printf("%.2f s: vertex 0 at %u %u %u of 65535\n", t, unsigned{points[0]},
                unsigned{points[1]}, unsigned{points[2]});
  }
  return 0;
}
