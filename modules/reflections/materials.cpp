// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/materials.h"

#include <algorithm>
#include <vector>

namespace gloam {
namespace {

Reflective of_material(const SceneAssets& assets, std::uint32_t material) {
  return material < assets.materials.size() ? reflective(assets.materials[material]) : Reflective::no;
}

}  // namespace

Reflective reflective(const Material& material) {
  if (material.reflectivity == 0.0f) return Reflective::no;
  const bool textured = material.metallic_roughness_texture.texture != kNone;
  const bool solid = material.alpha_mode != AlphaMode::blend;
  const bool smooth = solid && (material.roughness < kTooRoughForMirrors || textured);
  if (material.reflectivity < 0.0f && material.roughness >= 1.0f && !textured) return Reflective::no;
  return smooth ? Reflective::mirror : Reflective::rough;
}

ReflectiveMaterials count_reflective(const SceneAssets& assets) {
  std::vector<bool> used(assets.materials.size(), false);
  for (const Mesh& mesh : assets.meshes)
    for (const Primitive& primitive : mesh.primitives)
      if (primitive.material < used.size()) used[primitive.material] = true;
  ReflectiveMaterials count;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const Reflective kind = reflective(assets.materials[i]);
    count.rough += kind == Reflective::rough ? 1 : 0;
    count.mirror += kind == Reflective::mirror ? 1 : 0;
  }
  return count;
}

Reflective strongest_reflection(const SceneAssets& assets, const ViewDraws& draws) {
  Reflective strongest = Reflective::no;
  for (const std::span<const Draw> list : {std::span<const Draw>(draws.solid), std::span<const Draw>(draws.blended)})
    for (const Draw& draw : list) strongest = std::max(strongest, of_material(assets, draw.primitive->material));
  return strongest;
}

}  // namespace gloam
