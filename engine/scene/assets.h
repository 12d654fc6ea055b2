// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/math/bounds.h"
#include "engine/math/types.h"

namespace gloam {

inline constexpr std::uint32_t kNone = ~0u;

/// Vertex data of one triangle list, one array per attribute. An optional array is empty or as long as `positions`.
/// complete_primitive() (mesh_builder.h) computes what it says below.
struct Primitive {
  std::uint32_t material = kNone;  ///< index into SceneAssets::materials; kNone: the default material
  std::vector<vec3> positions;     ///< required, finite
  std::vector<vec3> normals;       ///< required, unit length; complete_primitive() computes them
  std::vector<vec4> tangents;  ///< optional; xyz unit tangent, w = ±1 handedness; for materials with a normal texture
  std::vector<vec2> uv0;       ///< optional
  std::vector<vec2> uv1;       ///< optional
  std::vector<vec4> colors;    ///< optional; linear, multiplied with the base colour
  std::vector<std::array<std::uint16_t, 4>> joints;  ///< optional, together with weights
  std::vector<vec4> weights;                         ///< sum to 1 per vertex
  std::vector<std::uint32_t> indices;                ///< required, three a triangle; complete_primitive(): 0, 1, 2, …
  struct MorphTarget {
    std::vector<vec3> positions;  ///< offsets from the rest positions
    std::vector<vec3> normals;    ///< offsets from the rest normals; may be empty
  };
  std::vector<MorphTarget> morph_targets;
  /// The normals are those of the triangles at rest. Morphed and skinned, the primitive is shaded with the normals of
  /// its triangles as they are drawn.
  bool flat_shaded = false;
  Aabb bounds;  ///< required: of the rest positions; complete_primitive() computes it
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> morph_weights;  ///< default weights, one per target
  Aabb bounds;
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Texture, coordinate set, and KHR_texture_transform as a 2×3 matrix: uv' = (row0·(u,v,1), row1·(u,v,1)).
struct TextureSlot {
  std::uint32_t texture = kNone;  ///< index into SceneAssets::textures
  std::uint32_t uv_set = 0;       ///< 0 or 1
  vec3 transform_row0 = vec3(1.0f, 0.0f, 0.0f);
  vec3 transform_row1 = vec3(0.0f, 1.0f, 0.0f);
};

struct Material {
  std::string name;
  vec4 base_color = vec4(1.0f);
  vec3 emissive = vec3(0.0f);  ///< linear, emissive strength included, cd/m²
  float metallic = 1.0f;
  float roughness = 1.0f;
  float normal_scale = 1.0f;
  float occlusion_strength = 1.0f;
  float alpha_cutoff = 0.5f;
  AlphaMode alpha_mode = AlphaMode::opaque;
  bool double_sided = false;
  TextureSlot base_color_texture;
  TextureSlot metallic_roughness_texture;
  TextureSlot normal_texture;
  TextureSlot occlusion_texture;
  TextureSlot emissive_texture;
  /// The file names a roughness or a texture of it; if not, `roughness` is the default. For key gloam.reflectivity.
  bool names_roughness = true;
  // Set by scene keys:
  bool subsurface = false;     ///< light passes through thin parts
  float extinction_m = -1.0f;  ///< of subsurface: length over which light inside falls to 1/e; < 0: kExtinctionM
  float reflectivity = -1.0f;  ///< < 0: derived from metallic and roughness
};

/// Default extinction length: between skin in red light (3.7 mm) and marble (4 to 8.5 mm), which are 1 / sqrt(3
/// absorption (absorption + reduced scattering)) of the measurements of Jensen et al. 2001.
inline constexpr double kExtinctionM = 0.005;
/// The material's extinction length in metres; 0: no light passes through it.
[[nodiscard]] inline float extinction_length(const Material& material) {
  if (!material.subsurface) return 0.0f;
  return material.extinction_m < 0.0f ? static_cast<float>(kExtinctionM) : material.extinction_m;
}

/// Whether surfaces of this material give light of their own.
[[nodiscard]] inline bool is_emissive(const Material& material) {
  return material.emissive.x > 0.0f || material.emissive.y > 0.0f || material.emissive.z > 0.0f;
}

enum class WrapMode : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

/// An 8-bit RGBA image and its sampler settings. `srgb`: the image holds colours, not data.
struct Texture {
  std::string name;
  std::uint32_t image = kNone;
  bool srgb = false;
  bool nearest = false;
  WrapMode wrap_u = WrapMode::repeat;
  WrapMode wrap_v = WrapMode::repeat;
};

struct Image {
  std::string name;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;  ///< width · height · 4 bytes, rows from the top
};

struct Skin {
  std::string name;
  std::vector<std::uint32_t> joint_nodes;  ///< glTF node indices, see SceneInfo::node_entities
  std::vector<mat4> inverse_bind;          ///< one per joint
};

enum class AnimationPath : std::uint8_t { translation, rotation, scale, weights };
enum class Interpolation : std::uint8_t { step, linear, cubic };

/// Key frames of one property of one node. A key has `width` components (3, 4, or the number of morph targets); a cubic
/// key has three times as many in `values` (in-tangent, value, out-tangent).
struct AnimationChannel {
  std::uint32_t node = kNone;  ///< glTF node index
  AnimationPath path = AnimationPath::translation;
  Interpolation interpolation = Interpolation::linear;
  std::uint32_t width = 3;
  std::vector<float> times;  ///< seconds, strictly increasing, at least one
  std::vector<float> values;
};

struct AnimationClip {
  std::string name;
  float duration_s = 0.0f;
  std::vector<AnimationChannel> channels;
};

enum class AssetKind : std::uint8_t { mesh, material, texture, image };

/// Data that the entities of a scene share. A resource of the world, filled by the importer or by code.
///
/// After the first frame single assets are changed, added and destroyed with the functions below; the renderer uploads
/// only those (RendererOptions::upload_budget). Assets that were appended to the lists without add() are found too.
/// Increment `version` after any other change: everything is then uploaded again, and the frame waits for it. Skins and
/// clips have no such functions.
///
/// Indices stay valid. A destroyed asset leaves an empty place, which add() uses again. What an asset refers to must be
/// there when a frame is drawn: the renderer asserts that no primitive has a destroyed material, no material a
/// destroyed texture and no texture a destroyed image.
struct SceneAssets {
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Image> images;
  std::vector<Skin> skins;
  std::vector<AnimationClip> clips;
  std::uint64_t version = 1;

  /// Adds an asset and returns its index: that of a destroyed asset of its kind, or a new one.
  std::uint32_t add(Mesh mesh);
  std::uint32_t add(Material material);
  std::uint32_t add(Texture texture);
  std::uint32_t add(Image image);
  /// Call it after the asset was written to. Asserts that it exists.
  void mark_changed(AssetKind kind, std::uint32_t index);
  /// Frees the asset's data and leaves a default one in its place. Asserts that it exists. Instances of a destroyed
  /// mesh draw nothing.
  void destroy(AssetKind kind, std::uint32_t index);

  [[nodiscard]] std::size_t count(AssetKind kind) const;  ///< destroyed ones included
  [[nodiscard]] bool is_destroyed(AssetKind kind, std::uint32_t index) const;
  /// Grows with each call of the functions above; 0 before the first.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  /// revision() after the last call that concerned the asset; 0 if there was none.
  [[nodiscard]] std::uint64_t revision(AssetKind kind, std::uint32_t index) const;
  /// revision() after the asset was destroyed last, if another one has its place now or none; 0 if it never was.
  [[nodiscard]] std::uint64_t destroyed_at(AssetKind kind, std::uint32_t index) const;

 private:
  /// The calls of changed() and destroy() for the assets of one kind, by index. May be shorter than the list of assets:
  /// the remaining ones have no calls.
  struct Changes {
    std::vector<std::uint64_t> revisions;
    std::vector<std::uint64_t> destroyed_at;
    std::vector<std::uint32_t> free;  ///< destroyed, the last one is used first
  };
  template <class T>
  std::uint32_t add_to(std::vector<T>& list, AssetKind kind, T asset);
  [[nodiscard]] Changes& of(AssetKind kind) { return changes_[static_cast<std::size_t>(kind)]; }
  [[nodiscard]] const Changes& of(AssetKind kind) const { return changes_[static_cast<std::size_t>(kind)]; }
  void check_exists(AssetKind kind, std::uint32_t index) const;

  std::array<Changes, 4> changes_;
  std::uint64_t revision_ = 0;
};

[[nodiscard]] const char* name_of(AssetKind kind);

}  // namespace gloam
