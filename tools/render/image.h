// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_RENDER_IMAGE_H_
#define ANICODEC_TOOLS_RENDER_IMAGE_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace anicodec::tools {

/// 8-bit sRGB picture: height rows of width pixels of red, green, blue.
struct Image {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<uint8_t> rgb;

  Image() = default;

  Image(uint32_t w, uint32_t h) : width(w), height(h), rgb(size_t{3} * w * h) {}

  uint8_t* pixel(uint32_t x, uint32_t y) { return rgb.data() + 3 * (size_t{y} * width + x); }

  /// Copies `other`, which must fit, to column x, row y.
  void paste(const Image& other, uint32_t x, uint32_t y);
};

/// The bytes of a PNG file. Throws Error(kInternal).
std::string png_bytes(const Image& image);

/// The bytes of an animated GIF that repeats forever, in a fixed palette with ordered dither.
/// Images of one size; `delay`: hundredths of a second per image. Throws Error(kInternal).
std::string gif_bytes(const std::vector<Image>& images, uint16_t delay);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_RENDER_IMAGE_H_
