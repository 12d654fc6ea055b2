// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets/check.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace gloam {
namespace {

bool is_finite(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string quoted(const char* kind, const std::string& name, std::size_t index) {
  return kind + std::string(" ") + std::to_string(index) + (name.empty() ? "" : " ('" + name + "')");
}

/// A stream that has one value a vertex, or none.
template <class T>
std::string length_fault(const char* stream, const std::vector<T>& values, std::size_t vertices) {
  if (values.empty() || values.size() == vertices) return {};
  return "has " + std::to_string(values.size()) + " " + stream + " for " + std::to_string(vertices) + " positions";
}

std::string stream_fault(const Primitive& p) {
  const std::size_t vertices = p.positions.size();
  for (std::string fault :
       {length_fault("normals", p.normals, vertices), length_fault("tangents", p.tangents, vertices),
        length_fault("texture coordinates", p.uv0, vertices),
        length_fault("second texture coordinates", p.uv1, vertices), length_fault("colours", p.colors, vertices),
        length_fault("joints", p.joints, vertices), length_fault("weights", p.weights, vertices)})
    if (!fault.empty()) return fault;
  if (p.joints.empty() != p.weights.empty()) return "has joints without weights, or weights without joints";
  for (const Primitive::MorphTarget& target : p.morph_targets)
    for (std::string fault : {length_fault("offsets of a morph target", target.positions, vertices),
                              length_fault("normals of a morph target", target.normals, vertices)})
      if (!fault.empty()) return fault;
  return {};
}

/// A material, texture or image that something refers to.
std::string reference_fault(const SceneAssets& assets, AssetKind kind, std::uint32_t index) {
  if (index == kNone) return {};
  const std::string asset = std::string("has the ") + name_of(kind) + " " + std::to_string(index);
  if (index >= assets.count(kind)) return asset + " of " + std::to_string(assets.count(kind));
  return assets.is_destroyed(kind, index) ? asset + ", which was destroyed" : "";
}

std::string primitive_fault(const Primitive& p, const SceneAssets& assets) {
  if (p.positions.empty() && p.indices.empty()) return {};  // draws nothing
  if (p.normals.empty() && !p.positions.empty()) return "has no normals: complete_primitive() computes them";
  if (std::string fault = stream_fault(p); !fault.empty()) return fault;
  if (p.indices.size() % 3 != 0) return "has " + std::to_string(p.indices.size()) + " indices, which are no triangles";
  const auto past = std::ranges::find_if(p.indices, [&](std::uint32_t index) { return index >= p.positions.size(); });
  if (past != p.indices.end())
    return "has the index " + std::to_string(*past) + " for " + std::to_string(p.positions.size()) + " positions";
  if (!std::ranges::all_of(p.positions, is_finite)) return "has a position that is not finite";
  if (p.bounds.empty()) return "has no bounds: complete_primitive() computes them";
  if (!is_finite(p.bounds.min) || !is_finite(p.bounds.max)) return "has bounds that are not finite";
  return reference_fault(assets, AssetKind::material, p.material);
}

std::string mesh_fault(const SceneAssets& assets, std::uint32_t index) {
  const Mesh& mesh = assets.meshes[index];
  const std::string name = quoted("mesh", mesh.name, index);
  bool draws = false;
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    const std::string fault = primitive_fault(mesh.primitives[p], assets);
    if (!fault.empty()) return "primitive " + std::to_string(p) + " of " + name + " " + fault;
    draws = draws || !mesh.primitives[p].indices.empty();
  }
  if (draws && mesh.bounds.empty()) return name + " has no bounds: complete_mesh() computes them";
  return {};
}

std::string material_fault(const SceneAssets& assets, std::uint32_t index) {
  const Material& material = assets.materials[index];
  const std::string name = quoted("material", material.name, index);
  for (const TextureSlot* slot : {&material.base_color_texture, &material.metallic_roughness_texture,
                                  &material.normal_texture, &material.occlusion_texture, &material.emissive_texture}) {
    const std::string fault = reference_fault(assets, AssetKind::texture, slot->texture);
    if (!fault.empty()) return name + " " + fault;
    if (slot->uv_set > 1) return name + " has a texture with the coordinate set " + std::to_string(slot->uv_set);
  }
  return {};
}

std::string texture_fault(const SceneAssets& assets, std::uint32_t index) {
  const Texture& texture = assets.textures[index];
  const std::string fault = reference_fault(assets, AssetKind::image, texture.image);
  return fault.empty() ? "" : quoted("texture", texture.name, index) + " " + fault;
}

std::string image_fault(const SceneAssets& assets, std::uint32_t index) {
  if (assets.is_destroyed(AssetKind::image, index)) return {};
  const Image& image = assets.images[index];
  const std::string name = quoted("image", image.name, index);
  if (image.width == 0 || image.height == 0) return name + " has no pixels";
  if (image.rgba.size() != std::size_t{image.width} * image.height * 4)
    return name + " has " + std::to_string(image.rgba.size()) + " bytes for " + std::to_string(image.width) + "x" +
           std::to_string(image.height) + " pixels of 4 bytes";
  return {};
}

/// Whether the asset was destroyed after `revision`.
bool destroyed_since(const SceneAssets& assets, AssetKind kind, std::uint32_t index, std::uint64_t revision) {
  return index < assets.count(kind) && assets.is_destroyed(kind, index) && assets.destroyed_at(kind, index) > revision;
}

/// An asset that refers to one that was destroyed after `revision`.
std::string dangling_fault(const SceneAssets& assets, std::uint64_t revision) {
  const auto gone = [&](AssetKind kind, std::uint32_t index) { return destroyed_since(assets, kind, index, revision); };
  for (std::uint32_t m = 0; m < assets.meshes.size(); ++m)
    for (const Primitive& primitive : assets.meshes[m].primitives)
      if (gone(AssetKind::material, primitive.material)) return mesh_fault(assets, m);
  for (std::uint32_t m = 0; m < assets.materials.size(); ++m) {
    const Material& material = assets.materials[m];
    for (const TextureSlot* slot : {&material.base_color_texture, &material.metallic_roughness_texture,
                                    &material.normal_texture, &material.occlusion_texture, &material.emissive_texture})
      if (gone(AssetKind::texture, slot->texture)) return material_fault(assets, m);
  }
  for (std::uint32_t t = 0; t < assets.textures.size(); ++t)
    if (gone(AssetKind::image, assets.textures[t].image)) return texture_fault(assets, t);
  return {};
}

}  // namespace

std::string asset_fault(const SceneAssets& assets, AssetKind kind, std::uint32_t index) {
  switch (kind) {
    case AssetKind::mesh:
      return mesh_fault(assets, index);
    case AssetKind::material:
      return material_fault(assets, index);
    case AssetKind::texture:
      return texture_fault(assets, index);
    case AssetKind::image:
      return image_fault(assets, index);
  }
  return {};
}

std::string asset_fault(const SceneAssets& assets) {
  for (const AssetKind kind : {AssetKind::mesh, AssetKind::material, AssetKind::texture, AssetKind::image})
    for (std::uint32_t index = 0; index < assets.count(kind); ++index)
      if (std::string fault = asset_fault(assets, kind, index); !fault.empty()) return fault;
  return {};
}

std::string asset_fault_since(const SceneAssets& assets, std::uint64_t revision) {
  bool destroyed = false;
  for (const AssetKind kind : {AssetKind::mesh, AssetKind::material, AssetKind::texture, AssetKind::image})
    for (std::uint32_t index = 0; index < assets.count(kind); ++index) {
      if (assets.revision(kind, index) <= revision) continue;
      destroyed = destroyed || assets.is_destroyed(kind, index);
      if (std::string fault = asset_fault(assets, kind, index); !fault.empty()) return fault;
    }
  return destroyed ? dangling_fault(assets, revision) : std::string();
}

}  // namespace gloam
