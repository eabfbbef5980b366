// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/engines/ogre/ogre_clip.h"

#include "bindings/engines/ogre/ogre_shader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <Ogre.h>

namespace anicodec::ogre {
namespace {

constexpr uint32_t kRows = 64;  // of a texture of states, at first

void check(anic::Status status, const Ogre::String& file) {
  if (!status)
    OGRE_EXCEPT(Ogre::Exception::ERR_INVALIDPARAMS, file + ": " + status.text(), "anicodec");
}

uint32_t most_texels() {
  return 8192;  // of a texture's side, which all cards with GLSL 3.30 have
}

Ogre::TexturePtr make_texture(const Ogre::String& name, uint32_t width, uint32_t height,
                              Ogre::PixelFormat format, int usage) {
  return Ogre::TextureManager::getSingleton().createManual(
      name, Ogre::ResourceGroupManager::INTERNAL_RESOURCE_GROUP_NAME, Ogre::TEX_TYPE_2D, width,
      std::max(height, 1U), 0, format, usage);
}

/// A program of the plug-in, compiled once.
const Ogre::String& program(Ogre::GpuProgramType type, const Ogre::String& name,
                            const char* source) {
  auto& manager = Ogre::HighLevelGpuProgramManager::getSingleton();
  const Ogre::String& group = Ogre::ResourceGroupManager::INTERNAL_RESOURCE_GROUP_NAME;
  if (!manager.getByName(name, group)) {
    Ogre::HighLevelGpuProgramPtr made = manager.createProgram(name, group, "glsl", type);
    made->setSource(source);
    if (type == Ogre::GPT_VERTEX_PROGRAM)
      made->setVertexTextureFetchRequired(true);
    made->load();
  }
  return name;
}

/// A linear colour as the shaders of the plug-in show it, which know no gamma.
Ogre::ColourValue shown_colour(const float (&linear)[4]) {
  const auto shown = [](float x) { return std::pow(x, 1 / 2.2F); };
  return Ogre::ColourValue(shown(linear[0]), shown(linear[1]), shown(linear[2]), linear[3]);
}

/// Programs and parameters that both ways to play have in common.
void set_programs(Ogre::Pass* pass, const Ogre::String& vertex, const Ogre::String& fragment) {
  using Parameters = Ogre::GpuProgramParameters;
  pass->setVertexProgram(vertex);
  pass->setFragmentProgram(fragment);
  Ogre::GpuProgramParametersSharedPtr parameters = pass->getVertexProgramParameters();
  parameters->setIgnoreMissingParams(true);  // a compiler drops what a program does not need
  parameters->setNamedAutoConstant("world", Parameters::ACT_WORLD_MATRIX);
  parameters->setNamedAutoConstant("worldViewProjection", Parameters::ACT_WORLDVIEWPROJ_MATRIX);
  parameters = pass->getFragmentProgramParameters();
  parameters->setIgnoreMissingParams(true);
  parameters->setNamedAutoConstant("colour", Parameters::ACT_CUSTOM, 1);
  parameters->setNamedAutoConstant("ambient", Parameters::ACT_AMBIENT_LIGHT_COLOUR);
  parameters->setNamedAutoConstant("lampColour", Parameters::ACT_LIGHT_DIFFUSE_COLOUR, 0);
  parameters->setNamedAutoConstant("lamp", Parameters::ACT_LIGHT_POSITION, 0);
}

/// Programs, textures and parameters of a pass that plays on the card.
void set_pass(Ogre::Pass* pass, const ClipMesh& mesh, const Ogre::TexturePtr& state,
              const Ogre::String& fragment) {
  set_programs(pass, program(Ogre::GPT_VERTEX_PROGRAM, "Anicodec/Vertex", kVertexShader), fragment);
  const std::array<std::pair<const char*, Ogre::TexturePtr>, 4> units = {
      {{"pose", mesh.textures[ANIC_TEXTURE_POSE]},
       {"wide", mesh.textures[ANIC_TEXTURE_WIDE]},
       {"narrow", mesh.textures[ANIC_TEXTURE_NARROW]},
       {"state", state}}};
  Ogre::GpuProgramParametersSharedPtr parameters = pass->getVertexProgramParameters();
  for (size_t i = 0; i < units.size(); ++i) {
    Ogre::TextureUnitState* unit = pass->createTextureUnitState();
    unit->setTexture(units[i].second);
    unit->setTextureFiltering(Ogre::TFO_NONE);
    unit->setTextureAddressingMode(Ogre::TextureUnitState::TAM_CLAMP);
    parameters->setNamedConstant(units[i].first, static_cast<int>(i));
  }
  parameters->setNamedConstant("width", static_cast<int>(mesh.width));
  parameters->setNamedConstant("rows", static_cast<int>(mesh.rows));
  parameters->setNamedAutoConstant("instance", Ogre::GpuProgramParameters::ACT_CUSTOM, 0);
}

}  // namespace

Clip::Clip(const Ogre::String& file, const Ogre::String& group, bool in_place) : name_(file) {
  Ogre::DataStreamPtr stream = Ogre::ResourceGroupManager::getSingleton().openResource(file, group);
  Ogre::MemoryDataStream bytes(stream);
  anic_options options = ANIC_INIT(anic_options);
  options.flags = ANIC_OPEN_BOUNDS;
  if (in_place)
    options.flags |= ANIC_OPEN_IN_PLACE;
  check(asset_.open({bytes.getPtr(), bytes.size()}, &options), name_);
  const uint32_t count = asset_.info().mesh_count;
  meshes_.resize(count);
  for (uint32_t m = 0; m < count; ++m)
    make_mesh(m);
}

Clip::~Clip() {
  auto& textures = Ogre::TextureManager::getSingleton();
  for (ClipMesh& mesh : meshes_) {
    for (Ogre::TexturePtr& texture : mesh.textures) {
      if (texture)
        textures.remove(texture);
    }
    if (!mesh.material)
      continue;
    const Ogre::MaterialPtr caster = mesh.material->getTechnique(0)->getShadowCasterMaterial();
    Ogre::MaterialManager::getSingleton().remove(mesh.material);
    Ogre::MaterialManager::getSingleton().remove(caster);
  }
  for (Ogre::TexturePtr& state : states_) {
    if (state)
      textures.remove(state);
  }
}

uint32_t Clip::find(const Ogre::String& name) const {
  uint32_t clip = 0;
  if (!name.empty())
    check(anic_find_clip(asset_.get(), name.c_str(), &clip), name_ + ", clip " + name);
  return clip;
}

void Clip::make_mesh(uint32_t index) {
  ClipMesh& mesh = meshes_[index];
  anic_render_plan_options options = ANIC_INIT(anic_render_plan_options);
  options.source_edges = 1;
  options.crease_angle = 60;
  anic_box box;
  while (options.reference_frame + 1 < asset_.info().frame_count &&
         asset_.frame_bounds(options.reference_frame, &box, index).code() == ANIC_E_ABSENT)
    ++options.reference_frame;
  check(mesh.plan.create(asset_, &options, index), name_);
  mesh.info = mesh.plan.info();
  const anic_mesh shape = asset_.mesh(index);
  uint32_t uv = shape.attribute_count, material = shape.attribute_count;
  for (uint32_t a = shape.attribute_count; a-- > 0;) {
    const anic_attribute attribute = asset_.attribute(a, index);
    if (attribute.kind == ANIC_ATTRIBUTE_UV && attribute.components >= 2)
      uv = a;
    else if (attribute.kind == ANIC_ATTRIBUTE_MATERIAL)
      material = a;
  }
  for (uint32_t g = 0; g < mesh.info.group_count; ++g) {
    const uint32_t label = mesh.info.group_materials[g];
    const char* text = label > 0 && material < shape.attribute_count
                           ? asset_.label_name(material, label - 1, index)
                           : nullptr;
    mesh.materials.emplace_back(text ? text : "");
    anic_material look = ANIC_INIT(anic_material);
    const bool known = text && asset_.material(material, label - 1, &look, index);
    mesh.colours.push_back(known ? shown_colour(look.base_colour) : Ogre::ColourValue::White);
  }
  const uint32_t n = mesh.info.vertex_count;
  std::vector<float> values(size_t{3} * n);
  for (uint32_t v = 0; v < n; ++v)
    values[3 * size_t{v} + 2] = static_cast<float>(mesh.info.vertices[v]);
  if (uv < shape.attribute_count && n > 0) {
    anic::Context context;  // values of vertices are those of a time
    anic_value_output out = anic::value_output(values);
    out.stride = 3 * sizeof(float);
    out.components = 2;
    if (context.create(asset_) && context.seek_frame(options.reference_frame))
      (void)mesh.plan.write_attribute(context, uv, out, 0, n);
    for (uint32_t v = 0; v < n; ++v)  // images begin at their upper edge here
      values[3 * size_t{v} + 1] = 1 - values[3 * size_t{v} + 1];
  }
  auto& buffers = Ogre::HardwareBufferManager::getSingleton();
  if (n == 0 || mesh.info.triangle_count == 0)
    return;
  mesh.uvs =
      buffers.createVertexBuffer(3 * sizeof(float), n, Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  mesh.uvs->writeData(0, values.size() * sizeof(float), values.data(), true);
  mesh.indices =
      buffers.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_32BIT, 3 * mesh.info.triangle_count,
                                Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  mesh.indices->writeData(0, size_t{12} * mesh.info.triangle_count, mesh.info.indices, true);
}

void Clip::make_textures(uint32_t index) {
  constexpr std::array<Ogre::PixelFormat, 3> kFormats = {
      Ogre::PF_FLOAT32_RGBA, Ogre::PF_R32G32B32A32_SINT, Ogre::PF_R16G16B16A16_SINT};
  ClipMesh& mesh = meshes_[index];
  const uint32_t segments = asset_.info().segment_count;
  mesh.first.assign(segments, {0, 0, 0});
  mesh.has_pose.assign(segments, 0);
  std::array<uint32_t, 3> heights = {0, 0, 0};
  std::array<std::vector<unsigned char>, 3> data;
  uint32_t largest = 0, parts = 0;
  for (uint32_t s = 0; s < segments; ++s) {
    anic_basis basis = ANIC_INIT(anic_basis);
    anic_texture_layout layout = ANIC_INIT(anic_texture_layout);
    check(asset_.basis(s, &basis), name_);
    if (basis.mesh != index || basis.target != ANIC_TARGET_POSITIONS ||
        !asset_.texture_layout(s, most_texels(), &layout))
      continue;
    mesh.width = layout.width;
    mesh.rows = layout.rows;
    mesh.has_pose[s] = layout.pose_height > 0;
    const std::array<uint32_t, 3> more = {layout.pose_height, layout.wide_height,
                                          layout.narrow_height};
    for (size_t t = 0; t < 3; ++t) {
      mesh.first[s][t] = heights[t];
      const size_t row = (t == ANIC_TEXTURE_NARROW ? size_t{8} : size_t{16}) * layout.width;
      const size_t begin = data[t].size();
      data[t].resize(begin + row * more[t]);
      check(asset_.write_texture(s, static_cast<anic_texture>(t), layout,
                                 {data[t].data() + begin, data[t].size() - begin}),
            name_);
      heights[t] += more[t];
    }
    largest = std::max(largest, layout.state_floats / 4);
    parts = std::min(parts + 1, static_cast<uint32_t>(ANIC_MAX_PARTS));
  }
  if (parts == 0 || *std::max_element(heights.begin(), heights.end()) > most_texels())
    return;  // geometry interpolation, or too large: by the CPU
  mesh.state_texels = kRowTexels + parts * (kPartTexels + largest);
  static uint32_t number = 0;
  const Ogre::String name = "Anicodec/" + Ogre::StringConverter::toString(number++);
  for (size_t t = 0; t < 3; ++t) {
    mesh.textures[t] = make_texture(name + "/" + Ogre::StringConverter::toString(t), mesh.width,
                                    heights[t], kFormats[t], Ogre::TU_STATIC_WRITE_ONLY);
    if (heights[t] > 0)
      mesh.textures[t]->getBuffer()->blitFromMemory(
          Ogre::PixelBox(mesh.width, heights[t], 1, kFormats[t], data[t].data()));
  }
  make_states(index, kRows);
  auto& materials = Ogre::MaterialManager::getSingleton();
  const Ogre::String& group = Ogre::ResourceGroupManager::INTERNAL_RESOURCE_GROUP_NAME;
  Ogre::MaterialPtr caster = materials.create(name + "/Caster", group);
  set_pass(caster->getTechnique(0)->getPass(0), mesh, states_[index],
           program(Ogre::GPT_FRAGMENT_PROGRAM, "Anicodec/Caster", kCasterShader));
  mesh.material = materials.create(name, group);
  set_pass(mesh.material->getTechnique(0)->getPass(0), mesh, states_[index],
           program(Ogre::GPT_FRAGMENT_PROGRAM, "Anicodec/Fragment", kFragmentShader));
  mesh.material->getTechnique(0)->setShadowCasterMaterial(caster);
}

void Clip::make_states(size_t mesh, uint32_t count) {
  static uint32_t number = 0;
  states_[mesh] = make_texture("Anicodec/State/" + Ogre::StringConverter::toString(number++),
                               meshes_[mesh].state_texels, count, Ogre::PF_FLOAT32_RGBA,
                               Ogre::TU_DYNAMIC_WRITE_ONLY);
}

void Clip::prepare_card() {
  if (on_card_)
    return;
  on_card_ = true;
  row_count_ = kRows;
  states_.resize(meshes_.size());
  for (uint32_t m = 0; m < meshes_.size(); ++m) {
    if (meshes_[m].indices)
      make_textures(m);
  }
  for (uint32_t row = row_count_; row-- > 0;)
    free_rows_.push_back(row);
}

uint32_t Clip::take_row() {
  if (free_rows_.empty()) {  // twice as many; every entity writes its row before it is drawn
    const uint32_t before = row_count_;
    for (size_t m = 0; m < meshes_.size(); ++m) {
      ClipMesh& mesh = meshes_[m];
      if (mesh.state_texels == 0)
        continue;
      Ogre::TextureManager::getSingleton().remove(states_[m]);
      make_states(m, 2 * before);
      for (const Ogre::MaterialPtr& material :
           {mesh.material, mesh.material->getTechnique(0)->getShadowCasterMaterial()})
        material->getTechnique(0)->getPass(0)->getTextureUnitState(3)->setTexture(states_[m]);
    }
    row_count_ = 2 * before;
    for (uint32_t row = row_count_; row-- > before;)
      free_rows_.push_back(row);
  }
  const uint32_t row = free_rows_.back();
  free_rows_.pop_back();
  return row;
}

void Clip::give_row(uint32_t row) {
  free_rows_.push_back(row);
}

void Clip::upload_row(size_t mesh, uint32_t row, float* texels, uint32_t count) {
  states_[mesh]->getBuffer()->blitFromMemory(
      Ogre::PixelBox(count, 1, 1, Ogre::PF_FLOAT32_RGBA, texels),
      Ogre::Box(0, row, count, row + 1));
}

Ogre::MaterialPtr plain_material() {
  auto& manager = Ogre::MaterialManager::getSingleton();
  const Ogre::String& group = Ogre::ResourceGroupManager::INTERNAL_RESOURCE_GROUP_NAME;
  Ogre::MaterialPtr material = manager.getByName("Anicodec/Plain", group);
  if (!material) {
    material = manager.create("Anicodec/Plain", group);
    set_programs(
        material->getTechnique(0)->getPass(0),
        program(Ogre::GPT_VERTEX_PROGRAM, "Anicodec/PlainVertex", kPlainVertexShader),
        program(Ogre::GPT_FRAGMENT_PROGRAM, "Anicodec/PlainFragment", kPlainFragmentShader));
  }
  return material;
}

std::shared_ptr<Clip> shared_clip(const Ogre::String& file, const Ogre::String& group,
                                  bool in_place) {
  static std::map<std::tuple<Ogre::String, Ogre::String, bool>, std::weak_ptr<Clip>> open;
  std::weak_ptr<Clip>& kept = open[{group, file, in_place}];
  std::shared_ptr<Clip> clip = kept.lock();
  if (!clip) {
    clip = std::make_shared<Clip>(file, group, in_place);
    kept = clip;
  }
  return clip;
}

}  // namespace anicodec::ogre
