// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/schedule/schedule.h"
#include "modules/lights/selection/light_list.h"

namespace gloam {

using KeptLights = View<const Light, const WorldTransform, LightBounds>;
using FreshLights = View<const Light, const WorldTransform, Without<LightBounds>>;

/// Finds the world's lights in all archetypes, sees by comparison which have changed, and brings LightBounds and
/// LightSet up to date.
void light_bounds_system(KeptLights kept, FreshLights fresh, Resource<LightSet> set, JobExecutor& jobs,
                         Commands& commands);

/// Chooses and orders the view's lights; does nothing when neither they nor the camera have changed.
void light_sort_system(Resource<const LightSet> set, ViewResource<const RenderView> view,
                       ViewResource<VisibleLights> visible, JobExecutor& jobs);

/// zBins from the near plane to the last light, or to last frame's farthest opaque surface if that is nearer. Does
/// nothing when neither lists nor parameters have changed.
void zbin_build_system(ViewResource<const VisibleLights> visible, ViewResource<const ZBinSettings> settings,
                       ViewResource<ZBins> bins);

/// Does nothing when neither lists nor the kind of bound have changed.
void tile_light_masks_system(ViewResource<const VisibleLights> visible, ViewResource<const TileBound> bound,
                             ViewResource<TileLightMasks> masks, JobExecutor& jobs);

/// The four systems under these names.
void add_light_systems(Schedule& schedule);

/// Puts what they need of a view in place where it is missing.
void prepare_light_view(World& world, ViewId view);

}  // namespace gloam
