// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/data_texture.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <png.h>
#ifdef ANICODEC_TINYEXR
#include <tinyexr.h>
#endif

namespace anicodec::tools {
namespace {

constexpr double kPngSteps = 65535;
constexpr float kLargestHalf = 65504;
constexpr bool kLittleEndian = std::endian::native == std::endian::little;

[[noreturn]] void refuse(const std::string& reason) {
  throw Error(ErrorKind::kInput, "texture: " + reason);
}

void check_range(const DataTexture& texture, float least, float largest) {
  if (!std::ranges::all_of(texture.texels, [&](float x) { return x >= least && x <= largest; }))
    refuse("a number is not from " + std::to_string(least) + " to " + std::to_string(largest));
}

// libpng's simplified interface takes 16-bit numbers for premultiplied light, and changes them: rows go through its core,
// whose errors are jumps over frames without destructors.

using PngRows = std::vector<png_bytep>;

PngRows rows_of(std::vector<uint16_t>& texels, uint32_t width) {
  PngRows rows;
  for (size_t at = 0; at < texels.size(); at += size_t{4} * width)
    rows.push_back(reinterpret_cast<png_bytep>(&texels[at]));
  return rows;
}

bool write_rows(png_structp png, png_infop info, uint32_t width, PngRows& rows) {
  if (setjmp(png_jmpbuf(png)))
    return false;
  png_set_IHDR(png, info, width, static_cast<png_uint_32>(rows.size()), 16, PNG_COLOR_TYPE_RGBA,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if (kLittleEndian)
    png_set_swap(png);
  png_write_image(png, rows.data());
  png_write_end(png, info);
  return true;
}

bool read_header(png_structp png, png_infop info) {
  if (setjmp(png_jmpbuf(png)))
    return false;
  png_read_info(png, info);
  return png_get_bit_depth(png, info) == 16 &&
         png_get_color_type(png, info) == PNG_COLOR_TYPE_RGBA &&
         png_get_interlace_type(png, info) == PNG_INTERLACE_NONE;
}

bool read_rows(png_structp png, PngRows& rows) {
  if (setjmp(png_jmpbuf(png)))
    return false;
  if (kLittleEndian)
    png_set_swap(png);
  png_read_image(png, rows.data());
  return true;
}

[[noreturn]] void jump(png_structp png, png_const_charp /*text*/) {
  png_longjmp(png, 1);
}

void ignore(png_structp /*png*/, png_const_charp /*text*/) {}

std::string png16_bytes(const DataTexture& texture) {
  check_range(texture, 0, 1);
  std::vector<uint16_t> texels(texture.texels.size());
  std::ranges::transform(texture.texels, texels.begin(), [](float x) {
    return static_cast<uint16_t>(std::lround(static_cast<double>(x) * kPngSteps));
  });
  PngRows rows = rows_of(texels, texture.width);
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, jump, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  bool ok = info != nullptr;
  if (ok) {
    png_set_write_fn(
        png, &bytes,
        [](png_structp to, png_bytep data, size_t size) {
          static_cast<std::string*>(png_get_io_ptr(to))
              ->append(reinterpret_cast<const char*>(data), size);
        },
        nullptr);
    ok = write_rows(png, info, texture.width, rows);
  }
  png_destroy_write_struct(&png, &info);
  if (!ok)
    throw Error(ErrorKind::kInternal, "a PNG cannot be written");
  return bytes;
}

DataTexture read_png16(std::string_view bytes) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, jump, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  DataTexture texture;
  bool ok = info != nullptr;
  if (ok) {
    png_set_read_fn(png, &bytes, [](png_structp from, png_bytep data, size_t size) {
      auto* left = static_cast<std::string_view*>(png_get_io_ptr(from));
      if (left->size() < size)
        png_error(from, "the end");
      std::memcpy(data, left->data(), size);
      left->remove_prefix(size);
    });
    ok = read_header(png, info);
  }
  if (ok) {
    texture = DataTexture(png_get_image_width(png, info), png_get_image_height(png, info));
    std::vector<uint16_t> texels(texture.texels.size());
    PngRows rows = rows_of(texels, texture.width);
    ok = read_rows(png, rows);
    std::ranges::transform(texels, texture.texels.begin(),
                           [](uint16_t x) { return static_cast<float>(x / kPngSteps); });
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (!ok)
    refuse("is no PNG of four 16-bit numbers a texel");
  return texture;
}

#ifdef ANICODEC_TINYEXR

// The order that the format wants: channels by their names.
constexpr const char* kChannels[4] = {"A", "B", "G", "R"};
constexpr size_t kPlaces[4] = {3, 2, 1, 0};

struct ExrHeader : EXRHeader {
  ExrHeader() { InitEXRHeader(this); }

  ~ExrHeader() { FreeEXRHeader(this); }

  ExrHeader(const ExrHeader&) = delete;
  ExrHeader& operator=(const ExrHeader&) = delete;
};

struct ExrImage : EXRImage {
  ExrImage() { InitEXRImage(this); }

  ~ExrImage() { FreeEXRImage(this); }

  ExrImage(const ExrImage&) = delete;
  ExrImage& operator=(const ExrImage&) = delete;
};

std::string exr_bytes(const DataTexture& texture) {
  check_range(texture, -kLargestHalf, kLargestHalf);
  const size_t count = size_t{texture.width} * texture.height;
  std::vector<float> planes(texture.texels.size());
  unsigned char* starts[4];
  EXRChannelInfo channels[4] = {};
  int kinds[4], wanted[4];
  for (size_t c = 0; c < 4; ++c) {
    float* plane = planes.data() + c * count;
    for (size_t i = 0; i < count; ++i)
      plane[i] = texture.texels[4 * i + kPlaces[c]];
    starts[c] = reinterpret_cast<unsigned char*>(plane);
    std::strcpy(channels[c].name, kChannels[c]);
    kinds[c] = TINYEXR_PIXELTYPE_FLOAT;
    wanted[c] = TINYEXR_PIXELTYPE_HALF;
  }
  EXRHeader header;  // of arrays that are here
  InitEXRHeader(&header);
  header.num_channels = 4;
  header.channels = channels;
  header.pixel_types = kinds;
  header.requested_pixel_types = wanted;
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  EXRImage image;
  InitEXRImage(&image);
  image.num_channels = 4;
  image.images = starts;
  image.width = static_cast<int>(texture.width);
  image.height = static_cast<int>(texture.height);
  unsigned char* memory = nullptr;
  const char* reason = nullptr;
  const size_t size = SaveEXRImageToMemory(&image, &header, &memory, &reason);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owner(memory, &std::free);
  FreeEXRErrorMessage(reason);
  if (size == 0)
    throw Error(ErrorKind::kInternal, "an EXR cannot be written");
  return {reinterpret_cast<const char*>(memory), size};
}

DataTexture read_exr(std::string_view bytes) {
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  EXRVersion version;
  ExrHeader header;
  ExrImage image;
  const char* reason = nullptr;
  const auto ok = [&reason](int result) {
    FreeEXRErrorMessage(reason);
    reason = nullptr;
    return result == TINYEXR_SUCCESS;
  };
  if (!ok(ParseEXRVersionFromMemory(&version, data, bytes.size())) || version.multipart ||
      version.non_image ||
      !ok(ParseEXRHeaderFromMemory(&header, &version, data, bytes.size(), &reason)) ||
      header.num_channels != 4)
    refuse("is no EXR of four numbers a texel");
  for (int c = 0; c < 4; ++c)
    header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
  if (!ok(LoadEXRImageFromMemory(&image, &header, data, bytes.size(), &reason)) || !image.images)
    refuse("is a damaged EXR");
  DataTexture texture(static_cast<uint32_t>(image.width), static_cast<uint32_t>(image.height));
  for (size_t c = 0; c < 4; ++c) {
    const auto* plane = reinterpret_cast<const float*>(image.images[c]);
    for (size_t i = 0; 4 * i < texture.texels.size(); ++i)
      texture.texels[4 * i + kPlaces[c]] = plane[i];
  }
  return texture;
}

#else

std::string exr_bytes(const DataTexture&) {
  throw Error(ErrorKind::kUnsupported,
              "this build writes no EXR (it found no tinyexr): --image png");
}

DataTexture read_exr(std::string_view) {
  throw Error(ErrorKind::kUnsupported, "this build reads no EXR");
}

#endif

}  // namespace

std::string texture_bytes(const DataTexture& texture, TexelKind kind) {
  return kind == TexelKind::kPng16 ? png16_bytes(texture) : exr_bytes(texture);
}

DataTexture read_texture(std::string_view bytes, TexelKind kind) {
  return kind == TexelKind::kPng16 ? read_png16(bytes) : read_exr(bytes);
}

}  // namespace anicodec::tools
