// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/engines/ogre/ogre_entity.h"

#include "bindings/engines/ogre/ogre_shader.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <Ogre.h>

namespace anicodec::ogre {

/// The triangles of one material of one mesh.
class EntitySection : public Ogre::Renderable {
 public:
  EntitySection(Entity* owner, size_t mesh, uint32_t group) : owner_(owner), mesh_(mesh) {
    const ClipMesh& shared = owner->clip_->mesh(mesh);
    name_ = shared.materials[group];
    colour_ = shared.colours[group];
    indices_ = std::make_unique<Ogre::IndexData>();
    indices_->indexBuffer = shared.indices;
    indices_->indexStart = size_t{3} * shared.info.group_begin[group];
    indices_->indexCount =
        size_t{3} * (shared.info.group_begin[group + 1] - shared.info.group_begin[group]);
    setMaterial({});
  }

  size_t mesh() const { return mesh_; }

  /// Null: the scene's material of the name that the file gives, else a plain one in the colour that it gives.
  void setMaterial(Ogre::MaterialPtr material) {
    auto& manager = Ogre::MaterialManager::getSingleton();
    if (!material && !name_.empty())
      material = manager.getByName(name_);
    material_ = material ? material : plain_material();
    material_->load();
    const Ogre::ColourValue colour =
        material ? material_->getTechnique(0)->getPass(0)->getDiffuse() : colour_;
    setCustomParameter(1, Ogre::Vector4(colour.r, colour.g, colour.b, colour.a));
  }

  void play_on(bool on_card, Ogre::VertexData* data) {
    card_ = on_card;
    data_ = data;
  }

  bool is_on_card() const { return card_; }

  bool is_ready() const { return data_ != nullptr; }

  const Ogre::MaterialPtr& getMaterial() const override {
    return card_ ? owner_->clip_->mesh(mesh_).material : material_;
  }

  void getRenderOperation(Ogre::RenderOperation& op) override {
    op.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
    op.vertexData = data_;
    op.indexData = indices_.get();
    op.useIndexes = true;
    op.srcRenderable = this;
  }

  void getWorldTransforms(Ogre::Matrix4* out) const override {
    *out = owner_->_getParentNodeFullTransform();
    if (owner_->z_up_)
      *out = *out * Ogre::Matrix4(Ogre::Quaternion(Ogre::Degree(-90), Ogre::Vector3::UNIT_X));
  }

  Ogre::Real getSquaredViewDepth(const Ogre::Camera* camera) const override {
    return owner_->getParentNode()->getSquaredViewDepth(camera);
  }

  const Ogre::LightList& getLights() const override { return owner_->queryLights(); }

  bool getCastsShadows() const override { return owner_->getCastShadows(); }

  // Buffers of a mesh belong to the section of its first group.
  std::unique_ptr<Ogre::VertexData> cpu, card;
  std::vector<float> positions;

 private:
  Entity* owner_;
  size_t mesh_;
  Ogre::String name_;
  Ogre::ColourValue colour_;
  Ogre::MaterialPtr material_;
  std::unique_ptr<Ogre::IndexData> indices_;
  Ogre::VertexData* data_ = nullptr;
  bool card_ = false;
};

namespace {

constexpr unsigned short kPositions = 0, kNormals = 1, kUvs = 2, kBefore = 3;  // bindings

std::unique_ptr<Ogre::VertexData> vertex_data(uint32_t count) {
  auto data = std::make_unique<Ogre::VertexData>();
  data->vertexStart = 0;
  data->vertexCount = count;
  return data;
}

Ogre::HardwareVertexBufferSharedPtr moving_buffer(uint32_t vertices) {
  return Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      3 * sizeof(float), vertices, Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
}

/// Three floats a vertex.
class Lock {
 public:
  Lock(const Ogre::VertexData& data, unsigned short binding)
      : buffer_(data.vertexBufferBinding->getBuffer(binding)) {
    memory_ = buffer_->lock(Ogre::HardwareBuffer::HBL_DISCARD);
  }

  ~Lock() { buffer_->unlock(); }

  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  anic_output output() const {
    return anic::output(memory_, buffer_->getSizeInBytes(), ANIC_FORMAT_FLOAT32X3);
  }

  void* memory() const { return memory_; }

 private:
  Ogre::HardwareVertexBufferSharedPtr buffer_;
  void* memory_;
};

Ogre::AxisAlignedBox box_of(const anic_box& box, bool z_up) {
  if (!z_up)
    return {box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]};
  return {box.min[0], box.min[2], -box.max[1], box.max[0], box.max[2], -box.min[1]};
}

}  // namespace

Entity::Entity(const Ogre::String& name, std::shared_ptr<Clip> clip, Path path)
    : MovableObject(name), clip_(std::move(clip)), path_(path) {
  if (!context_.create(clip_->asset()))
    OGRE_EXCEPT(Ogre::Exception::ERR_INTERNAL_ERROR, "no memory for a context", "anicodec");
  if (path_ == Path::kCard) {
    clip_->prepare_card();
    row_ = clip_->take_row();
  }
  z_up_ = asset().info().up == ANIC_UP_Z;
  for (size_t m = 0; m < clip_->mesh_count(); ++m) {
    if (!clip_->mesh(m).indices)
      continue;
    for (uint32_t g = 0; g < clip_->mesh(m).info.group_count; ++g)
      sections_.push_back(std::make_unique<EntitySection>(this, m, g));
    anic_box box;
    if (asset().bounds(&box, static_cast<uint32_t>(m)))
      box_.merge(box_of(box, z_up_));
  }
  for (const auto& section : sections_)
    section->setCustomParameter(0, Ogre::Vector4(static_cast<Ogre::Real>(row_), 0, 0, 0));
  radius_ = Ogre::Math::boundingRadiusFromAABB(box_);
}

Entity::~Entity() {
  if (path_ == Path::kCard)
    clip_->give_row(row_);
}

void Entity::set_clip(const Ogre::String& name) {
  playing_ = clip_->find(name);
  fade_length_ = 0;
  set_time(0);
}

void Entity::set_time(double seconds) {
  time_ = seconds;
  stale_ = cut_ = true;
}

void Entity::move_root(double seconds) {
  const double share = is_fading() ? std::min(fade_done_ / fade_length_, 1.0) : 0;
  Ogre::Vector3 move = Ogre::Vector3::ZERO;
  double turn = 0;
  const auto add = [&](uint32_t clip, double time, double weight) {
    anic_root_motion step = ANIC_INIT(anic_root_motion);
    if (!asset().root_step(clip, time, time + seconds, &step, ANIC_SAMPLE_LINEAR, wrap_))
      return;
    turn += weight * step.turn;
    const Ogre::Vector3 way(static_cast<Ogre::Real>(step.move[0]),
                            static_cast<Ogre::Real>(step.move[z_up_ ? 2 : 1]),
                            static_cast<Ogre::Real>(z_up_ ? -step.move[1] : step.move[2]));
    move += static_cast<Ogre::Real>(weight) * way;
  };
  add(playing_, time_, 1 - share);
  if (is_fading())
    add(fading_, fade_time_, share);
  root_->translate(root_->getOrientation() * (root_->getScale() * move));
  root_->yaw(Ogre::Radian(static_cast<Ogre::Real>(turn)));
}

void Entity::add_time(double seconds) {
  if (root_)
    move_root(seconds);
  time_ += seconds;
  stale_ = true;
  if (!is_fading())
    return;
  fade_time_ += seconds;
  fade_done_ += std::abs(seconds);
  if (fade_done_ >= fade_length_) {
    playing_ = fading_;
    time_ = fade_time_;
    fade_length_ = 0;
  }
}

void Entity::cross_fade(const Ogre::String& name, double seconds) {
  fading_ = clip_->find(name);
  fade_time_ = fade_done_ = 0;
  fade_length_ = std::max(seconds, 1e-9);
}

void Entity::set_quality(double quality) {
  if (context_.set_quality(quality))
    stale_ = true;
}

void Entity::set_material(const Ogre::MaterialPtr& material) {
  for (const auto& section : sections_)
    section->setMaterial(material);
}

void Entity::keep_previous(bool wanted) {
  previous_ = wanted;
  stale_ = true;
  for (const auto& section : sections_)
    section->cpu.reset();
}

bool Entity::is_on_card() const {
  return std::all_of(sections_.begin(), sections_.end(),
                     [](const auto& section) { return section->is_on_card(); });
}

const std::vector<float>& Entity::positions(size_t mesh) const {
  static const std::vector<float> none;
  for (const auto& section : sections_) {
    if (section->mesh() == mesh)
      return section->positions;
  }
  return none;
}

const Ogre::String& Entity::getMovableType() const {
  return EntityFactory::kType;
}

void Entity::show() {
  (void)context_.set_clip(playing_);
  (void)context_.seek(time_, ANIC_SAMPLE_LINEAR, wrap_);
  if (is_fading())
    (void)context_.blend(fading_, fade_time_, std::min(fade_done_ / fade_length_, 1.0),
                         ANIC_SAMPLE_LINEAR, wrap_);
  // Motion reaches from one frame that is drawn to the next one.
  const unsigned long frame = Ogre::Root::getSingleton().getNextFrameNumber();
  if (cut_ || frame > drawn_ + 1)
    (void)context_.forget_previous();
  drawn_ = frame;
  cut_ = false;
}

bool Entity::fill_row(size_t mesh) {
  const ClipMesh& shared = clip_->mesh(mesh);
  const auto m = static_cast<uint32_t>(mesh);
  anic_parts parts = ANIC_INIT(anic_parts);
  if (!shared.material || !context_.parts(&parts, ANIC_WHEN_CURRENT, m))
    return false;
  for (uint32_t p = 0; p < parts.count; ++p) {
    if (parts.parts[p].correction_count > 0 || parts.parts[p].shape)
      return false;
  }
  texels_.assign(size_t{4} * shared.state_texels, 0);
  texels_[0] = static_cast<float>(parts.count);
  size_t at = size_t{4} * kRowTexels;
  for (uint32_t p = 0; p < parts.count; ++p) {
    const uint32_t segment = parts.parts[p].segment;
    anic_basis basis = ANIC_INIT(anic_basis);
    anic_texture_layout layout = ANIC_INIT(anic_texture_layout);
    if (!asset().basis(segment, &basis) || !asset().texture_layout(segment, 8192, &layout) ||
        at + size_t{4} * kPartTexels + layout.state_floats > texels_.size())
      return false;
    const bool vectors = basis.channels == 3;
    const size_t texels = kPartTexels + layout.state_floats / 4;
    float* head = texels_.data() + at;
    head[0] = static_cast<float>(shared.first[segment][ANIC_TEXTURE_NARROW]);
    head[1] = static_cast<float>(shared.first[segment][ANIC_TEXTURE_WIDE]);
    head[2] = shared.has_pose[segment] != 0
                  ? static_cast<float>(shared.first[segment][ANIC_TEXTURE_POSE])
                  : -1.0F;
    head[3] = static_cast<float>(texels);
    head[4] = vectors ? 1 : 0;
    head[5] = static_cast<float>((basis.wide_components + 3) / 4 * (vectors ? 1 : 3));
    head[6] = static_cast<float>(layout.state_floats / 4 / layout.regions);
    if (!context_.write_state(p, {head + 4 * kPartTexels, layout.state_floats}, ANIC_WHEN_CURRENT,
                              m))
      return false;
    at += 4 * texels;
  }
  clip_->upload_row(mesh, row_, texels_.data(), static_cast<uint32_t>(at / 4));
  return true;
}

void Entity::fill_buffers(size_t mesh) {
  const ClipMesh& shared = clip_->mesh(mesh);
  const uint32_t n = shared.info.vertex_count;
  EntitySection& first = **std::find_if(sections_.begin(), sections_.end(),
                                        [&](const auto& s) { return s->mesh() == mesh; });
  if (!first.cpu) {
    first.cpu = vertex_data(n);
    Ogre::VertexDeclaration* declaration = first.cpu->vertexDeclaration;
    Ogre::VertexBufferBinding* binding = first.cpu->vertexBufferBinding;
    declaration->addElement(kPositions, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
    declaration->addElement(kNormals, 0, Ogre::VET_FLOAT3, Ogre::VES_NORMAL);
    declaration->addElement(kUvs, 0, Ogre::VET_FLOAT2, Ogre::VES_TEXTURE_COORDINATES, 0);
    binding->setBinding(kPositions, moving_buffer(n));
    binding->setBinding(kNormals, moving_buffer(n));
    binding->setBinding(kUvs, shared.uvs);
    if (previous_) {
      declaration->addElement(kBefore, 0, Ogre::VET_FLOAT3, Ogre::VES_TEXTURE_COORDINATES, 7);
      binding->setBinding(kBefore, moving_buffer(n));
    }
    first.positions.resize(size_t{3} * n);
  }
  // Normals read positions, which buffers of the card are not made for: a copy here.
  const bool present =
      static_cast<bool>(shared.plan.write_positions(context_, anic::output(first.positions), 0, n));
  for (const auto& section : sections_) {
    if (section->mesh() == mesh)
      section->play_on(false, present ? first.cpu.get() : nullptr);
  }
  if (!present)
    return;
  {
    const Lock to(*first.cpu, kPositions);
    std::memcpy(to.memory(), first.positions.data(), first.positions.size() * sizeof(float));
  }
  {
    const Lock to(*first.cpu, kNormals);
    (void)shared.plan.write_normals(first.positions.data(), to.output(), 0, n);
  }
  if (previous_) {
    const Lock to(*first.cpu, kBefore);
    if (!shared.plan.write_positions(context_, to.output(), 0, n, ANIC_WHEN_PREVIOUS))
      std::memcpy(to.memory(), first.positions.data(), first.positions.size() * sizeof(float));
  }
}

void Entity::fill(size_t mesh) {
  if (path_ != Path::kCard || !fill_row(mesh)) {
    fill_buffers(mesh);
    return;
  }
  const ClipMesh& shared = clip_->mesh(mesh);
  for (const auto& section : sections_) {
    if (section->mesh() != mesh)
      continue;
    if (!section->card) {
      section->card = vertex_data(shared.info.vertex_count);
      Ogre::VertexDeclaration* declaration = section->card->vertexDeclaration;
      declaration->addElement(0, 0, Ogre::VET_FLOAT2, Ogre::VES_TEXTURE_COORDINATES, 0);
      declaration->addElement(0, 2 * sizeof(float), Ogre::VET_FLOAT1, Ogre::VES_TEXTURE_COORDINATES,
                              1);
      section->card->vertexBufferBinding->setBinding(0, shared.uvs);
    }
    section->play_on(true, section->card.get());
  }
}

void Entity::_updateRenderQueue(Ogre::RenderQueue* queue) {
  const bool moved = path_ == Path::kCard && generation_ != clip_->generation();
  if (stale_)
    show();
  if (stale_ || moved) {
    for (size_t m = 0; m < clip_->mesh_count(); ++m) {
      if (clip_->mesh(m).indices)
        fill(m);
    }
    generation_ = clip_->generation();
    stale_ = false;
  }
  for (const auto& section : sections_) {
    if (!section->is_ready())
      continue;
    if (mRenderQueueIDSet)
      queue->addRenderable(section.get(), mRenderQueueID);
    else
      queue->addRenderable(section.get());
  }
}

void Entity::visitRenderables(Ogre::Renderable::Visitor* visitor, bool) {
  for (const auto& section : sections_)
    visitor->visit(section.get(), 0, false);
}

const Ogre::String EntityFactory::kType = "Anic";

Ogre::MovableObject* EntityFactory::createInstanceImpl(const Ogre::String& name,
                                                       const Ogre::NameValuePairList* parameters) {
  const auto given = [&](const char* key, const Ogre::String& otherwise) {
    if (!parameters)
      return otherwise;
    const auto found = parameters->find(key);
    return found == parameters->end() ? otherwise : found->second;
  };
  const Ogre::String file = given("file", "");
  if (file.empty())
    OGRE_EXCEPT(Ogre::Exception::ERR_INVALIDPARAMS, "the parameter `file` is missing", "anicodec");
  const Ogre::String group =
      given("group", Ogre::ResourceGroupManager::AUTODETECT_RESOURCE_GROUP_NAME);
  return new Entity(name, shared_clip(file, group, given("in_place", "false") == "true"),
                    given("path", "cpu") == "card" ? Entity::Path::kCard : Entity::Path::kCpu);
}

}  // namespace anicodec::ogre
