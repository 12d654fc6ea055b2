// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/shadow_knobs.h"
#include "modules/shadows/shadow_state.h"
#include "modules/shadows/shadow_views.h"
#include "modules/shadows/traced_visibility.h"

namespace gloam {

/// What rays found, when it is of this view's size; else null.
[[nodiscard]] const TracedVisibility* traced_visibility_of(const World& world, const RenderView& view);

/// Uploads the view's ShadowRows, ShadowBlock, cookies and traced visibilities (pass shadow_rows, where rows or images have to be copied):
/// those members of the outputs, and the samplers.
[[nodiscard]] Status add_shadow_uploads(FrameBuilder& frame, ShadowStates& states, const ShadowViews& views,
                                        const ShadowKnobs& knobs, ShadowsOutputs& outputs);

}  // namespace gloam
