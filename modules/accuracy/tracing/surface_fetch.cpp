// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/tracing/surface_fetch.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

const Primitive& primitive_of(const SceneAssets& assets, const SurfaceSource& source) {
  if (source.split != nullptr) return *source.split;
  return assets.meshes[source.mesh].primitives[source.primitive];
}

const Material& material_of(const SceneAssets& assets, const Primitive& primitive) {
  static const Material standard;  // of primitives without a material
  return primitive.material < assets.materials.size() ? assets.materials[primitive.material] : standard;
}

/// The unit vector along v; `otherwise` if v is too short.
vec3 unit_or(const vec3& v, const vec3& otherwise) {
  const float length = glm::length(v);
  return length > 1e-20f && std::isfinite(length) ? v / length : otherwise;
}

/// The values of three corners, weighted; `otherwise` where the attribute is absent.
template <class T>
T interpolated(const std::vector<T>& values, const SurfaceHit& hit, const T& otherwise) {
  T sum(0.0f);
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t corner = hit.corners[k];
    sum += hit.share[k] * (corner < values.size() ? values[corner] : otherwise);
  }
  return sum;
}

/// The shading normal of the front side. front_normal: of the triangle.
vec3 interpolated_normal(const Primitive& primitive, const SurfaceSource& source, const SurfaceHit& hit,
                         const vec3& front_normal) {
  const bool deformed = !source.normals.empty();
  if (deformed && primitive.flat_shaded) return front_normal;
  const std::vector<vec3>& normals = deformed ? source.normals : primitive.normals;
  vec3 sum(0.0f);
  for (int k = 0; k < 3; ++k) {
    if (hit.corners[k] >= normals.size()) return front_normal;
    const vec3& normal = normals[hit.corners[k]];
    sum += hit.share[k] * unit_or(deformed ? normal : source.normal_from_mesh * normal, vec3(0.0f));
  }
  return unit_or(sum, front_normal);
}

}  // namespace

bool is_double_sided(const SceneAssets& assets, const SurfaceSource& source) {
  return material_of(assets, primitive_of(assets, source)).double_sided;
}

void fetch_surface(const SceneAssets& assets, const SurfaceSource& source, const SurfaceHit& hit,
                   const TextureFetch& textures, TracedSurface& surface) {
  const Primitive& primitive = primitive_of(assets, source);
  const Material& material = material_of(assets, primitive);
  surface.face_normal = unit_or(hit.winding_normal, -hit.direction);
  if (glm::dot(surface.face_normal, hit.direction) > 0.0f) surface.face_normal = -surface.face_normal;
  // Which side is hit follows from the winding alone: shading normals may lean to the other side.
  const bool back = material.double_sided && (glm::dot(hit.winding_normal, hit.direction) > 0.0f) != source.mirrored;
  const float side = back ? -1.0f : 1.0f;
  surface.normal = side * interpolated_normal(primitive, source, hit, side * surface.face_normal);

  const vec2 uv0 = interpolated(primitive.uv0, hit, vec2(0.0f)), uv1 = interpolated(primitive.uv1, hit, vec2(0.0f));
  const auto sampled = [&](const TextureSlot& slot) {
    const vec3 uv(slot.uv_set == 0 ? uv0 : uv1, 1.0f);
    return textures.sample(assets, slot, {glm::dot(slot.transform_row0, uv), glm::dot(slot.transform_row1, uv)});
  };
  surface.base_color = vec3(material.base_color) * vec3(sampled(material.base_color_texture));
  if (!primitive.colors.empty())
    surface.base_color *= glm::clamp(vec3(interpolated(primitive.colors, hit, vec4(1.0f))), 0.0f, 1.0f);
  const vec4 metallic_roughness = sampled(material.metallic_roughness_texture);
  surface.metallic = std::clamp(material.metallic * metallic_roughness.b, 0.0f, 1.0f);
  surface.roughness = std::clamp(material.roughness * metallic_roughness.g, 0.0f, 1.0f);
  surface.occlusion = 1.0f + material.occlusion_strength * (sampled(material.occlusion_texture).r - 1.0f);
  surface.emissive = material.emissive * vec3(sampled(material.emissive_texture));
  surface.subsurface = material.subsurface;
  const float derived = (1.0f - surface.roughness) * std::lerp(0.5f, 1.0f, surface.metallic);
  surface.reflectivity = material.reflectivity >= 0.0f ? material.reflectivity : derived;
}

}  // namespace gloam
