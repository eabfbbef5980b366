// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The SdfFileFormat of .anic. Built once for each release of OpenUSD; usd_loader.cpp chooses among them.
#include "bindings/usd/clip_layer.h"
#include "bindings/usd/layer_builder.h"
#include "bindings/usd/opened_clip.h"

#include <cstring>
#include <memory>
#include <new>
#include <ostream>
#include <string>

#include <pxr/ar/asset.h>
#include <pxr/ar/resolvedPath.h>
#include <pxr/ar/resolver.h>
#include <pxr/sdf/fileFormat.h>
#include <pxr/sdf/layer.h>
#include <pxr/sdf/layerHints.h>
#include <pxr/sdf/schema.h>
#include <pxr/tf/diagnostic.h>
#include <pxr/tf/fileUtils.h>
#include <pxr/tf/pathUtils.h>
#include <pxr/tf/registryManager.h>
#include <pxr/tf/stringUtils.h>
#include <pxr/vt/array.h>

// Macros of OpenUSD name what is in it without saying so.
using namespace pxr;  // NOLINT

namespace anicodec::usd {

namespace {

constexpr char kMagic[8] = {'\x89', 'A', 'N', 'I', '\r', '\n', '\x1a', '\n'};

/// Whether this build and the library that it runs in count types alike: headers of another release, with other types in Vt's
/// list, hand out wrong values without a word.
bool fits_the_release() {
  static const bool fits = [] {
    const struct {
      const char* type;
      int own;
    } types[] = {{"token", pxr::VtGetKnownValueTypeIndex<pxr::TfToken>()},
                 {"double", pxr::VtGetKnownValueTypeIndex<double>()},
                 {"int[]", pxr::VtGetKnownValueTypeIndex<pxr::VtIntArray>()},
                 {"point3f[]", pxr::VtGetKnownValueTypeIndex<pxr::VtVec3fArray>()}};
    for (const auto& type : types) {
      const pxr::SdfValueTypeName found = pxr::SdfSchema::GetInstance().FindType(type.type);
      if (found.GetDefaultValue().GetKnownValueTypeIndex() != type.own)
        return false;
    }
    return true;
  }();
  return fits;
}

std::shared_ptr<pxr::ArAsset> opened(const std::string& path) {
  return pxr::ArGetResolver().OpenAsset(pxr::ArResolvedPath(path));
}

}  // namespace

class AnicFileFormat : public pxr::SdfFileFormat {
 public:
  AnicFileFormat()
      : SdfFileFormat(pxr::TfToken("anic"), pxr::TfToken("1.0"), pxr::TfToken("usd"),
                      std::string("anic")) {}

  bool CanRead(const std::string& path) const override {
    char magic[sizeof kMagic];
    const std::shared_ptr<pxr::ArAsset> asset = opened(path);
    return asset != nullptr && asset->Read(magic, sizeof magic, 0) == sizeof magic &&
           std::memcmp(magic, kMagic, sizeof magic) == 0;
  }

  bool Read(pxr::SdfLayer* layer, const std::string& path, bool /*metadata_only*/) const override {
    std::string error;
    try {
      if (read(layer, path, &error))
        return true;
    } catch (const std::bad_alloc&) {
      error = "there is not enough memory";
    }
    TF_RUNTIME_ERROR("%s: %s", path.c_str(), error.c_str());
    return false;
  }

  bool WriteToString(const pxr::SdfLayer& layer, std::string* text,
                     const std::string& comment) const override {
    return as_text()->WriteToString(layer, text, comment);
  }

  bool WriteToStream(const pxr::SdfSpecHandle& spec, std::ostream& out,
                     size_t indent) const override {
    return as_text()->WriteToStream(spec, out, indent);
  }

 private:
  static pxr::SdfFileFormatConstPtr as_text() {
    return pxr::SdfFileFormat::FindById(pxr::TfToken("usda"));
  }

  bool read(pxr::SdfLayer* layer, const std::string& path, std::string* error) const {
    if (!fits_the_release()) {
      *error = "this plug-in was built for another release of OpenUSD";
      return false;
    }
    const std::shared_ptr<pxr::ArAsset> asset = opened(path);
    const std::shared_ptr<const char> bytes = asset == nullptr ? nullptr : asset->GetBuffer();
    if (bytes == nullptr) {
      *error = "cannot be read";
      return false;
    }
    std::shared_ptr<const OpenedClip> file = OpenedClip::open(bytes.get(), asset->GetSize(), error);
    if (file == nullptr)
      return false;
    const pxr::SdfFileFormat::FileFormatArguments& arguments = layer->GetFileFormatArguments();
    const auto over = arguments.find("over");
    // One of several clips does not name them all.
    std::string name = file->clips().size() == 1 ? file->info().name : "";
    if (name.empty())
      name = pxr::TfStringGetBeforeSuffix(pxr::TfGetBaseName(path));
    const auto data = pxr::TfCreateRefPtr(new ClipLayer);
    LayerBuilder builder(file, name, over != arguments.end() && over->second == "true", &*data);
    if (!builder.build(error))
      return false;
    pxr::SdfAbstractDataRefPtr given = data;
    _SetLayerData(layer, given, pxr::SdfLayerHints(/*mightHaveRelocates*/ false));
    return true;
  }
};

}  // namespace anicodec::usd

using anicodec::usd::AnicFileFormat;

TF_REGISTRY_FUNCTION(TfType) {
  SDF_DEFINE_FILE_FORMAT(AnicFileFormat, SdfFileFormat);
}
