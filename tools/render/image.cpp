// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/render/image.h"

#include "codec/sequence/error.h"

#include <algorithm>

#include <gif_lib.h>
#include <png.h>

namespace anicodec::tools {
namespace {

// Palette of the GIF: 6 x 7 x 6 levels of red, green, blue.
constexpr int kLevels[3] = {6, 7, 6};
constexpr int kBayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

GifByteType palette_index(const uint8_t* rgb, uint32_t x, uint32_t y) {
  const int threshold = 16 * kBayer[y % 4][x % 4] + 8;  // of 255
  int index = 0;
  for (int c = 0; c < 3; ++c) {
    const int scaled = rgb[c] * (kLevels[c] - 1);
    index = index * kLevels[c] + scaled / 255 + (scaled % 255 > threshold ? 1 : 0);
  }
  return static_cast<GifByteType>(index);
}

ColorMapObject* palette() {
  ColorMapObject* map = GifMakeMapObject(256, nullptr);
  if (map == nullptr)
    throw Error(ErrorKind::kInternal, "no memory for a picture");
  for (int i = 0; i < kLevels[0] * kLevels[1] * kLevels[2]; ++i) {
    const int levels[3] = {i / (kLevels[1] * kLevels[2]), i / kLevels[2] % kLevels[1],
                           i % kLevels[2]};
    auto value = [&](int c) {
      return static_cast<GifByteType>(255 * levels[c] / (kLevels[c] - 1));
    };
    map->Colors[i] = {value(0), value(1), value(2)};
  }
  return map;
}

void check(bool ok) {
  if (!ok)
    throw Error(ErrorKind::kInternal, "a GIF cannot be written");
}

}  // namespace

void Image::paste(const Image& other, uint32_t x, uint32_t y) {
  for (uint32_t row = 0; row < other.height; ++row)
    std::copy_n(other.rgb.data() + size_t{3} * other.width * row, size_t{3} * other.width,
                pixel(x, y + row));
}

std::string png_bytes(const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = image.width;
  header.height = image.height;
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  std::string bytes;
  if (png_image_write_get_memory_size(header, size, 0, image.rgb.data(), 0, nullptr) != 0) {
    bytes.resize(size);
    if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) !=
        0) {
      bytes.resize(size);
      return bytes;
    }
  }
  throw Error(ErrorKind::kInternal, std::string("a PNG cannot be written: ") + header.message);
}

std::string gif_bytes(const std::vector<Image>& images, uint16_t delay) {
  std::string bytes;
  int error = 0;
  GifFileType* gif = EGifOpen(
      &bytes,
      [](GifFileType* file, const GifByteType* data, int count) {
        static_cast<std::string*>(file->UserData)
            ->append(reinterpret_cast<const char*>(data), static_cast<size_t>(count));
        return count;
      },
      &error);
  check(gif != nullptr);
  EGifSetGifVersion(gif, true);
  const auto width = static_cast<int>(images.at(0).width);
  const auto height = static_cast<int>(images[0].height);
  ColorMapObject* map = palette();
  bool ok = EGifPutScreenDesc(gif, width, height, 8, 0, map) == GIF_OK;
  GifFreeMapObject(map);
  const GifByteType forever[3] = {1, 0, 0};
  ok = ok && EGifPutExtensionLeader(gif, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
       EGifPutExtensionBlock(gif, 11, "NETSCAPE2.0") == GIF_OK &&
       EGifPutExtensionBlock(gif, 3, forever) == GIF_OK && EGifPutExtensionTrailer(gif) == GIF_OK;
  std::vector<GifByteType> row(images[0].width);
  for (const Image& image : images) {
    const GifByteType control[4] = {4, static_cast<GifByteType>(delay & 255),
                                    static_cast<GifByteType>(delay >> 8), 0};
    ok = ok && EGifPutExtension(gif, GRAPHICS_EXT_FUNC_CODE, 4, control) == GIF_OK &&
         EGifPutImageDesc(gif, 0, 0, width, height, false, nullptr) == GIF_OK;
    for (uint32_t y = 0; ok && y < image.height; ++y) {
      for (uint32_t x = 0; x < image.width; ++x)
        row[x] = palette_index(image.rgb.data() + 3 * (size_t{y} * image.width + x), x, y);
      ok = EGifPutLine(gif, row.data(), width) == GIF_OK;
    }
  }
  ok = (EGifCloseFile(gif, &error) == GIF_OK) && ok;
  check(ok);
  return bytes;
}

}  // namespace anicodec::tools
