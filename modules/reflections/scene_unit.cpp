// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/scene_unit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/transforms.h"
#include "engine/scene/units.h"

namespace gloam {
namespace {

// Sizes in the middle of what is usual in scenes in metres.
constexpr double kLargestMesh = 10.0;
constexpr double kMiddleMesh = 2.0;
constexpr double kNearPlane = 0.1;

glm::dmat3 relative_axes(const World& world, Entity node) {
  if (const auto* matrix = world.try_get<LocalMatrix>(node)) return glm::dmat3(matrix->matrix);
  const auto* local = world.try_get<LocalTransform>(node);
  return local == nullptr ? glm::dmat3(1.0) : glm::dmat3(local_matrix(*local));
}

glm::dmat3 world_axes(const World& world, Entity node) {
  glm::dmat3 axes = relative_axes(world, node);
  while (const auto* parent = world.try_get<Parent>(node)) {
    node = parent->entity;
    axes = relative_axes(world, node) * axes;
  }
  return axes;
}

/// Diagonals of the instances' boxes, finite and above 0. Skinned ones are where their joints are, and left out.
std::vector<double> instance_sizes(const World& world) {
  const auto& assets = world.resource<SceneAssets>();
  std::vector<double> sizes;
  world.view<const MeshInstance>().each([&](Entity entity, const MeshInstance& instance) {
    if (instance.mesh >= assets.meshes.size() || instance.skin != kNone) return;
    const Aabb& box = assets.meshes[instance.mesh].bounds;
    const dvec3 extents(box.max - box.min);
    const glm::dmat3 axes = world_axes(world, entity);
    const double size =
        glm::length(glm::abs(axes[0]) * extents.x + glm::abs(axes[1]) * extents.y + glm::abs(axes[2]) * extents.z);
    if (std::isfinite(size) && size > 0.0) sizes.push_back(size);
  });
  return sizes;
}

/// The nearest near plane of all cameras; 0 without cameras.
double nearest_plane(const World& world) {
  double nearest = std::numeric_limits<double>::infinity();
  world.view<const Camera>().each(
      [&](const Camera& camera) { nearest = std::min(nearest, std::abs(static_cast<double>(camera.near_m))); });
  return std::isfinite(nearest) ? nearest : 0.0;
}

double decades(double ratio) { return std::round(std::log10(ratio)); }

}  // namespace

double estimate_scene_unit(const World& world) {
  std::vector<double> sizes = instance_sizes(world);
  if (sizes.empty()) return 1.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double largest = *std::max_element(middle, sizes.end());
  if (const double small = decades(largest / kLargestMesh); small < 0.0) return std::pow(10.0, small);
  const double near_m = nearest_plane(world);
  if (!(near_m > kNearPlane)) return 1.0;
  return std::pow(10.0, std::max(0.0, std::min(decades(*middle / kMiddleMesh), decades(near_m / kNearPlane))));
}

Status keep_estimated_unit(World& world) {
  world.set_resource(EstimatedUnit{estimate_scene_unit(world)});
  return {};
}

double scene_unit(const World& world) {
  if (world.try_resource<SceneUnits>() != nullptr) return 1.0 / metres_per_unit(world);
  const auto* estimated = world.try_resource<EstimatedUnit>();
  return estimated == nullptr ? 1.0 : estimated->unit;
}

}  // namespace gloam
