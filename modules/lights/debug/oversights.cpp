// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/debug/oversights.h"

#include <cmath>

#include "engine/render/report/placeless.h"
#include "modules/lights/light_set.h"

namespace gloam {
namespace {

bool has_finite_light(const Light& light) {
  return std::isfinite(light.intensity) && std::isfinite(light.color.r) && std::isfinite(light.color.g) &&
         std::isfinite(light.color.b);
}

}  // namespace

std::vector<Oversight> dark_lights(const World& world) {
  std::vector<Oversight> all;
  add_placeless<Light>(world, "has a Light but no WorldTransform: it lights nothing", all);
  const LightSet& set = world.resource<LightSet>();
  for (std::size_t i = 0; i < set.lights.size(); ++i) {
    if (set.table.radius[i] != kGivesNothing || has_finite_light(set.lights[i].light)) continue;
    all.push_back({set.lights[i].entity, "has a Light whose intensity or color is not finite: it lights nothing"});
    break;
  }
  return all;
}

}  // namespace gloam
