// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/render/video.h"

#include "codec/sequence/error.h"
#include "tools/io/files/private_folder.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace anicodec::tools {
std::string mp4_bytes(const std::vector<Image>& images, double frames_per_second) {
  if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0)
    throw Error(ErrorKind::kUnsupported,
                ".mp4 needs the ffmpeg command, which is not there; .gif and .png do not");
  const PrivateFolder folder;
  const std::string output = folder / "clip.mp4";
  // H.264 wants even sizes.
  const std::string command = fmt::format(
      "ffmpeg -loglevel error -f rawvideo -pixel_format rgb24 -video_size {}x{} -framerate {:.6f} "
      "-i - -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p -movflags +faststart '{}'",
      images.at(0).width, images[0].height, frames_per_second, output);
  const auto handler = std::signal(SIGPIPE, SIG_IGN);  // ffmpeg's exit status tells
  std::FILE* pipe = popen(command.c_str(), "w");
  if (pipe == nullptr)
    throw Error(ErrorKind::kInternal, "ffmpeg cannot be started");
  for (const Image& image : images)
    std::fwrite(image.rgb.data(), 1, image.rgb.size(), pipe);
  const int status = pclose(pipe);
  std::signal(SIGPIPE, handler);
  if (status != 0)
    throw Error(ErrorKind::kInternal, "ffmpeg has failed");
  std::ifstream file(output, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace anicodec::tools
