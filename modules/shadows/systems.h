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

/// Sets `casters` to the world-space bounds of all meshes and volumes; cascades use them. The bounds of a skinned mesh
/// enclose its rest box as moved by each of its joints. Does nothing if the view has no directional light. Morph
/// targets are ignored: geometry that they move out of the bounds toward a light is drawn onto the near side of the
/// light's box.
void shadow_bounds_system(ViewResource<const VisibleLights> visible,
                          View<const MeshInstance, const WorldTransform> meshes, View<const CasterVolume> volumes,
                          Resource<const SceneAssets> assets, Resource<const JointMatrices> joints,
                          Resource<const ShadowTexelGrid> grid, ViewResource<CasterBounds> casters, JobExecutor& jobs);

/// Finds the faces of the view's lights and their places in the atlas.
void shadow_views_system(ViewResource<const VisibleLights> visible, ViewResource<const RenderView> view,
                         ViewResource<const ShadowSettings> settings, ViewResource<const OverlayRoom> overlays,
                         ViewResource<const CasterBounds> casters, ShadowLights lights, ViewResource<ViewFaces> shadows,
                         JobExecutor& jobs);

/// Adds the systems shadow_bounds and shadow_views. They run after light_sort, so the lights module's systems must be
/// added first.
void add_shadow_systems(Schedule& schedule);

/// Creates the view resources that the systems need (CasterBounds, OverlayRoom, ShadowSettings, ViewFaces), unless
/// they exist.
void prepare_shadow_view(World& world, ViewId view, const ShadowKnobs& knobs);

}  // namespace gloam
