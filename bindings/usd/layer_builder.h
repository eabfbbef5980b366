// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_BINDINGS_USD_LAYER_BUILDER_H_
#define ANICODEC_BINDINGS_USD_LAYER_BUILDER_H_

#include "bindings/usd/clip_layer.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include <pxr/sdf/path.h>

namespace anicodec::usd {

/// Describes a clip as prims: README.md says which. A mesh is where the stage that it came from had it (metadata "usd"), else below
/// a prim that is named for the clip. Nothing is decoded.
class LayerBuilder {
 public:
  /// over: prims are "over", and meshes leave the transforms above them, to be layered over the stage that the clip came from.
  LayerBuilder(std::shared_ptr<const OpenedClip> file, std::string name, bool over,
               ClipLayer* layer)
      : file_(std::move(file)), name_(std::move(name)), over_(over), layer_(*layer) {}

  /// False, with one line in `error`, for a clip that no layer can hold.
  bool build(std::string* error);

 private:
  void read_metadata();
  void place_meshes();
  void add_stage(const std::vector<std::shared_ptr<const ClipCodes>>& clocks);
  void add_clip_variants();
  void add_mesh(uint32_t mesh);
  void add_frames(uint32_t mesh, const std::shared_ptr<const ClipCodes>& codes);
  void add_visibility(uint32_t mesh, const ClipCodes& codes, const pxr::SdfPath& prim);
  void add_normals(uint32_t mesh, const std::shared_ptr<const ClipCodes>& codes, bool rests,
                   const pxr::SdfPath& prim);
  void add_attribute(uint32_t mesh, uint32_t number, const std::shared_ptr<const ClipCodes>& codes,
                     const pxr::SdfPath& prim);
  void add_subsets(uint32_t mesh, uint32_t number);
  void add_transforms(const pxr::SdfPath& prim);
  void add_root_motion(const std::shared_ptr<const ClipCodes>& codes, const pxr::SdfPath& prim);
  pxr::SdfPath material(const std::string& name, uint32_t mesh, uint32_t attribute, uint32_t label);
  void add_surface(const pxr::SdfPath& material, const anic_material& look, uint32_t mesh);
  pxr::SdfPath add_shader(const pxr::SdfPath& path, const char* id);
  void add_input(const pxr::SdfPath& shader, const char* name, const char* type,
                 pxr::VtValue value);
  /// Makes the property where there is none.
  void connect(const pxr::SdfPath& property, const char* type, const pxr::SdfPath& source,
               const char* output);
  std::string uv_name(uint32_t mesh) const;  ///< of the first texture coordinates

  /// The prim itself, or the part of it in a clip's variant.
  pxr::SdfPath in_clip(const pxr::SdfPath& prim, uint32_t clip) const;
  void ensure_prim(const pxr::SdfPath& path, pxr::SdfSpecifier specifier, const char* type);
  pxr::SdfPath unique(const pxr::SdfPath& parent, const std::string& name) const;
  pxr::SdfPath add_property(const pxr::SdfPath& prim, const std::string& name, const char* type,
                            bool uniform = false);
  pxr::SdfPath add_relationship(const pxr::SdfPath& prim, const char* name,
                                const pxr::SdfPath& target);
  void set_frames(const pxr::SdfPath& property, uint32_t mesh,
                  const std::shared_ptr<const ClipCodes>& codes, const std::type_info& type,
                  bool rests, MakeValue make);

  std::shared_ptr<const OpenedClip> file_;
  std::string name_;
  bool over_;
  ClipLayer& layer_;
  double codes_per_second_ = 24;
  std::vector<std::string> wanted_;  ///< prim of each mesh; empty: below the clip's
  std::vector<pxr::SdfPath> prims_;
  std::set<pxr::SdfPath> roots_;
  pxr::SdfPath default_prim_;
  std::vector<std::string> variants_;  ///< name of each clip
  bool root_moves_ = false;
  std::map<std::string, pxr::SdfPath> materials_;
  std::unordered_map<pxr::SdfPath, std::vector<pxr::TfToken>, pxr::SdfPath::Hash> children_,
      properties_;
};

pxr::VtValue token(const char* text);

/// The text where it names a prim as it is, else one near it that does.
std::string identifier(const std::string& text);

}  // namespace anicodec::usd

#endif  // ANICODEC_BINDINGS_USD_LAYER_BUILDER_H_
