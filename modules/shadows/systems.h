// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "engine/schedule/schedule.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/components.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/views/cascades.h"

namespace gloam {

using ShadowLights = View<const Light, const WorldTransform, Maybe<const LightBounds>, Maybe<const ShadowCaster>>;

/// Bounds of all meshes, skinned ones by their joints; for directional lights, and left alone without any. Morph
/// targets are not looked into: what they push out of the bounds towards a light is drawn at the near side of its box.
void shadow_bounds_system(ViewResource<const VisibleLights> visible,
                          View<const MeshInstance, const WorldTransform> meshes, Resource<const SceneAssets> assets,
                          Resource<const JointMatrices> joints, ViewResource<CasterBounds> casters, JobExecutor& jobs);

/// Faces of the view's lights, with their places in the atlas.
void shadow_views_system(ViewResource<const VisibleLights> visible, ViewResource<const RenderView> view,
                         ViewResource<const ShadowSettings> settings, ViewResource<const CasterBounds> casters,
                         ShadowLights lights, ViewResource<ShadowViews> shadows, JobExecutor& jobs);

/// The systems shadow_bounds and shadow_views. They run after light_sort: the systems of lights must be added before.
void add_shadow_systems(Schedule& schedule);

/// Puts what they need of a view in place where it is missing.
void prepare_shadow_view(World& world, ViewId view);

}  // namespace gloam
