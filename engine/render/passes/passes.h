// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"

/// The renderer's own passes, in the order they are declared. Each reads and puts outputs of the frame's board.
namespace gloam {

/// Morphs and skins the vertices of deformed primitives that are drawn or cast shadows; puts FrameBuilder::Deformed.
/// Nothing when there are none.
[[nodiscard]] Status add_deform_pass(FrameBuilder& frame);

/// Draws solid surfaces into the geometry buffer; puts GeometryOutputs.
[[nodiscard]] Status add_geometry_pass(FrameBuilder& frame);

/// Farthest and nearest depth of each 8×8 tile; completes GeometryOutputs.
[[nodiscard]] Status add_depth_bounds_pass(FrameBuilder& frame);

/// Shows albedo, normal or depth instead of the lit picture. `code` as in debug_view.frag.
[[nodiscard]] Status add_debug_view_pass(FrameBuilder& frame, std::uint32_t code);

}  // namespace gloam
