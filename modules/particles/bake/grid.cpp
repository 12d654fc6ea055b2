// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/bake/grid.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

constexpr double kLeastSide_m = 1e-3;  // a box must not be empty; metres

}  // namespace

ParticleLightMap empty_light_map(const PlacedEmitter& emitter, const ParticleBakeOptions& options) {
  ParticleLightMap map;
  map.emitter = emitter.entity;
  map.origin = emitter.origin;
  const dvec3 middle = 0.5 * (emitter.bounds.min + emitter.bounds.max);
  const double metre = 1.0 / static_cast<double>(emitter.values.metres_per_unit);
  const dvec3 half = 0.5 * glm::max(emitter.bounds.max - emitter.bounds.min, dvec3(kLeastSide_m * metre));
  map.box = {vec3(middle - half - emitter.origin), vec3(middle + half - emitter.origin)};
  const double most = std::clamp(options.most_side, 2u, kMostMapSide);
  const double texel = std::max(options.texel_m * metre, 2.0 * std::max({half.x, half.y, half.z}) / most);
  for (int i = 0; i < 3; ++i)
    map.size[i] = static_cast<std::uint32_t>(std::clamp(std::ceil(2.0 * half[i] / texel), 2.0, most));
  return map;
}

dvec3 grid_position(const ParticleLightMap& map, const dvec3& at) {
  const dvec3 from(map.box.min), extent = dvec3(map.box.max) - from;
  return map.origin + from + at / dvec3(map.size) * extent;
}

}  // namespace gloam
