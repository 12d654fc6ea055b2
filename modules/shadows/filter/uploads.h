// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/filter/traced_visibility.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/state.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// What rays found, when it is of this view's size; else null.
[[nodiscard]] const TracedVisibility* traced_visibility_of(const World& world, const RenderView& view);

/// Uploads the view's ShadowRows, ShadowBlock, cookies and traced visibilities (pass shadow_rows, where rows or images
/// have to be copied): those members of the outputs, and the samplers.
[[nodiscard]] Status add_shadow_uploads(FrameBuilder& frame, ShadowStates& states, const ShadowViews& views,
                                        const ShadowKnobs& knobs, ShadowsOutputs& outputs);

/// Another version of ShadowsOutputs::rows with these values (pass `pass_name`).
[[nodiscard]] Result<ImageRef> upload_shadow_rows(FrameBuilder& frame, ShadowStates& states, std::string_view pass_name,
                                                  std::span<const shaders::ShadowRow> rows);

}  // namespace gloam
