// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/schedule/schedule.h"
#include "modules/grass/components.h"
#include "modules/grass/field/grow.h"
#include "modules/grass/simulation/steps.h"
#include "shaders/grass/grass_shared.h"

namespace gloam {

/// A collider in the world, in metres. A sphere is a capsule whose ends coincide.
struct PlacedCollider {
  Entity entity = kNoEntity;
  bool box = false;
  dvec3 from = dvec3(0.0);  ///< capsule: one end of its axis; box: its centre
  dvec3 to = dvec3(0.0);    ///< capsule: the other end; box: its centre
  dvec3 from_previous = dvec3(0.0);
  dvec3 to_previous = dvec3(0.0);
  double radius_m = 0.0;
  dvec3 axes[3] = {dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), dvec3(0.0, 0.0, 1.0)};  ///< of the box; orthonormal
  dvec3 half_size = dvec3(0.0);                                                        ///< of the box
  dvec3 low = dvec3(0.0);  ///< bounds of the whole way from the previous place
  dvec3 high = dvec3(0.0);
};

/// All colliders of the world, by index of their entities; a world resource.
struct GrassColliders {
  std::vector<PlacedCollider> colliders;
  std::uint64_t frame = ~std::uint64_t{0};  ///< of the world (RenderView::frame)
  std::uint32_t first_step = 0;             ///< StepClock::first_step of the frame
  std::uint32_t restarts = 0;               ///< StepClock::restarts of the frame
};

/// The collider at rest at this pose (the world in metres); none for ColliderShape::none and for values that are not
/// finite. A scaled sphere or capsule takes the largest scale across its axis. The axes of a sheared box are made
/// orthogonal.
[[nodiscard]] std::optional<PlacedCollider> place_collider(Entity entity, const Collider& collider,
                                                           const dmat4& world_from_node);

/// Gives `now` the previous place of the same collider (null: it has been where it is), and the bounds of its way.
void sweep_collider(const PlacedCollider* previous, PlacedCollider& now);

/// Gathers the colliders, in metres (metric_matrix). The previous place is that of the frame that has reached the
/// clock's first step. After the clock was started again, all colliders have been where they are.
void grass_colliders_system(View<const Collider, const WorldTransform> colliders, ViewResource<const RenderView> view,
                            Resource<const StepClock> steps, Resource<const GrassGrowthSettings> settings,
                            Resource<GrassColliders> found);

/// Adds the rows of the colliders whose way comes nearer to the patch's roots than its reach. Returns their number.
std::uint32_t colliders_near(const GrassPatch& patch, std::span<const PlacedCollider> colliders,
                             std::vector<shaders::GrassCollider>& rows);

/// Adds the systems grass_steps and grass_colliders, and the world resources that they need.
void add_grass_world_systems(Schedule& schedule);
void register_grass_world_resources(World& world);

}  // namespace gloam
