// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/enclosed_lights.h"

#include <algorithm>
#include <cmath>

#include "engine/ecs/view.h"
#include "engine/render/packing/caster_bounds.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"
#include "modules/shadows/views/bulbs.h"

namespace gloam {
namespace {

struct Lamp {
  Entity entity;
  dvec3 position = dvec3(0.0);
  double bulb_radius_m = 0.0;
};

std::vector<Lamp> casting_lamps(const World& world) {
  std::vector<Lamp> lamps;
  world.view<const Light, const WorldTransform, Maybe<const ShadowCaster>>().each(
      [&](Entity entity, const Light& light, const WorldTransform& transform, const ShadowCaster* caster) {
        if (light.kind == LightKind::directional || (caster != nullptr && !caster->enabled)) return;
        lamps.push_back({entity, dvec3(transform.matrix[3]), bulb_radius(light)});
      });
  std::sort(lamps.begin(), lamps.end(), [](const Lamp& a, const Lamp& b) { return a.entity.index < b.entity.index; });
  return lamps;
}

/// Signed solid angle of a triangle seen from the origin, in steradians.
double solid_angle(const dvec3& a, const dvec3& b, const dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double numerator = glm::dot(a, glm::cross(b, c));
  const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2.0 * std::atan2(numerator, denominator);
}

/// Share of all directions around `from` that the triangles fill: 1 inside a closed surface, 0 outside of it.
double filled_share(const Primitive& primitive, const dmat4& world_from_mesh, const dvec3& from) {
  dmat4 relative = world_from_mesh;
  relative[3] -= dvec4(from, 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    dvec3 corners[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t index = primitive.indices[i + k];
      if (index >= primitive.positions.size()) return 0.0;
      corners[k] = dvec3(relative * dvec4(dvec3(primitive.positions[index]), 1.0));
    }
    sum += solid_angle(corners[0], corners[1], corners[2]);
  }
  return std::abs(sum) / (4.0 * 3.14159265358979323846);
}

bool encloses(const Primitive& primitive, const Material* material, const dmat4& world_from_mesh, const Lamp& lamp) {
  constexpr double kAlmostAll = 0.95;
  if (material != nullptr && material->alpha_mode == AlphaMode::blend) return false;
  const WorldBox box = world_box(primitive.bounds, world_from_mesh);
  if (!box.known() || glm::clamp(lamp.position, box.min, box.max) != lamp.position) return false;
  const bool emissive = material != nullptr && is_emissive(*material);
  const double reach = emissive ? half_diagonal(primitive.bounds, world_from_mesh) : 0.0;
  if (is_bulb(lamp.position, lamp.bulb_radius_m, box.min, box.max, reach)) return false;
  return filled_share(primitive, world_from_mesh, lamp.position) > kAlmostAll;
}

std::string name_of(const World& world, Entity entity) {
  const std::string_view name = world.resource<SceneNames>().name_of(entity);
  return name.empty() ? "without a name" : "\"" + std::string(name) + "\"";
}

}  // namespace

std::vector<std::string> enclosed_lights(const World& world) {
  const auto& assets = world.resource<SceneAssets>();
  std::vector<std::string> sentences;
  for (const Lamp& lamp : casting_lamps(world)) {
    world.view<const MeshInstance, const WorldTransform>().each(
        [&](Entity entity, const MeshInstance& instance, const WorldTransform& transform) {
          if (!instance.casts_shadows || instance.mesh >= assets.meshes.size()) return;
          for (const Primitive& primitive : assets.meshes[instance.mesh].primitives) {
            const Material* material =
                primitive.material < assets.materials.size() ? &assets.materials[primitive.material] : nullptr;
            if (!encloses(primitive, material, transform.matrix, lamp)) continue;
            sentences.push_back("light " + name_of(world, lamp.entity) + " lies inside mesh " + name_of(world, entity) +
                                ", which casts");
            return;
          }
        });
  }
  return sentences;
}

}  // namespace gloam
