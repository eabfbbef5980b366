// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/assimp/assimp_import.h"

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/shininess.h"
#include "tools/io/gltf/gltf_serial.h"
#include "tools/io/guard/guard_message.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace anicodec::tools {
namespace {

constexpr unsigned kInfluencesOfSet = 4;

std::array<double, 16> column_major(const aiMatrix4x4& m) {
  std::array<double, 16> out;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column)
      out[4 * column + row] = static_cast<double>(m[row][column]);
  }
  return out;
}

/// The first image of a kind: a path, or "#name" of one inside the file.
String texture_of(const aiMaterial& from, aiTextureType type) {
  aiString path;
  if (from.GetTexture(type, 0, &path) != aiReturn_SUCCESS || path.length == 0)
    return {};
  String text = path.C_Str();
  if (text[0] == '*')
    text[0] = '#';
  std::replace(text.begin(), text.end(), '\\', '/');
  return text;
}

/// The first of several textures that is there.
String texture_of(const aiMaterial& from, std::initializer_list<aiTextureType> types) {
  for (const aiTextureType type : types) {
    if (String text = texture_of(from, type); !text.empty())
      return text;
  }
  return {};
}

GltfMaterial material(const aiMaterial& from) {
  GltfMaterial out;
  out.name = from.GetName().C_Str();
  MaterialLook& look = out.look;
  look.known = true;
  aiColor4D colour(1, 1, 1, 1);
  if (from.Get(AI_MATKEY_BASE_COLOR, colour) != aiReturn_SUCCESS)
    from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  float opacity = 1, shininess = 0;
  from.Get(AI_MATKEY_OPACITY, opacity);
  look.base_colour = {colour.r, colour.g, colour.b, std::min(colour.a, opacity)};
  if (look.base_colour[3] < 1)
    look.alpha = AlphaMode::kBlend;
  from.Get(AI_MATKEY_METALLIC_FACTOR, look.metallic);
  if (from.Get(AI_MATKEY_ROUGHNESS_FACTOR, look.roughness) != aiReturn_SUCCESS &&
      from.Get(AI_MATKEY_SHININESS, shininess) == aiReturn_SUCCESS)
    look.roughness = roughness_of_shininess(shininess);
  aiColor3D emissive(0, 0, 0);
  from.Get(AI_MATKEY_COLOR_EMISSIVE, emissive);
  look.emissive = {emissive.r, emissive.g, emissive.b};
  int two_sided = 0;
  from.Get(AI_MATKEY_TWOSIDED, two_sided);
  look.double_sided = two_sided != 0;
  look.texture(TextureSlot::kBaseColour) =
      texture_of(from, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
  look.texture(TextureSlot::kMetallicRoughness) =
      texture_of(from, {aiTextureType_METALNESS, aiTextureType_DIFFUSE_ROUGHNESS});
  look.texture(TextureSlot::kNormal) =
      texture_of(from, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA});
  look.texture(TextureSlot::kOcclusion) = texture_of(from, aiTextureType_AMBIENT_OCCLUSION);
  look.texture(TextureSlot::kEmissive) =
      texture_of(from, {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE});
  if (!look.in_range())  // what no renderer can use
    look = {};
  return out;
}

/// Makes a glTF document of a scene, so that both are baked by the same code.
class Converter {
 public:
  Converter(const aiScene& scene, const std::string& path) : scene_(scene) { out_.name = path; }

  GltfDocument convert() {
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i)
      out_.materials.push_back(material(*scene_.mMaterials[i]));
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i)
      out_.meshes.push_back(mesh(*scene_.mMeshes[i]));
    add_node(*scene_.mRootNode, kGltfNone);
    out_.roots = {0};
    for (const auto& [node, meshes] : shown_)
      show(node, meshes);
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i)
      add_animation(*scene_.mAnimations[i]);
    return std::move(out_);
  }

 private:
  template <typename Number>
  uint32_t accessor(const std::vector<Number>& values, uint32_t components, GltfComponent type) {
    std::vector<char>& bytes = out_.buffers.emplace_back(values.size() * sizeof(Number));
    if (!values.empty())
      std::memcpy(bytes.data(), values.data(), bytes.size());
    GltfView view;
    view.bytes = {bytes.data(), bytes.size()};
    out_.views.push_back(std::move(view));
    GltfAccessor accessor;
    accessor.view = static_cast<uint32_t>(out_.views.size() - 1);
    accessor.count = static_cast<uint32_t>(values.size() / components);
    accessor.components = components;
    accessor.type = type;
    out_.accessors.push_back(accessor);
    return static_cast<uint32_t>(out_.accessors.size() - 1);
  }

  uint32_t vectors(const aiVector3D* v, unsigned count, uint32_t components = 3) {
    std::vector<float> values;
    for (unsigned i = 0; i < count; ++i) {
      for (unsigned k = 0; k < components; ++k)
        values.push_back(v[i][k]);
    }
    return accessor(values, components, GltfComponent::kFloat);
  }

  GltfMesh mesh(const aiMesh& source) {
    GltfMesh out;
    out.name = source.mName.C_Str();
    GltfPrimitive& primitive = out.primitives.emplace_back();
    primitive.material = source.mMaterialIndex;
    const unsigned n = source.mNumVertices;
    primitive.attributes["POSITION"] = vectors(source.mVertices, n);
    if (source.HasNormals())
      primitive.attributes["NORMAL"] = vectors(source.mNormals, n);
    for (unsigned set = 0; source.HasTextureCoords(set); ++set) {
      for (unsigned v = 0; v < n; ++v)  // glTF's v points down
        source.mTextureCoords[set][v].y = 1 - source.mTextureCoords[set][v].y;
      primitive.attributes["TEXCOORD_" + std::to_string(set)] =
          vectors(source.mTextureCoords[set], n, 2);
    }
    for (unsigned set = 0; source.HasVertexColors(set); ++set) {
      std::vector<float> colours;
      for (unsigned v = 0; v < n; ++v) {
        const aiColor4D& c = source.mColors[set][v];
        colours.insert(colours.end(), {c.r, c.g, c.b, c.a});
      }
      primitive.attributes["COLOR_" + std::to_string(set)] =
          accessor(colours, 4, GltfComponent::kFloat);
    }
    std::vector<uint32_t> corners;
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
      if (source.mFaces[f].mNumIndices == 3)
        corners.insert(corners.end(), source.mFaces[f].mIndices, source.mFaces[f].mIndices + 3);
    }
    primitive.indices = accessor(corners, 1, GltfComponent::kUint32);
    for (unsigned t = 0; t < source.mNumAnimMeshes; ++t)
      add_target(source, *source.mAnimMeshes[t], primitive, out);
    return out;
  }

  void add_target(const aiMesh& source, const aiAnimMesh& shape, GltfPrimitive& primitive,
                  GltfMesh& out) {
    std::vector<aiVector3D> added(source.mNumVertices);
    for (unsigned v = 0; v < source.mNumVertices && shape.HasPositions(); ++v)
      added[v] = shape.mVertices[v] - source.mVertices[v];
    primitive.targets.push_back({{"POSITION", vectors(added.data(), source.mNumVertices)}});
    out.weights.push_back(static_cast<double>(shape.mWeight));
  }

  /// Gives vertices their influences; `joint_of` has the joint of each bone in the skin.
  void add_weights(const aiMesh& source, const std::vector<uint16_t>& joint_of,
                   GltfPrimitive& primitive) {
    std::vector<std::vector<std::pair<uint16_t, float>>> influences(source.mNumVertices);
    size_t most = 1;
    for (unsigned b = 0; b < source.mNumBones && b < UINT16_MAX; ++b) {
      const aiBone& bone = *source.mBones[b];
      for (unsigned i = 0; i < bone.mNumWeights; ++i) {
        const aiVertexWeight& w = bone.mWeights[i];
        if (w.mVertexId >= source.mNumVertices || !(w.mWeight > 0))
          continue;
        influences[w.mVertexId].emplace_back(joint_of[b], w.mWeight);
        most = std::max(most, influences[w.mVertexId].size());
      }
    }
    for (size_t set = 0; set * kInfluencesOfSet < most; ++set) {
      std::vector<uint16_t> joints;
      std::vector<float> weights;
      for (const auto& of_vertex : influences) {
        for (size_t i = set * kInfluencesOfSet; i < (set + 1) * kInfluencesOfSet; ++i) {
          joints.push_back(i < of_vertex.size() ? of_vertex[i].first : uint16_t{0});
          weights.push_back(i < of_vertex.size() ? of_vertex[i].second : 0.0F);
        }
      }
      const std::string number = std::to_string(set);
      primitive.attributes["JOINTS_" + number] = accessor(joints, 4, GltfComponent::kUint16);
      primitive.attributes["WEIGHTS_" + number] = accessor(weights, 4, GltfComponent::kFloat);
    }
  }

  uint32_t add_node(const aiNode& source, uint32_t parent) {
    const auto index = static_cast<uint32_t>(out_.nodes.size());
    GltfNode& node = out_.nodes.emplace_back();
    node.name = source.mName.C_Str();
    node.parent = parent;
    node.matrix = column_major(source.mTransformation);
    node_of_.emplace(node.name, index);
    if (source.mNumMeshes > 0)
      shown_.emplace_back(index, std::vector(source.mMeshes, source.mMeshes + source.mNumMeshes));
    for (unsigned i = 0; i < source.mNumChildren; ++i) {
      const uint32_t child = add_node(*source.mChildren[i], index);
      out_.nodes[index].children.push_back(child);
    }
    return index;
  }

  /// The bones of some meshes as one skin.
  struct Skin {
    GltfSkin skin;
    std::vector<float> binds;
    std::map<std::pair<uint32_t, std::array<float, 16>>, uint16_t> joint_of;
  };

  /// The joint of each bone of a mesh, added where it is new.
  std::vector<uint16_t> joints_of(const aiMesh& source, Skin& skin) {
    std::vector<uint16_t> joints;
    for (unsigned b = 0; b < source.mNumBones; ++b) {
      const aiBone& bone = *source.mBones[b];
      auto found = node_of_.find(bone.mName.C_Str());
      if (found == node_of_.end())
        fail_input(out_.name, std::string("bone '") + bone.mName.C_Str() + "' has no node");
      std::array<float, 16> bind;
      std::ranges::transform(column_major(bone.mOffsetMatrix), bind.begin(),
                             [](double x) { return static_cast<float>(x); });
      const auto [joint, added] = skin.joint_of.try_emplace(
          {found->second, bind}, static_cast<uint16_t>(skin.skin.joints.size()));
      if (added) {
        if (skin.skin.joints.size() >= UINT16_MAX)
          fail_input(out_.name, "a skin has more than 65535 bones");
        skin.skin.joints.push_back(found->second);
        skin.binds.insert(skin.binds.end(), bind.begin(), bind.end());
      }
      joints.push_back(joint->second);
    }
    return joints;
  }

  /// Shows the meshes of a node, the parts of an object with several materials, as one if they move
  /// alike; each by a node of its own otherwise.
  void show(uint32_t parent, const std::vector<unsigned>& meshes) {
    const bool skinned = scene_.mMeshes[meshes[0]]->HasBones();
    const bool alike = std::ranges::all_of(meshes, [&](unsigned m) {
      return scene_.mMeshes[m]->HasBones() == skinned && scene_.mMeshes[m]->mNumAnimMeshes == 0;
    });
    if (alike || meshes.size() == 1) {
      show_as_one(parent, meshes, skinned);
    } else {
      for (unsigned m : meshes)
        show_as_one(parent, {m}, scene_.mMeshes[m]->HasBones());
    }
  }

  /// A node of glTF has one mesh, and the skin with it.
  void show_as_one(uint32_t parent, const std::vector<unsigned>& meshes, bool skinned) {
    GltfNode node;
    node.name = out_.nodes[parent].name;
    node.parent = parent;
    node.mesh = meshes[0];
    if (skinned || meshes.size() > 1) {
      GltfMesh together = out_.meshes[meshes[0]];
      for (size_t i = 1; i < meshes.size(); ++i)
        together.primitives.push_back(out_.meshes[meshes[i]].primitives[0]);
      Skin skin;
      for (size_t i = 0; skinned && i < meshes.size(); ++i) {
        const aiMesh& source = *scene_.mMeshes[meshes[i]];
        add_weights(source, joints_of(source, skin), together.primitives[i]);
      }
      if (skinned) {
        skin.skin.inverse_binds = accessor(skin.binds, 16, GltfComponent::kFloat);
        node.skin = static_cast<uint32_t>(out_.skins.size());
        out_.skins.push_back(std::move(skin.skin));
      }
      node.mesh = static_cast<uint32_t>(out_.meshes.size());
      out_.meshes.push_back(std::move(together));
    }
    out_.nodes[parent].children.push_back(static_cast<uint32_t>(out_.nodes.size()));
    out_.nodes.push_back(std::move(node));
  }

  /// Adds a channel; the components of each value have been put one after the other.
  void add_channel(GltfAnimation& animation, uint32_t node, GltfPath path,
                   const std::vector<float>& times, const std::vector<float>& values,
                   uint32_t components) {
    if (times.empty())
      return;
    GltfSampler sampler;
    sampler.input = accessor(times, 1, GltfComponent::kFloat);
    sampler.output = accessor(values, components, GltfComponent::kFloat);
    animation.samplers.push_back(sampler);
    animation.channels.push_back(
        {static_cast<uint32_t>(animation.samplers.size() - 1), node, path});
  }

  template <typename Key, typename Values>
  void add_keys(GltfAnimation& animation, uint32_t node, GltfPath path, const Key* keys,
                unsigned count, double ticks, uint32_t components, Values values_of) {
    std::vector<float> times, values;
    for (unsigned k = 0; k < count; ++k) {
      times.push_back(static_cast<float>(std::max(0.0, keys[k].mTime / ticks)));
      values_of(keys[k], values);
    }
    add_channel(animation, node, path, times, values, components);
  }

  void add_animation(const aiAnimation& source) {
    GltfAnimation animation;
    animation.name = source.mName.C_Str();
    constexpr double kUsualTicks = 25;
    const double ticks = source.mTicksPerSecond > 0 ? source.mTicksPerSecond : kUsualTicks;
    auto add_vector = [](const aiVectorKey& key, std::vector<float>& values) {
      values.insert(values.end(), {key.mValue.x, key.mValue.y, key.mValue.z});
    };
    for (unsigned i = 0; i < source.mNumChannels; ++i) {
      const aiNodeAnim& channel = *source.mChannels[i];
      auto found = node_of_.find(channel.mNodeName.C_Str());
      if (found == node_of_.end())
        continue;
      const uint32_t n = found->second;
      split_matrix(n, channel.mNodeName);
      add_keys(animation, n, GltfPath::kTranslation, channel.mPositionKeys,
               channel.mNumPositionKeys, ticks, 3, add_vector);
      add_keys(animation, n, GltfPath::kScale, channel.mScalingKeys, channel.mNumScalingKeys, ticks,
               3, add_vector);
      add_keys(
          animation, n, GltfPath::kRotation, channel.mRotationKeys, channel.mNumRotationKeys, ticks,
          4, [](const aiQuatKey& key, std::vector<float>& values) {
            values.insert(values.end(), {key.mValue.x, key.mValue.y, key.mValue.z, key.mValue.w});
          });
    }
    for (unsigned i = 0; i < source.mNumMorphMeshChannels; ++i)
      add_morph(animation, *source.mMorphMeshChannels[i], ticks);
    out_.animations.push_back(std::move(animation));
  }

  void split_matrix(uint32_t n, const aiString& name) {
    if (!out_.nodes[n].matrix)
      return;
    aiVector3D scale, translation;
    aiQuaternion rotation;
    scene_.mRootNode->FindNode(name)->mTransformation.Decompose(scale, rotation, translation);
    GltfNode& node = out_.nodes[n];
    node.matrix.reset();
    for (unsigned k = 0; k < 3; ++k) {
      node.translation[k] = static_cast<double>(translation[k]);
      node.scale[k] = static_cast<double>(scale[k]);
    }
    node.rotation = {static_cast<double>(rotation.x), static_cast<double>(rotation.y),
                     static_cast<double>(rotation.z), static_cast<double>(rotation.w)};
  }

  /// Weights of the shapes of the meshes that the named node shows.
  void add_morph(GltfAnimation& animation, const aiMeshMorphAnim& source, double ticks) {
    // Some importers add "*" and a number to the name of the node.
    const std::string name = source.mName.C_Str();
    const std::string node_name = name.substr(0, name.find('*'));
    for (uint32_t n = 0; n < out_.nodes.size(); ++n) {
      const GltfNode& node = out_.nodes[n];
      if (node.mesh == kGltfNone ||
          (node.name != node_name && out_.meshes[node.mesh].name != node_name))
        continue;
      const size_t targets = out_.meshes[node.mesh].weights.size();
      if (targets == 0)
        continue;
      add_keys(animation, n, GltfPath::kWeights, source.mKeys, source.mNumKeys, ticks, 1,
               [targets](const aiMeshMorphKey& key, std::vector<float>& values) {
                 const size_t first = values.size();
                 values.resize(first + targets);
                 for (unsigned i = 0; i < key.mNumValuesAndWeights; ++i) {
                   if (key.mValues[i] < targets)
                     values[first + key.mValues[i]] = static_cast<float>(key.mWeights[i]);
                 }
               });
    }
  }

  const aiScene& scene_;
  GltfDocument out_;
  std::map<std::string, uint32_t> node_of_;
  std::vector<std::pair<uint32_t, std::vector<unsigned>>> shown_;  ///< node, meshes
};

/// Files that a scene names, such as the shapes of a skeleton: those in its folder, or all.
class SceneFiles : public Assimp::DefaultIOSystem {
 public:
  SceneFiles(const std::string& scene, bool allow_outside)
      : scene_(normal(scene)), folder_(scene_.parent_path()), allow_outside_(allow_outside) {}

  bool Exists(const char* file) const override {
    return may_open(file) && DefaultIOSystem::Exists(file);
  }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return may_open(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  static std::filesystem::path normal(const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal();
  }

  bool may_open(const char* file) const {
    if (*file == 0)  // has no absolute path
      return false;
    const std::filesystem::path path = normal(file);
    const std::filesystem::path inner = path.lexically_relative(folder_);
    return allow_outside_ || path == scene_ || (!inner.empty() && *inner.begin() != "..");
  }

  std::filesystem::path scene_, folder_;
  bool allow_outside_;
};

const aiScene& import(Assimp::Importer& importer, const std::string& path, unsigned steps) {
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES,
                           true);  // which would stand for bones without a mesh
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_SortByPType |
                                                     aiProcess_ValidateDataStructure | steps);
  if (!scene || !scene->mRootNode)
    fail_input(path, importer.GetErrorString());
  return *scene;
}

std::string import_scenes(const std::string& path, uint32_t frames, bool allow_outside) {
  std::string out;
  for (uint32_t f = 0; f < std::max(frames, 1U); ++f) {
    Assimp::Importer importer;
    importer.SetIOHandler(new SceneFiles(path, allow_outside));  // the importer owns it
    if (frames > 0)
      importer.SetPropertyInteger(AI_CONFIG_IMPORT_GLOBAL_KEYFRAME, static_cast<int>(f));
    const aiScene& scene =
        import(importer, path, frames > 0 ? 0U : aiProcess_JoinIdenticalVertices + 0U);
    append_values(glb_of(Converter(scene, path).convert()), out);
  }
  return out;
}

}  // namespace
}  // namespace anicodec::tools

extern "C" __attribute__((visibility("default"))) int anicodec_import_with_assimp(
    const char* path, uint32_t frames, int allow_outside, void* user,
    anicodec::tools::TakeBytes take) {
  using namespace anicodec::tools;
  try {
    const std::string bytes = import_scenes(path, frames, allow_outside != 0);
    take(user, bytes.data(), bytes.size());
    return 0;
  } catch (const std::bad_alloc&) {
    throw;  // the process that may take no more memory says so
  } catch (const std::exception& e) {
    take(user, e.what(), std::strlen(e.what()));
    return 1;
  }
}
