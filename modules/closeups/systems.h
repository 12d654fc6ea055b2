// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/view.h"
#include "engine/render/view.h"
#include "engine/scene/components.h"
#include "engine/schedule/schedule.h"
#include "modules/closeups/components.h"
#include "modules/closeups/pairs/subjects.h"
#include "modules/closeups/pairs/views.h"
#include "modules/lights/components.h"
#include "modules/lights/outputs.h"

namespace gloam {

using PlacedLights = View<const Light, const WorldTransform>;

/// Pairs whose lights are the view's, with the tiles that their shadows may touch; those that touch none are left out.
void umbra_projection_system(ViewResource<const VisibleLights> visible, ViewResource<const RenderView> view,
                             ViewResource<const CloseupSettings> settings, Resource<const CloseupSubjects> subjects,
                             Resource<const CloseupReceivers> receivers, View<const CloseupPair> pairs,
                             PlacedLights lights, ViewResource<CloseupViews> found, JobExecutor& jobs);

/// Gives those pairs their maps, ranks them, and keeps those that are drawn.
void closeup_views_system(ViewResource<const CloseupSettings> settings, Resource<const CloseupSubjects> subjects,
                          Resource<const CloseupReceivers> receivers, PlacedLights lights,
                          ViewResource<CloseupViews> found, JobExecutor& jobs);

/// The systems closeup_subjects, closeup_receivers, closeup_pairs, umbra_projection and closeup_views. The systems of
/// lights must be added before.
void add_closeup_systems(Schedule& schedule);

/// Resources of the world that they need.
void register_closeup_resources(World& world);

/// Puts what they need of a view in place where it is missing.
void prepare_closeup_view(World& world, ViewId view);

}  // namespace gloam
