// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/asset_check.h"

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
  if (p.material != kNone && p.material >= assets.materials.size())
    return "has the material " + std::to_string(p.material) + " of " + std::to_string(assets.materials.size());
  return {};
}

std::string mesh_fault(const SceneAssets& assets) {
  for (std::size_t m = 0; m < assets.meshes.size(); ++m) {
    const Mesh& mesh = assets.meshes[m];
    const std::string name = quoted("mesh", mesh.name, m);
    bool draws = false;
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const std::string fault = primitive_fault(mesh.primitives[p], assets);
      if (!fault.empty()) return "primitive " + std::to_string(p) + " of " + name + " " + fault;
      draws = draws || !mesh.primitives[p].indices.empty();
    }
    if (draws && mesh.bounds.empty()) return name + " has no bounds: complete_mesh() computes them";
  }
  return {};
}

std::string material_fault(const SceneAssets& assets) {
  for (std::size_t m = 0; m < assets.materials.size(); ++m) {
    const Material& material = assets.materials[m];
    for (const TextureSlot* slot :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture}) {
      const std::string name = quoted("material", material.name, m);
      if (slot->texture != kNone && slot->texture >= assets.textures.size())
        return name + " has the texture " + std::to_string(slot->texture) + " of " +
               std::to_string(assets.textures.size());
      if (slot->uv_set > 1) return name + " has a texture with the coordinate set " + std::to_string(slot->uv_set);
    }
  }
  return {};
}

std::string image_fault(const SceneAssets& assets) {
  for (std::size_t t = 0; t < assets.textures.size(); ++t) {
    const Texture& texture = assets.textures[t];
    if (texture.image != kNone && texture.image >= assets.images.size())
      return quoted("texture", texture.name, t) + " has the image " + std::to_string(texture.image) + " of " +
             std::to_string(assets.images.size());
  }
  for (std::size_t i = 0; i < assets.images.size(); ++i) {
    const Image& image = assets.images[i];
    const std::string name = quoted("image", image.name, i);
    if (image.width == 0 || image.height == 0) return name + " has no pixels";
    if (image.rgba.size() != std::size_t{image.width} * image.height * 4)
      return name + " has " + std::to_string(image.rgba.size()) + " bytes for " + std::to_string(image.width) + "x" +
             std::to_string(image.height) + " pixels of 4 bytes";
  }
  return {};
}

}  // namespace

std::string asset_fault(const SceneAssets& assets) {
  for (std::string fault : {mesh_fault(assets), material_fault(assets), image_fault(assets)})
    if (!fault.empty()) return fault;
  return {};
}

}  // namespace gloam
