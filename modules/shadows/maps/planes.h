// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/maps/draw_passes.h"
#include "modules/shadows/maps/state.h"

namespace gloam {

void list_shadow_plane_pipelines(PipelineList& list);

/// Brings the planes above what the view's maps hold (shaders/shadows/maps/planes_shared.h) up to date with parts of
/// faces that this frame draws: pass shadow_planes. All of the view's faces when planes were not kept up to date
/// before.
[[nodiscard]] Result<ImageRef> add_shadow_planes_pass(FrameBuilder& frame, ShadowStates& states, ViewShadows& kept,
                                                      const ShadowMaps& maps, const ShadowViews& views);

}  // namespace gloam
