// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/view.h"
#include "engine/render/view.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "engine/schedule/schedule.h"
#include "modules/lights/light_set.h"
#include "modules/lights/selection/light_list.h"

namespace gloam {

using KeptLights = View<const Light, const WorldTransform, LightBounds>;
using FreshLights = View<const Light, const WorldTransform, Without<LightBounds>>;

/// Illuminance on a white surface that a picture with the environment's exposure does not show.
[[nodiscard]] float unseen_lux(const SceneEnvironment& environment);

/// Sets Light::unseen_lux of lights without a range.
void light_reach_system(View<Light> lights, Resource<const SceneEnvironment> environment,
                        OptionalResource<const MeteredInEveryFrame> metered);

/// Finds the world's lights in all archetypes, detects changes by comparison, and updates LightBounds and LightSet.
void light_bounds_system(KeptLights kept, FreshLights fresh, Resource<LightSet> set, JobExecutor& jobs,
                         Commands& commands);

/// Selects and sorts the view's lights. Does nothing when neither the lights nor the camera changed.
void light_sort_system(Resource<const LightSet> set, ViewResource<const RenderView> view,
                       ViewResource<VisibleLights> visible, JobExecutor& jobs);

/// Builds zBins from the near plane to the farthest light, or to the last frame's farthest opaque surface if that is
/// nearer. Does nothing when neither the lists nor the parameters changed.
void zbin_build_system(ViewResource<const VisibleLights> visible, ViewResource<const ZBinSettings> settings,
                       ViewResource<ZBins> bins);

/// Builds the tile light masks. Does nothing when neither the lists nor the kind of bound changed.
void tile_light_masks_system(ViewResource<const VisibleLights> visible, ViewResource<const TileBound> bound,
                             ViewResource<TileLightMasks> masks, JobExecutor& jobs);

/// Adds the five systems above: light_reach, light_bounds, light_sort, tile_light_masks, zbin_build.
void add_light_systems(Schedule& schedule);

/// Adds the view resources that the systems need, where they are missing.
void prepare_light_view(World& world, ViewId view);

}  // namespace gloam
