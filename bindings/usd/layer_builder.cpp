// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/usd/layer_builder.h"

#include <algorithm>

#include <pxr/gf/vec3d.h>
#include <pxr/js/json.h>
#include <pxr/js/value.h>
#include <pxr/sdf/listOp.h>
#include <pxr/sdf/types.h>
#include <pxr/tf/stringUtils.h>
#include <pxr/vt/array.h>

// Macros of OpenUSD name what is in it without saying so.
using namespace pxr;  // NOLINT

namespace anicodec::usd {

namespace {

using pxr::SdfPath;
using pxr::TfToken;
using pxr::VtValue;

constexpr size_t kMostPathBytes = 4096;
constexpr size_t kMostPathElements = 256;
constexpr double kDegrees = 57.295779513082320876798;

bool is_prim_path(const std::string& text) {
  if (text.size() > kMostPathBytes || text.empty() || text[0] != '/' ||
      !SdfPath::IsValidPathString(text))
    return false;
  const SdfPath path(text);
  return path.IsPrimPath() && !path.ContainsPrimVariantSelection() &&
         path.GetPathElementCount() <= kMostPathElements;
}

const char* interpolation(anic_domain domain) {
  return domain == ANIC_DOMAIN_VERTICES  ? "vertex"
         : domain == ANIC_DOMAIN_CORNERS ? "faceVarying"
                                         : "uniform";
}

}  // namespace

VtValue token(const char* text) {
  return VtValue(TfToken(text));
}

std::string identifier(const std::string& text) {
  if (SdfPath::IsValidIdentifier(text) && text.size() <= kMostPathBytes)
    return text;
  return TfMakeValidIdentifier(text.substr(0, 64));
}

bool LayerBuilder::build(std::string* error) {
  codes_per_second_ =
      static_cast<double>(file_->info().rate_numerator) / file_->info().rate_denominator;
  read_metadata();
  std::vector<std::shared_ptr<const ClipCodes>> clocks;
  for (uint32_t clip = 0; clip < file_->clips().size(); ++clip) {
    clocks.push_back(std::make_shared<ClipCodes>(file_, clip, snapped_rate(codes_per_second_)));
    root_moves_ = root_moves_ || file_->has_root_motion(clip);
    if (!clocks.back()->ascend()) {
      *error = "its frames are too near one another, or too far from zero, for time codes";
      return false;
    }
  }
  layer_.add_spec(SdfPath::AbsoluteRootPath(), pxr::SdfSpecTypePseudoRoot);
  place_meshes();
  add_stage(clocks);
  if (clocks.size() > 1)
    add_clip_variants();
  for (uint32_t mesh = 0; mesh < prims_.size(); ++mesh)
    add_mesh(mesh);
  const std::set<SdfPath> moved = over_ ? std::set<SdfPath>(prims_.begin(), prims_.end()) : roots_;
  for (const SdfPath& prim : moved)
    add_transforms(prim);
  for (const auto& codes : clocks) {
    for (uint32_t mesh = 0; mesh < prims_.size(); ++mesh)
      add_frames(mesh, codes);
    for (const SdfPath& prim : moved)
      add_root_motion(codes, in_clip(prim, codes->clip()));
  }
  for (auto& [path, names] : children_)
    layer_.set_field(path, "primChildren", VtValue(names));
  for (auto& [path, names] : properties_)
    layer_.set_field(path, "properties", VtValue(names));
  return true;
}

void LayerBuilder::read_metadata() {
  if (file_->metadata().empty())
    return;
  const pxr::JsValue whole = pxr::JsParseString(file_->metadata());
  if (!whole.IsObject())
    return;
  const pxr::JsObject names = whole.GetJsObject();
  const auto found = names.find("usd");
  if (found == names.end() || !found->second.IsObject())
    return;
  const pxr::JsObject stage = found->second.GetJsObject();
  const auto rate = stage.find("timeCodesPerSecond");
  if (rate != stage.end() && (rate->second.IsReal() || rate->second.IsInt())) {
    const double value = rate->second.GetReal();
    if (value > 0 && value < 1e9)
      codes_per_second_ = value;
  }
  const auto first = stage.find("defaultPrim");
  if (first != stage.end() && first->second.IsString() &&
      is_prim_path("/" + first->second.GetString()))
    default_prim_ = SdfPath("/" + first->second.GetString());
  const auto prims = stage.find("prims");
  if (prims == stage.end() || !prims->second.IsArray())
    return;
  for (const pxr::JsValue& prim : prims->second.GetJsArray())
    wanted_.push_back(prim.IsString() ? prim.GetString() : std::string());
}

void LayerBuilder::place_meshes() {
  const std::string clip = identifier(name_.empty() ? "clip" : name_);
  const bool known = wanted_.size() == file_->info().mesh_count;  // else they are of other meshes
  std::set<SdfPath> taken;
  for (uint32_t mesh = 0; mesh < file_->info().mesh_count; ++mesh) {
    SdfPath path;
    if (known && is_prim_path(wanted_[mesh])) {
      path = SdfPath(wanted_[mesh]);
    } else {
      const char* name = file_->asset().mesh(mesh).name;
      path = SdfPath("/" + clip)
                 .AppendChild(TfToken(identifier(name == nullptr || name[0] == 0 ? "mesh" : name)));
    }
    if (!taken.insert(path).second) {
      path = path.ReplaceName(TfToken(path.GetName() + "_" + std::to_string(mesh)));
      while (!taken.insert(path).second)
        path = path.ReplaceName(TfToken(path.GetName() + "_"));
    }
    prims_.push_back(path);
    const pxr::SdfSpecifier specifier = over_ ? pxr::SdfSpecifierOver : pxr::SdfSpecifierDef;
    ensure_prim(path, specifier, over_ ? nullptr : "Xform");
    if (!over_)
      layer_.set_field(path, "typeName", token("Mesh"));
    roots_.insert(path.GetPrefixes().front());
  }
  if (prims_.empty())
    return;
  if (default_prim_.IsEmpty() || roots_.count(default_prim_) == 0)
    default_prim_ = prims_[0].GetPrefixes().front();
}

void LayerBuilder::add_stage(const std::vector<std::shared_ptr<const ClipCodes>>& clocks) {
  const SdfPath root = SdfPath::AbsoluteRootPath();
  double start = clocks[0]->code(clocks[0]->first_frame());
  double end = clocks[0]->end();
  for (const auto& codes : clocks) {
    start = std::min(start, codes->code(codes->first_frame()));
    end = std::max(end, codes->end());
  }
  const anic_asset_info& info = file_->info();
  if (!prims_.empty())
    layer_.set_field(root, "defaultPrim", VtValue(default_prim_.GetNameToken()));
  layer_.set_field(root, "startTimeCode", VtValue(start));
  layer_.set_field(root, "endTimeCode", VtValue(end));
  layer_.set_field(root, "timeCodesPerSecond", VtValue(codes_per_second_));
  layer_.set_field(root, "framesPerSecond",
                   VtValue(static_cast<double>(info.rate_numerator) / info.rate_denominator));
  layer_.set_field(root, "upAxis", token(info.up == ANIC_UP_Z ? "Z" : "Y"));
  if (info.metres_per_unit > 0)
    layer_.set_field(root, "metersPerUnit",
                     VtValue(shortest(static_cast<float>(info.metres_per_unit))));
}

void LayerBuilder::add_clip_variants() {
  std::set<std::string> taken;
  for (const anic_clip& clip : file_->clips()) {
    std::string name = identifier(clip.name[0] == 0 ? "clip" : clip.name);
    if (!taken.insert(name).second) {
      name += "_" + std::to_string(variants_.size());
      while (!taken.insert(name).second)
        name += "_";
    }
    variants_.push_back(name);
  }
  for (const SdfPath& root : roots_) {
    pxr::SdfStringListOp sets;
    sets.SetPrependedItems({"clip"});
    layer_.set_field(root, "variantSetNames", VtValue(sets));
    layer_.set_field(root, "variantSelection",
                     VtValue(pxr::SdfVariantSelectionMap{{"clip", variants_[0]}}));
    layer_.set_field(root, "variantSetChildren", VtValue(std::vector<TfToken>{TfToken("clip")}));
    const SdfPath set = root.AppendVariantSelection("clip", "");
    layer_.add_spec(set, pxr::SdfSpecTypeVariantSet);
    std::vector<TfToken> names;
    for (const std::string& variant : variants_) {
      names.emplace_back(variant);
      const SdfPath path = root.AppendVariantSelection("clip", variant);
      layer_.add_spec(path, pxr::SdfSpecTypeVariant);
      layer_.set_field(path, "specifier", VtValue(pxr::SdfSpecifierOver));
    }
    layer_.set_field(set, "variantChildren", VtValue(names));
  }
}

void LayerBuilder::add_mesh(uint32_t mesh) {
  const SdfPath& prim = prims_[mesh];
  const anic_polygons polygons = file_->asset().polygons(mesh);
  const uint32_t corner_count = file_->asset().mesh(mesh).corner_count;
  pxr::VtIntArray counts(polygons.polygon_count);
  for (uint32_t p = 0; p < polygons.polygon_count; ++p)
    counts[p] = static_cast<int>(polygons.offsets[p + 1] - polygons.offsets[p]);
  pxr::VtIntArray corners(corner_count);
  std::copy_n(polygons.corners, corner_count, corners.data());
  layer_.set_field(add_property(prim, "faceVertexCounts", "int[]"), "default",
                   VtValue::Take(counts));
  layer_.set_field(add_property(prim, "faceVertexIndices", "int[]"), "default",
                   VtValue::Take(corners));
  layer_.set_field(add_property(prim, "subdivisionScheme", "token", true), "default",
                   token("none"));
  for (uint32_t number = 0; number < file_->asset().mesh(mesh).attribute_count; ++number) {
    const anic_attribute attribute = file_->asset().attribute(number, mesh);
    if (attribute.kind == ANIC_ATTRIBUTE_MATERIAL || attribute.kind == ANIC_ATTRIBUTE_PART)
      add_subsets(mesh, number);
    else if (attribute.components != 0 && attribute.moves == 0 &&
             attribute.kind != ANIC_ATTRIBUTE_NORMAL)
      add_attribute(mesh, number, nullptr, prim);
  }
}

void LayerBuilder::add_frames(uint32_t mesh, const std::shared_ptr<const ClipCodes>& codes) {
  const SdfPath prim = in_clip(prims_[mesh], codes->clip());
  if (prim != prims_[mesh])
    ensure_prim(prim, pxr::SdfSpecifierOver, nullptr);
  const std::vector<FrameRange>& ranges = file_->frames_of(mesh);
  const bool there = std::any_of(ranges.begin(), ranges.end(), [&](const FrameRange& range) {
    return range.first < codes->end_frame() && codes->first_frame() < range.second;
  });
  add_visibility(mesh, *codes, prim);
  if (!there)
    return;
  const bool rests = file_->rests(mesh) && ranges.size() == 1 &&
                     ranges[0].first <= codes->first_frame() &&
                     ranges[0].second >= codes->end_frame();
  const std::type_info& points = typeid(pxr::VtVec3fArray);
  set_frames(add_property(prim, "points", "point3f[]"), mesh, codes, points, rests,
             make_positions(file_, mesh));
  if (file_->has_boxes(mesh))
    set_frames(add_property(prim, "extent", "float3[]"), mesh, codes, points, rests,
               make_extent(file_, mesh, codes->clip()));
  add_normals(mesh, codes, rests, prim);
  for (uint32_t number = 0; number < file_->asset().mesh(mesh).attribute_count; ++number) {
    const anic_attribute attribute = file_->asset().attribute(number, mesh);
    if (attribute.components != 0 && attribute.moves != 0 &&
        attribute.kind != ANIC_ATTRIBUTE_NORMAL)
      add_attribute(mesh, number, codes, prim);
  }
}

void LayerBuilder::add_visibility(uint32_t mesh, const ClipCodes& codes, const SdfPath& prim) {
  std::vector<std::pair<double, VtValue>> changes;
  uint32_t frame = codes.first_frame();
  for (const FrameRange& range : file_->frames_of(mesh)) {
    const uint32_t from = std::max(range.first, codes.first_frame());
    const uint32_t to = std::min(range.second, codes.end_frame());
    if (from >= to)
      continue;
    if (from > frame)
      changes.emplace_back(codes.code(frame), token("invisible"));
    changes.emplace_back(codes.code(from), token("inherited"));
    frame = to;
  }
  if (frame < codes.end_frame())
    changes.emplace_back(codes.code(frame), token("invisible"));
  if (changes.size() > 1)
    layer_.set_samples(add_property(prim, "visibility", "token"),
                       std::make_shared<ListedSamples>(std::move(changes)));
  else if (changes[0].second == token("invisible"))
    layer_.set_field(add_property(prim, "visibility", "token"), "default", changes[0].second);
}

void LayerBuilder::add_normals(uint32_t mesh, const std::shared_ptr<const ClipCodes>& codes,
                               bool rests, const SdfPath& prim) {
  bool hard_edges = false;
  for (uint32_t number = 0; number < file_->asset().mesh(mesh).attribute_count; ++number) {
    const anic_attribute attribute = file_->asset().attribute(number, mesh);
    if (attribute.kind != ANIC_ATTRIBUTE_NORMAL)
      continue;
    if (attribute.components == 3 && (attribute.moves != 0 || rests)) {
      add_attribute(mesh, number, codes, prim);
      return;
    }
    hard_edges = hard_edges || attribute.domain == ANIC_DOMAIN_CORNERS;
  }
  const SdfPath normals = add_property(prim, "normals", "normal3f[]");
  layer_.set_field(normals, "interpolation", token(hard_edges ? "faceVarying" : "vertex"));
  set_frames(normals, mesh, codes, typeid(pxr::VtVec3fArray), rests,
             make_normals(file_, mesh, file_->frames_of(mesh)[0].first, hard_edges));
}

void LayerBuilder::add_attribute(uint32_t mesh, uint32_t number,
                                 const std::shared_ptr<const ClipCodes>& codes,
                                 const SdfPath& prim) {
  const anic_attribute attribute = file_->asset().attribute(number, mesh);
  const ValueType type = value_type(attribute.kind, attribute.components);
  const bool is_normal = attribute.kind == ANIC_ATTRIBUTE_NORMAL;
  std::string name = attribute.name;
  if (name.empty()) {
    name = attribute.kind == ANIC_ATTRIBUTE_UV       ? "st"
           : attribute.kind == ANIC_ATTRIBUTE_COLOUR ? "displayColor"
                                                     : "attribute" + std::to_string(number);
  }
  std::string full = is_normal ? "normals" : "primvars:" + identifier(name);
  while (layer_.has_spec(prim.AppendProperty(TfToken(full))))
    full += "_" + std::to_string(number);
  const SdfPath property = add_property(prim, full, type.name);
  layer_.set_field(property, "interpolation", token(interpolation(attribute.domain)));
  if (attribute.components > 4)
    layer_.set_field(property, "elementSize", VtValue(static_cast<int>(attribute.components)));
  if (attribute.moves == 0) {
    layer_.set_field(property, "default",
                     type.make(attribute.values, size_t{attribute.count} * attribute.components));
    return;
  }
  set_frames(property, mesh, codes, type.info, false, make_attribute(file_, mesh, number));
}

void LayerBuilder::add_subsets(uint32_t mesh, uint32_t number) {
  const anic_attribute attribute = file_->asset().attribute(number, mesh);
  const bool is_material = attribute.kind == ANIC_ATTRIBUTE_MATERIAL;
  std::vector<pxr::VtIntArray> faces(attribute.label_count);
  for (uint32_t polygon = 0; polygon < attribute.count; ++polygon) {
    if (attribute.labels[polygon] != 0)
      faces[attribute.labels[polygon] - 1].push_back(static_cast<int>(polygon));
  }
  for (uint32_t label = 0; label < attribute.label_count; ++label) {
    const char* name = file_->asset().label_name(number, label, mesh);
    if (faces[label].empty())
      continue;
    const SdfPath prim = unique(prims_[mesh], identifier(name));
    ensure_prim(prim, pxr::SdfSpecifierDef, "GeomSubset");
    layer_.set_field(add_property(prim, "elementType", "token", true), "default", token("face"));
    layer_.set_field(add_property(prim, "familyName", "token", true), "default",
                     token(is_material ? "materialBind" : "part"));
    layer_.set_field(add_property(prim, "indices", "int[]"), "default",
                     VtValue::Take(faces[label]));
    if (is_material && !over_) {
      pxr::SdfTokenListOp schemas;
      schemas.SetPrependedItems({TfToken("MaterialBindingAPI")});
      layer_.set_field(prim, "apiSchemas", VtValue(schemas));
      add_relationship(prim, "material:binding", material(name, mesh, number, label));
      anic_material look = ANIC_INIT(anic_material);
      const SdfPath sides = prims_[mesh].AppendProperty(TfToken("doubleSided"));
      if (file_->asset().material(number, label, &look, mesh) && look.double_sided != 0 &&
          !layer_.has_spec(sides))
        layer_.set_field(add_property(prims_[mesh], "doubleSided", "bool", true), "default",
                         VtValue(true));
    }
  }
}

void LayerBuilder::add_transforms(const SdfPath& prim) {
  pxr::VtArray<TfToken> order;
  if (over_)
    order.push_back(TfToken("!resetXformStack!"));
  const double* origin = file_->info().origin;
  if (origin[0] != 0 || origin[1] != 0 || origin[2] != 0) {
    layer_.set_field(add_property(prim, "xformOp:translate:origin", "double3"), "default",
                     VtValue(pxr::GfVec3d(origin[0], origin[1], origin[2])));
    order.push_back(TfToken("xformOp:translate:origin"));
  }
  if (root_moves_) {
    for (const char* op : {"xformOp:translate:rootMove", "xformOp:translate:rootPivot"})
      order.push_back(TfToken(op));
    order.push_back(TfToken(file_->info().up == ANIC_UP_Z ? "xformOp:rotateZ:rootTurn"
                                                          : "xformOp:rotateY:rootTurn"));
    order.push_back(TfToken("!invert!xformOp:translate:rootPivot"));
  }
  if (!order.empty())
    layer_.set_field(add_property(prim, "xformOpOrder", "token[]", true), "default",
                     VtValue(order));
}

void LayerBuilder::add_root_motion(const std::shared_ptr<const ClipCodes>& codes,
                                   const SdfPath& prim) {
  if (!root_moves_)
    return;
  const uint32_t clip = codes->clip();
  const auto file = file_;
  const auto add = [&](const std::string& name, const char* type,
                       std::vector<std::pair<double, VtValue>> values) {
    layer_.set_samples(add_property(prim, name, type),
                       std::make_shared<ListedSamples>(std::move(values)));
  };
  std::vector<std::pair<double, VtValue>> moves;
  std::vector<std::pair<double, VtValue>> pivots;
  std::vector<std::pair<double, VtValue>> turns;
  const uint32_t end = file->has_root_motion(clip) ? codes->end_frame() : codes->first_frame() + 1;
  for (uint32_t frame = codes->first_frame(); frame < end; ++frame) {
    const anic_root_motion motion = file->root_motion(clip, frame);
    moves.emplace_back(codes->code(frame),
                       VtValue(pxr::GfVec3d(motion.move[0], motion.move[1], motion.move[2])));
    pivots.emplace_back(codes->code(frame),
                        VtValue(pxr::GfVec3d(motion.pivot[0], motion.pivot[1], motion.pivot[2])));
    turns.emplace_back(codes->code(frame), VtValue(motion.turn * kDegrees));
  }
  add("xformOp:translate:rootMove", "double3", std::move(moves));
  add("xformOp:translate:rootPivot", "double3", std::move(pivots));
  add(file->info().up == ANIC_UP_Z ? "xformOp:rotateZ:rootTurn" : "xformOp:rotateY:rootTurn",
      "double", std::move(turns));
}

SdfPath LayerBuilder::in_clip(const SdfPath& prim, uint32_t clip) const {
  if (variants_.empty())
    return prim;
  const SdfPath root = prim.GetPrefixes().front();
  return prim.ReplacePrefix(root, root.AppendVariantSelection("clip", variants_[clip]));
}

void LayerBuilder::ensure_prim(const SdfPath& path, pxr::SdfSpecifier specifier, const char* type) {
  if (layer_.has_spec(path))
    return;
  const SdfPath parent = path.GetParentPath();
  if (parent != SdfPath::AbsoluteRootPath())
    ensure_prim(parent, specifier, type == nullptr ? nullptr : "Xform");
  layer_.add_spec(path, pxr::SdfSpecTypePrim);
  layer_.set_field(path, "specifier", VtValue(specifier));
  if (type != nullptr)
    layer_.set_field(path, "typeName", token(type));
  children_[parent].push_back(path.GetNameToken());
}

SdfPath LayerBuilder::unique(const SdfPath& parent, const std::string& name) const {
  SdfPath path = parent.AppendChild(TfToken(name));
  for (int number = 1; layer_.has_spec(path); ++number)
    path = parent.AppendChild(TfToken(name + "_" + std::to_string(number)));
  return path;
}

SdfPath LayerBuilder::add_property(const SdfPath& prim, const std::string& name, const char* type,
                                   bool uniform) {
  const SdfPath path = prim.AppendProperty(TfToken(name));
  layer_.add_spec(path, pxr::SdfSpecTypeAttribute);
  layer_.set_field(path, "typeName", token(type));
  layer_.set_field(path, "variability",
                   VtValue(uniform ? pxr::SdfVariabilityUniform : pxr::SdfVariabilityVarying));
  layer_.set_field(path, "custom", VtValue(false));
  properties_[prim].push_back(path.GetNameToken());
  return path;
}

SdfPath LayerBuilder::add_relationship(const SdfPath& prim, const char* name,
                                       const SdfPath& target) {
  const SdfPath path = prim.AppendProperty(TfToken(name));
  layer_.add_spec(path, pxr::SdfSpecTypeRelationship);
  layer_.set_field(path, "variability", VtValue(pxr::SdfVariabilityUniform));
  layer_.set_field(path, "custom", VtValue(false));
  pxr::SdfPathListOp targets;
  targets.SetExplicitItems({target});
  layer_.set_field(path, "targetPaths", VtValue(targets));
  properties_[prim].push_back(path.GetNameToken());
  return path;
}

void LayerBuilder::set_frames(const SdfPath& property, uint32_t mesh,
                              const std::shared_ptr<const ClipCodes>& codes,
                              const std::type_info& type, bool rests, MakeValue make) {
  auto samples = std::make_shared<FrameSamples>(codes, mesh, type, std::move(make));
  if (rests)
    layer_.set_resting(property, std::move(samples));
  else
    layer_.set_samples(property, std::move(samples));
}

}  // namespace anicodec::usd
