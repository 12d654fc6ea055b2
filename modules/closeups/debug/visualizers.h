// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

/// Pairs that a view shows; what comes after them is left out.
inline constexpr std::size_t kMostShownCloseups = 64;

/// The pairs that the frame draws maps of; skipped ones, and all of a frame without final lists, are none.
[[nodiscard]] std::span<const CloseupView> drawn_closeups(const FrameBuilder& frame);

/// Linear colour that stands for a pair, by its entity: it stays while the pair lives.
[[nodiscard]] vec3 closeup_color(Entity pair);

/// Names and legends of the views of this module.
[[nodiscard]] std::vector<VisualizerInfo> closeup_visualizers();

/// Draws the views of close-ups over the picture, and each into an image of its own name: "closeup_frusta" as it lies
/// over the picture, "closeup_texels" with the texels a pixel's side in red, −1 where there are none.
class CloseupViewPasses {
 public:
  /// Adds the pass of FrameBuilder::visualizer(), if that is one of this module's. A frame that draws no pair is left
  /// as it is; where final lists are missing, that is told once.
  [[nodiscard]] Status add_pass(FrameBuilder& frame);

 private:
  std::set<std::string> told_;  ///< warnings
};

}  // namespace gloam
