// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// Whether the view can have final lists: shadows.mode = deferred, visibilities are quantised, and local lights have
/// early lists.
[[nodiscard]] bool can_generate(const FrameBuilder& frame, const ShadowKnobs& knobs);

/// Whether the pipelines of the passes below are there; else they are made in the background, and the frame does
/// without final lists.
[[nodiscard]] bool generate_pipelines_ready(const FrameBuilder& frame, const ShadowKnobs& knobs,
                                            const ShadowsOutputs& shadows);

/// Makes final lists of early ones: passes shadow_list_start, classify_shadows, generate_shadows, finish_lists. Sets
/// shadows.final_lists. planes: of add_shadow_planes_pass; none: no tile is classified.
[[nodiscard]] Status add_generate_passes(FrameBuilder& frame, const ShadowKnobs& knobs, ImageRef planes,
                                         ShadowsOutputs& shadows);

}  // namespace gloam
