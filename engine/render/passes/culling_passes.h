// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "engine/render/frame_builder.h"

namespace gloam {

/// Name of the engine's result that holds shaders::CullingCounters.
inline constexpr std::string_view kCullingResult = "culling";

/// A view whose hidden clusters are not drawn.
struct CulledView {
  ImageRef depth;      ///< has the size of the view, and holds the occluders' depth
  BufferRef commands;  ///< shaders::ClusterCommand, one for each item of ViewDraws::clusters
};

/// Whether hidden clusters of the view are searched for (kCulling). Not in clipped views: what a plane cuts off hides
/// nothing.
[[nodiscard]] bool culls_hidden(const FrameBuilder& frame);

/// Draws the depth of some surfaces that are near and large, and writes the draw commands of all clusters of the view:
/// without an instance if the cluster has no visible pixel.
[[nodiscard]] CulledView add_culling_passes(FrameBuilder& frame);

}  // namespace gloam
