// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/core/once_log.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

/// Greatest number of pairs that a visualizer shows; further pairs are left out.
inline constexpr std::size_t kMostShownCloseups = 64;

/// The pairs that the frame draws: without skipped pairs, and empty in a frame without final lists.
[[nodiscard]] std::span<const CloseupView> drawn_closeups(const FrameBuilder& frame);

/// Linear colour of a pair. It depends on the entity only, so it is stable while the pair exists.
[[nodiscard]] vec3 closeup_color(Entity pair);

/// Names and legends of this module's visualizers.
[[nodiscard]] std::vector<VisualizerInfo> closeup_visualizers();

/// Draws the close-up visualizers over the picture. Each is also drawn into an image of the same name: "closeup_frusta"
/// holds the overlaid colours, "closeup_texels" the texels per pixel side in red, −1 outside all pairs.
class CloseupViewPasses {
 public:
  /// Adds the pass of FrameBuilder::visualizer() if the visualizer belongs to this module. A frame that draws no pair
  /// is left unchanged; if the cause is missing final lists, one warning says so.
  void add_pass(FrameBuilder& frame);

 private:
  OnceLog once_log_;
};

}  // namespace gloam
