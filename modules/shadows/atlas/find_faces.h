// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/jobs/executor.h"
#include "engine/render/view.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/components.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/views/cascades.h"

namespace gloam {

/// A light of the view as its components are.
struct ShadowLight {
  Entity entity;
  Light light;
  dmat4 world_from_node = dmat4(1.0);
  LightBounds bounds;   ///< radius 0: not known
  ShadowCaster caster;  ///< not enabled: casts no shadow
};

/// Sets up the faces of a view's lights and gives them places: local lights and directional ones in the view's order.
/// Of `shadows` it reads what the last frame left: places and sizes.
void find_shadows(std::span<const ShadowLight> local, std::span<const ShadowLight> directional, const RenderView& view,
                  const ShadowSettings& settings, const CasterBounds& casters, JobExecutor& jobs, ShadowViews& shadows);

}  // namespace gloam
