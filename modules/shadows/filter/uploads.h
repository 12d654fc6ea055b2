// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/filter/traced_visibility.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/state.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// The world's traced visibility if it has this view's size, else null.
[[nodiscard]] const TracedVisibility* traced_visibility_of(const World& world, const RenderView& view);

/// Uploads the view's light rows, ShadowBlock, cookies and traced visibility: pass shadow_rows. Sets block,
/// block_values, rows, row_values, cookies and traced of the outputs. On an error the frame is given up.
void add_shadow_uploads(FrameBuilder& frame, ShadowStates& states, const ViewFaces& view_faces,
                        const ShadowKnobs& knobs, ShadowsOutputs& outputs);

/// Uploads `rows` into another image, which may replace ShadowsOutputs::rows: pass `pass_name`. Returns that image. On
/// an error the frame is given up.
[[nodiscard]] ImageRef upload_shadow_rows(FrameBuilder& frame, ShadowStates& states, std::string_view pass_name,
                                          std::span<const shaders::ShadowRow> rows);

}  // namespace gloam
