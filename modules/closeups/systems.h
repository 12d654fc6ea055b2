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

/// Finds the pairs whose light is in the view, with their umbra ranges. Pairs with an empty range are left out.
void umbra_projection_system(ViewResource<const VisibleLights> visible, ViewResource<const RenderView> view,
                             ViewResource<const CloseupSettings> settings, Resource<const CloseupSubjects> subjects,
                             Resource<const CloseupReceivers> receivers, View<const CloseupPair> pairs,
                             PlacedLights lights, ViewResource<CloseupViews> found, JobExecutor& jobs);

/// Sorts the pairs that umbra_projection found, computes their faces, and keeps the first closeups.max_pairs pairs that
/// have a face.
void closeup_views_system(ViewResource<const CloseupSettings> settings, Resource<const CloseupSubjects> subjects,
                          Resource<const CloseupReceivers> receivers, PlacedLights lights,
                          ViewResource<CloseupViews> found, JobExecutor& jobs);

/// Adds the systems closeup_subjects, closeup_receivers, closeup_pairs, umbra_projection and closeup_views. The systems
/// of the lights module must be added before.
void add_closeup_systems(Schedule& schedule);

/// Adds the world resources that the systems need.
void register_closeup_resources(World& world);

/// Takes away what the systems left in a world: the pairs, and the content of resources.
void leave_closeup_world(World& world);

/// Adds the view resources that the systems need, where they are missing.
void prepare_closeup_view(World& world, ViewId view);

}  // namespace gloam
