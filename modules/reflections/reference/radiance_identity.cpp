// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <span>
#include <vector>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/reflections/reference/reflection_tracing.h"
#include "modules/shadows/components.h"

namespace gloam {
namespace {

void add_assets(Hasher& hasher, const SceneAssets& assets) {
  for (const Mesh& mesh : assets.meshes)
    for (const Primitive& primitive : mesh.primitives) {
      hasher.value(primitive.material);
      hasher.items(primitive.normals);
      hasher.items(primitive.uv0);
      hasher.items(primitive.uv1);
      hasher.items(primitive.colors);
    }
  for (const Material& m : assets.materials) {
    hasher.bytes_of(m.base_color).bytes_of(m.emissive);
    for (const float number : {m.metallic, m.roughness, m.occlusion_strength, m.alpha_cutoff, m.reflectivity})
      hasher.bytes_of(number);
    hasher.value(m.alpha_mode).value(m.double_sided).value(m.subsurface);
    for (const TextureSlot& slot :
         {m.base_color_texture, m.metallic_roughness_texture, m.occlusion_texture, m.emissive_texture})
      hasher.value(slot.texture).value(slot.uv_set).bytes_of(slot.transform_row0).bytes_of(slot.transform_row1);
  }
  for (const Texture& t : assets.textures)
    hasher.value(t.image).value(t.srgb).value(t.nearest).value(t.wrap_u).value(t.wrap_v);
  for (const Image& image : assets.images) {
    hasher.value(image.width).value(image.height);
    hasher.items(image.rgba);
  }
}

void add_lights(Hasher& hasher, const World& world) {
  struct Found {
    std::uint32_t entity;
    std::uint64_t hash;
  };
  std::vector<Found> found;
  world.view<const Light, const WorldTransform, Maybe<const ShadowCaster>>().each(
      [&](Entity entity, const Light& light, const WorldTransform& transform, const ShadowCaster* caster) {
        Hasher one;
        one.value(light.kind).bytes_of(light.color).bytes_of(transform.matrix);
        for (const float number : {light.intensity, light.range_m, light.inner_angle, light.outer_angle, light.width_m,
                                   light.apparent_angle})
          one.bytes_of(number);
        one.value(caster == nullptr || caster->enabled);
        found.push_back({entity.index, one.digest()});
      });
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.entity < b.entity; });
  for (const Found& one : found) hasher.value(one.hash);
}

void add_settings(Hasher& hasher, const ReflectionTracing& settings) {
  hasher.bytes_of(settings.fog.density).bytes_of(settings.fog.color);
  hasher.bytes_of(settings.fog.sky_distance_m);
  for (const EmissiveQuad& quad : settings.quads) {
    hasher.bytes_of(quad.center).bytes_of(quad.half_u).bytes_of(quad.half_v);
    hasher.value(quad.width)
        .value(quad.height)
        .bytes(std::as_bytes(quad.rgba))
        .bytes_of(quad.radiance)
        .bytes_of(quad.opacity);
  }
}

}  // namespace

std::string radiance_identity(const RadianceInput& input) {
  const GeometryPicture& geometry = input.geometry;
  Hasher hasher;
  hasher.bytes_of(geometry.view.position).bytes_of(geometry.view.clip_from_relative);
  hasher.items(geometry.depth);
  hasher.items(geometry.normals);
  hasher.items(geometry.material);
  add_assets(hasher, input.world.resource<SceneAssets>());
  add_lights(hasher, input.world);
  const auto& sky = input.world.resource<SceneEnvironment>();
  hasher.bytes_of(sky.sky_zenith).bytes_of(sky.sky_horizon).bytes_of(sky.sky_ground);
  add_settings(hasher, input.settings);
  constexpr int kMethod = 2;  // increase when the same input gives other radiances
  return "reflections " + std::to_string(kMethod) + " of triangles " + std::to_string(input.tracer.all_version()) +
         " frame and scene " + std::to_string(hasher.digest()) + " size " + std::to_string(geometry.view.width) + "x" +
         std::to_string(geometry.view.height) + " rays " + std::to_string(input.settings.rays) + " light samples " +
         std::to_string(input.settings.light_samples) + " bounces " + std::to_string(input.settings.bounces);
}

}  // namespace gloam
