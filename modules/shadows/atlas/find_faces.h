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

/// A light of the view with its components.
struct ShadowLight {
  Entity entity;
  Light light;
  dmat4 world_from_node = dmat4(1.0);
  LightBounds bounds;   ///< radius 0: unknown
  ShadowCaster caster;  ///< enabled = false: casts no shadow
};

/// Finds the faces of a view's lights and places them in the atlas. local, directional: the lights in the view's order.
/// shadows: holds the places and sizes of the last frame, which are reused, and receives the result.
void find_shadows(std::span<const ShadowLight> local, std::span<const ShadowLight> directional, const RenderView& view,
                  const ShadowSettings& settings, const CasterBounds& casters, JobExecutor& jobs, ViewFaces& shadows);

}  // namespace gloam
