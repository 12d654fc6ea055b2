// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/math/types.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"

/// The content of a glTF file in plain structs. References are indices, kNone if absent. Nothing is checked until
/// check_document has succeeded.
namespace gloam::gltf {

/// Compressed content of a buffer view (EXT_meshopt_compression).
struct CompressedSource {
  enum class Mode : std::uint8_t { attributes, triangles, indices };
  enum class Filter : std::uint8_t { none, octahedral, quaternion, exponential };

  std::uint32_t buffer = kNone;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t stride = 0;  ///< bytes of a decoded element
  std::uint64_t count = 0;
  Mode mode = Mode::attributes;
  Filter filter = Filter::none;
};

struct BufferView {
  std::uint32_t buffer = kNone;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t stride = 0;  ///< bytes; 0: packed
  std::optional<CompressedSource> compressed;
};

/// Values of glTF's componentType.
enum class ComponentType : std::uint32_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// Sparse elements, which replace some of an accessor's elements.
struct SparseSource {
  std::uint64_t count = 0;
  std::uint32_t index_view = kNone;
  std::uint64_t index_offset = 0;
  ComponentType index_type = ComponentType::u16;
  std::uint32_t value_view = kNone;
  std::uint64_t value_offset = 0;
};

struct Accessor {
  std::uint32_t view = kNone;  ///< kNone: all elements are zero
  std::uint64_t offset = 0;
  std::uint64_t count = 0;
  ComponentType component_type = ComponentType::f32;
  std::uint32_t components = 1;  ///< 1…4, or 16 for a 4×4 matrix; 0: a type that the importer does not use
  bool normalized = false;
  std::optional<SparseSource> sparse;
  /// Accessor of the file that this one was decoded for (KHR_draco_mesh_compression); kNone: it is one of the file.
  std::uint32_t decoded_for = kNone;
};

/// Compressed content of a primitive (KHR_draco_mesh_compression).
struct CompressedMesh {
  std::uint32_t view = kNone;
  std::vector<std::pair<std::string, std::uint32_t>> attributes;  ///< name and unique id in the compressed mesh
};

/// One primitive: its mode, its material and the accessor of each attribute.
struct PrimitiveSource {
  int mode = 4;
  std::uint32_t material = kNone;
  std::uint32_t indices = kNone;
  std::uint32_t position = kNone;
  std::uint32_t normal = kNone;
  std::uint32_t tangent = kNone;
  std::uint32_t uv0 = kNone;
  std::uint32_t uv1 = kNone;
  std::uint32_t color = kNone;
  std::uint32_t joints = kNone;
  std::uint32_t weights = kNone;
  bool more_influences = false;  ///< has a second set of joints (JOINTS_1)
  struct Target {
    std::uint32_t position = kNone;
    std::uint32_t normal = kNone;
  };
  std::vector<Target> targets;
  std::optional<CompressedMesh> compressed;
};

struct MeshSource {
  std::string name;
  std::vector<PrimitiveSource> primitives;
  std::vector<double> weights;
};

/// An image file, given by exactly one of uri, view and bytes.
struct ImageSource {
  std::string name;
  std::string uri;
  std::uint32_t view = kNone;
  std::vector<std::uint8_t> bytes;
  bool fallback = false;  ///< only for readers without EXT_texture_webp: it is neither opened nor decoded
};

struct TextureSource {
  std::string name;
  std::uint32_t image = kNone;
  std::uint32_t sampler = kNone;
};

struct SamplerSource {
  bool nearest = false;
  int wrap_u = 10497;
  int wrap_v = 10497;
};

struct SkinSource {
  std::string name;
  std::vector<std::uint32_t> joints;
  std::uint32_t inverse_bind = kNone;
};

struct AnimationSource {
  std::string name;
  struct Sampler {
    std::uint32_t input = kNone;
    std::uint32_t output = kNone;
    std::string interpolation;
  };
  struct Channel {
    std::uint32_t sampler = kNone;
    std::uint32_t node = kNone;
    std::string path;
  };
  std::vector<Sampler> samplers;
  std::vector<Channel> channels;
};

struct CameraSource {
  std::string name;
  bool orthographic = false;
  double yfov = 0.0;
  double xmag = 0.0;
  double ymag = 0.0;
  double znear = 0.0;
  double zfar = 0.0;
};

/// Accessors of the poses of a node's instances (EXT_mesh_gpu_instancing).
struct InstancingSource {
  std::uint32_t translation = kNone;
  std::uint32_t rotation = kNone;
  std::uint32_t scale = kNone;
};

struct NodeSource {
  std::string name;
  std::vector<std::uint32_t> children;
  std::uint32_t mesh = kNone;
  std::uint32_t skin = kNone;
  std::uint32_t camera = kNone;
  std::optional<dmat4> matrix;
  LocalTransform pose;
  std::vector<double> weights;
  std::uint32_t parent = kNone;  ///< filled by check_node_tree
  std::optional<InstancingSource> instancing;
  // Filled by expand_instances:
  std::uint32_t instanced_mesh = kNone;  ///< mesh of the node's instances, if it has any
  std::uint32_t first_instance = 0;      ///< index of the first instance's node
  std::uint32_t instance_count = 0;
};

struct SceneSource {
  std::string name;
  std::vector<std::uint32_t> nodes;
};

struct Document {
  std::vector<std::vector<std::uint8_t>> buffers;  ///< those of the file, then decompressed ones
  std::size_t file_buffers = 0;                    ///< number of buffers of the file
  std::vector<BufferView> views;
  std::vector<Accessor> accessors;  ///< those of the file, then those of decompressed meshes
  std::vector<MeshSource> meshes;
  std::vector<Material> materials;  ///< texture slots index `textures`
  std::vector<TextureSource> textures;
  std::vector<SamplerSource> samplers;
  std::vector<ImageSource> images;
  std::vector<SkinSource> skins;
  std::vector<AnimationSource> animations;
  std::vector<CameraSource> cameras;
  std::vector<NodeSource> nodes;
  std::vector<SceneSource> scenes;
  std::uint32_t default_scene = kNone;
  std::vector<std::string> warnings;  ///< each holds place and fault
};

}  // namespace gloam::gltf
