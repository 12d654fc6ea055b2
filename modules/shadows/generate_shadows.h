// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/shadow_knobs.h"

namespace gloam {

/// Whether the view can have final lists: shadows.mode = deferred, visibilities are quantised, and local lights have early lists.
[[nodiscard]] bool can_generate(const FrameBuilder& frame, const ShadowKnobs& knobs);

/// Makes final lists of early ones: passes shadow_list_start, classify_shadows, generate_shadows, finish_lists. Sets shadows.final_lists.
/// planes: of add_shadow_planes_pass; none: no tile is classified.
[[nodiscard]] Status add_generate_passes(FrameBuilder& frame, const ShadowKnobs& knobs, ImageRef planes, ShadowsOutputs& shadows);

}  // namespace gloam
