// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/filter/traced_visibility.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/state.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// The world's traced visibility if it has this view's size, else null.
[[nodiscard]] const TracedVisibility* traced_visibility_of(const World& world, const RenderView& view);

/// Members of ShadowsOutputs with the same names.
struct ShadowUploads {
  gpu::Binding::BufferRange block;
  shaders::ShadowBlock block_values{};
  ImageRef rows;
  std::shared_ptr<const std::vector<shaders::ShadowRow>> row_values;
  ImageRef cookies;
  ImageRef traced;
};

/// Uploads the view's light rows, ShadowBlock, cookies and traced visibility: pass shadow_rows. On an error the frame
/// is given up.
[[nodiscard]] ShadowUploads add_shadow_uploads(FrameBuilder& frame, ShadowStates& states, const ViewFaces& view_faces,
                                               const ShadowKnobs& knobs);

/// Uploads `rows` into another image, which may replace ShadowsOutputs::rows: pass `pass_name`. Returns that image. On
/// an error the frame is given up.
[[nodiscard]] ImageRef upload_shadow_rows(FrameBuilder& frame, ShadowStates& states, std::string_view pass_name,
                                          std::span<const shaders::ShadowRow> rows);

}  // namespace gloam
