// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/pairs/pairs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/math/bounds.h"
#include "modules/closeups/umbra/light.h"
#include "modules/lights/light_names.h"

namespace gloam {
namespace {

/// A shadow-casting light and, if local, the sphere it can light.
struct CastingLight {
  Entity entity;
  bool directional = false;
  dvec3 center = dvec3(0.0);
  double radius_m = 0.0;
};

struct KeptPair {
  CloseupPair pair;
  Entity entity;
};

struct PairOrder {
  static auto key(const CloseupPair& p) {
    return std::array<std::uint32_t, 4>{p.subject.index, p.subject.generation, p.light.index, p.light.generation};
  }
  bool operator()(const CloseupPair& a, const CloseupPair& b) const { return key(a) < key(b); }
};

/// Bounds of a light in its first frame, before it gets LightBounds.
LightBounds first_bounds(const Light& light, const dmat4& world_from_node, float range_m) {
  LightBounds bounds{dvec3(world_from_node[3]), range_m};
  if (light.kind != LightKind::spot) return bounds;
  const auto placed = closeup_light(light, world_from_node);
  if (!placed) return {};
  const Sphere sphere =
      bounding_sphere(Cone{vec3(0.0f), vec3(placed->forward), static_cast<float>(placed->half_angle), range_m});
  return {placed->position + dvec3(sphere.center), sphere.radius};
}

std::vector<CastingLight> casting_lights(const PairLights& lights) {
  std::vector<CastingLight> found;
  lights.each([&](Entity entity, const Light& light, const WorldTransform& transform, const LightBounds* bounds,
                  const ShadowCaster* caster) {
    if (caster != nullptr && !caster->enabled) return;
    if (!(light.intensity > 0.0f) || !std::isfinite(light.intensity)) return;
    CastingLight to{entity, light.kind == LightKind::directional};
    if (!to.directional) {
      const float range = effective_range(light);
      const LightBounds reach = bounds != nullptr ? *bounds : first_bounds(light, transform.matrix, range);
      to.center = reach.center;
      to.radius_m = static_cast<double>(reach.radius_m);
    }
    found.push_back(to);
  });
  std::ranges::sort(found, {}, [](const CastingLight& l) { return l.entity.index; });
  return found;
}

/// Whether the light may reach the subject's box. False for a local light with an empty sphere.
bool reaches(const CastingLight& light, const CloseupSubjects::Subject& subject) {
  if (light.directional) return true;
  const dvec3 away = light.center - glm::clamp(light.center, subject.low, subject.high);
  return light.radius_m > 0.0 && glm::dot(away, away) <= light.radius_m * light.radius_m;
}

/// The lights that the text names, ascending by index; empty if a name is unknown or ambiguous. Null: every light.
const std::vector<Entity>* named_lights(std::uint32_t text, const SceneNames& names, const SceneStrings& strings,
                                        CloseupLightNames& resolved) {
  if (strings.text(text).empty()) return nullptr;
  const auto known = resolved.lights.find(text);
  if (known != resolved.lights.end()) return &known->second;
  static const std::vector<Entity> none;
  auto lights = resolve_light_names(names, strings.text(text), "gloam.closeup.lights");
  if (!lights.ok()) return &none;
  std::ranges::sort(*lights, {}, &Entity::index);
  return &(resolved.lights[text] = std::move(*lights));
}

bool is_named(const std::vector<Entity>& lights, Entity light) {
  const auto at = std::ranges::lower_bound(lights, light.index, {}, &Entity::index);
  return at != lights.end() && *at == light;
}

}  // namespace

void closeup_pairs_system(PairLights lights, View<const CloseupPair> pairs, Resource<const CloseupSubjects> subjects,
                          Resource<const SceneNames> names, Resource<const SceneStrings> strings,
                          Resource<CloseupLightNames> resolved, Commands& commands) {
  std::vector<KeptPair> had;
  pairs.each([&](Entity entity, const CloseupPair& pair) { had.push_back({pair, entity}); });
  if (had.empty() && subjects->subjects.empty()) return;
  // If several entities hold the same pair, the one with the lowest index stays.
  std::ranges::sort(had, {}, [](const KeptPair& p) { return p.entity.index; });
  std::ranges::stable_sort(had, PairOrder{}, &KeptPair::pair);

  std::vector<CloseupPair> wanted;
  const std::vector<CastingLight> casting =
      subjects->subjects.empty() ? std::vector<CastingLight>() : casting_lights(lights);
  for (const CloseupSubjects::Subject& subject : subjects->subjects) {
    if (!subject.known()) continue;
    const std::vector<Entity>* named = named_lights(subject.lights, *names, *strings, *resolved);
    for (const CastingLight& light : casting)
      if (reaches(light, subject) && (named == nullptr || is_named(*named, light.entity)))
        wanted.push_back({subject.entity, light.entity});
  }
  // Both lists are sorted by entity index, which is the same order: live entities never share an index.
  std::size_t next = 0;
  for (const CloseupPair& pair : wanted) {
    for (; next < had.size() && PairOrder{}(had[next].pair, pair); ++next) commands.destroy(had[next].entity);
    const bool kept = next < had.size() && !PairOrder{}(pair, had[next].pair);
    if (kept)
      ++next;
    else
      commands.create(pair);
  }
  for (; next < had.size(); ++next) commands.destroy(had[next].entity);
}

}  // namespace gloam
