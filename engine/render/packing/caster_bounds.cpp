// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/caster_bounds.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/math/finite.h"

namespace gloam {
namespace {

/// Minkowski sum of two boxes; an empty `reach` adds nothing.
Aabb sum_of(const Aabb& box, const Aabb& reach) {
  if (reach.empty()) return box;
  return {box.min + reach.min, box.max + reach.max};
}

}  // namespace

std::vector<std::pair<std::uint32_t, Aabb>> joint_bounds(const Primitive& primitive,
                                                         std::span<const PackedInfluence> influences) {
  std::map<std::uint32_t, Aabb> bounds;
  for (std::size_t v = 0; v < influences.size(); ++v) {
    const PackedInfluence& packed = influences[v];
    const std::uint32_t joints[] = {packed.joints01 & 0xFFFFu, packed.joints01 >> 16, packed.joints23 & 0xFFFFu,
                                    packed.joints23 >> 16};
    const std::uint32_t weights[] = {packed.weights01 & 0xFFFFu, packed.weights01 >> 16, packed.weights23 & 0xFFFFu,
                                     packed.weights23 >> 16};
    for (std::size_t k = 0; k < 4; ++k)
      if (weights[k] > 0) bounds[joints[k]].grow(primitive.positions[v]);
  }
  return {bounds.begin(), bounds.end()};
}

std::vector<Aabb> morph_bounds(const Primitive& primitive) {
  std::vector<Aabb> bounds;
  for (const Primitive::MorphTarget& target : primitive.morph_targets) {
    Aabb& box = bounds.emplace_back();
    for (std::size_t v = 0; v < primitive.positions.size(); ++v)
      box.grow(v < target.positions.size() ? target.positions[v] : vec3(0.0f));
  }
  return bounds;
}

Aabb morph_reach(const GpuPrimitive& primitive, std::span<const float> weights) {
  Aabb reach{vec3(0.0f), vec3(0.0f)};
  for (std::size_t t = 0; t < std::min(weights.size(), primitive.morph_bounds.size()); ++t) {
    const Aabb& offsets = primitive.morph_bounds[t];
    const vec3 low = offsets.min * weights[t], high = offsets.max * weights[t];
    reach.min += weights[t] < 0.0f ? high : low;
    reach.max += weights[t] < 0.0f ? low : high;
  }
  return reach;
}

WorldBox posed_box(const GpuPrimitive& primitive, const JointMatrices& joints, const JointMatrices::Range& range,
                   const Aabb& reach) {
  WorldBox all;
  for (const auto& [joint, box] : primitive.joint_bounds) {
    if (joint >= range.count) return {};
    const WorldBox part = world_box(sum_of(box, reach), dmat4(joints.matrices[range.first + joint]));
    if (!part.known()) return {};
    all.min = glm::min(all.min, part.min);
    all.max = glm::max(all.max, part.max);
  }
  return {all.min + range.origin, all.max + range.origin};
}

}  // namespace gloam
