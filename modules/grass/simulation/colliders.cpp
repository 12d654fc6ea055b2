// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/simulation/colliders.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/quaternion_common.hpp>

#include "engine/math/finite.h"
#include "modules/grass/field/metres.h"
#include "modules/grass/lod/visible_patches.h"

namespace gloam {
namespace {

/// A vector perpendicular to a unit vector.
dvec3 any_perpendicular(dvec3 unit) {
  const dvec3 other = std::abs(unit.x) < 0.7 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
  return glm::normalize(glm::cross(unit, other));
}

/// Orthonormal axes near the columns of the matrix (Gram and Schmidt); a column without a direction of its own gets
/// any.
void orthonormal_axes(const dmat4& m, dvec3 (&axes)[3]) {
  const dvec3 x(m[0]);
  const dvec3 y(m[1]);
  const double x_length = glm::length(x);
  axes[0] = x_length > 0.0 ? x / x_length : dvec3(1.0, 0.0, 0.0);
  const dvec3 y_rest = y - axes[0] * glm::dot(axes[0], y);
  const double y_length = glm::length(y_rest);
  axes[1] = y_length > 1e-9 * glm::length(y) ? y_rest / y_length : any_perpendicular(axes[0]);
  axes[2] = glm::cross(axes[0], axes[1]);
}

bool finite(const PlacedCollider& c) {
  return is_finite(c.from) && is_finite(c.to) && is_finite(c.half_size) && std::isfinite(c.radius_m) &&
         is_finite(c.axes[0]) && is_finite(c.axes[1]) && is_finite(c.axes[2]);
}

/// Half the size of the box around the collider at one place of `from` and `to`.
dvec3 half_bounds(const PlacedCollider& c) {
  if (!c.box) return dvec3(c.radius_m);
  dvec3 half(0.0);
  for (int i = 0; i < 3; ++i) half += glm::abs(c.axes[i]) * c.half_size[i];
  return half;
}

shaders::GrassCollider row_of(const PlacedCollider& c, const GrassPatch& patch) {
  const dquat turn = glm::conjugate(patch.turn);
  shaders::GrassCollider row{};
  row.from = vec3(turn * (c.from - patch.origin));
  row.from_previous = vec3(turn * (c.from_previous - patch.origin));
  row.to = vec3(turn * (c.to - patch.origin));
  row.to_previous = vec3(turn * (c.to_previous - patch.origin));
  row.axis_x = vec3(turn * c.axes[0]);
  row.axis_y = vec3(turn * c.axes[1]);
  row.axis_z = vec3(turn * c.axes[2]);
  row.half_size = vec3(c.half_size);
  row.radius_m = static_cast<float>(c.radius_m);
  row.box = c.box ? 1 : 0;
  return row;
}

}  // namespace

std::optional<PlacedCollider> place_collider(Entity entity, const Collider& collider, const dmat4& world_from_node) {
  if (collider.shape == ColliderShape::none) return std::nullopt;
  PlacedCollider placed;
  placed.entity = entity;
  const dvec3 scale(glm::length(dvec3(world_from_node[0])), glm::length(dvec3(world_from_node[1])),
                    glm::length(dvec3(world_from_node[2])));
  const auto point = [&](double y) { return dvec3(world_from_node * dvec4(0.0, y, 0.0, 1.0)); };
  const auto radius = static_cast<double>(collider.radius_m);
  placed.from = placed.to = point(0.0);
  if (collider.shape == ColliderShape::sphere) {
    placed.radius_m = radius * std::max({scale.x, scale.y, scale.z});
  } else if (collider.shape == ColliderShape::capsule) {
    const auto height = static_cast<double>(collider.height_m);
    placed.radius_m = radius * std::max(scale.x, scale.z);
    // The caps keep their radius, so their centres lie a scaled radius inside the scaled height.
    const double inset = scale.y > 0.0 ? std::min(placed.radius_m / scale.y, 0.5 * height) : 0.5 * height;
    placed.from = point(inset);
    placed.to = point(height - inset);
  } else {
    placed.box = true;
    placed.half_size = dvec3(collider.size_m) * scale * 0.5;
    orthonormal_axes(world_from_node, placed.axes);
  }
  if (!finite(placed) || placed.radius_m < 0.0) return std::nullopt;
  sweep_collider(nullptr, placed);
  return placed;
}

void sweep_collider(const PlacedCollider* previous, PlacedCollider& now) {
  now.from_previous = previous != nullptr ? previous->from : now.from;
  now.to_previous = previous != nullptr ? previous->to : now.to;
  const dvec3 half = half_bounds(now);
  now.low = glm::min(glm::min(now.from, now.to), glm::min(now.from_previous, now.to_previous)) - half;
  now.high = glm::max(glm::max(now.from, now.to), glm::max(now.from_previous, now.to_previous)) + half;
}

void grass_colliders_system(View<const Collider, const WorldTransform> colliders, ViewResource<const RenderView> view,
                            Resource<const StepClock> steps, Resource<const GrassGrowthSettings> settings,
                            Resource<GrassColliders> found) {
  if (found->frame == view->frame) return;
  found->frame = view->frame;
  std::vector<PlacedCollider> placed;
  colliders.each([&](Entity entity, const Collider& collider, const WorldTransform& transform) {
    const dmat4 metric = metric_matrix(transform.matrix, settings->metres_per_unit);
    if (const auto one = place_collider(entity, collider, metric)) placed.push_back(*one);
  });
  const auto index_of = [](const PlacedCollider& c) { return c.entity.index; };
  std::ranges::sort(placed, {}, index_of);
  if (found->restarts != steps->restarts()) found->colliders.clear();
  // False if the last frame begins at the same step: it made no step, or its time is that of this frame.
  const bool follows = steps->first_step() != found->first_step;
  for (PlacedCollider& now : placed) {
    const auto before = std::ranges::lower_bound(found->colliders, now.entity.index, {}, index_of);
    if (before == found->colliders.end() || before->entity != now.entity || before->box != now.box) continue;
    PlacedCollider start = *before;
    if (!follows) {
      start.from = before->from_previous;
      start.to = before->to_previous;
    }
    sweep_collider(&start, now);
  }
  found->colliders = std::move(placed);
  found->first_step = steps->first_step();
  found->restarts = steps->restarts();
}

std::uint32_t colliders_near(const GrassPatch& patch, std::span<const PlacedCollider> colliders,
                             std::vector<shaders::GrassCollider>& rows) {
  if (patch.roots.empty()) return 0;
  const Aabb box = reach_box(patch);
  const dvec3 low = patch.origin + dvec3(box.min);
  const dvec3 high = patch.origin + dvec3(box.max);
  std::uint32_t count = 0;
  for (const PlacedCollider& c : colliders) {
    if (!glm::all(glm::lessThanEqual(c.low, high)) || !glm::all(glm::lessThanEqual(low, c.high))) continue;
    rows.push_back(row_of(c, patch));
    ++count;
  }
  return count;
}

void add_grass_world_systems(Schedule& schedule) {
  schedule.add_system("grass_steps", "grass", Stage::view, &grass_steps_system);
  schedule.add_system("grass_colliders", "grass", Stage::view, &grass_colliders_system);
}

void register_grass_world_resources(World& world) {
  world.ensure_resource<StepClock>();
  world.ensure_resource<GrassColliders>();
}

}  // namespace gloam
