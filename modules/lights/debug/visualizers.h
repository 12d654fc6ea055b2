// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"

namespace gloam {

/// Names and legends of the views of this module.
[[nodiscard]] std::vector<VisualizerInfo> light_visualizers();

/// Draws the views of the light lists over the picture, and each into an image of its own name, which a capture of the
/// frame shows.
class LightViews {
 public:
  /// Adds the pass of FrameBuilder::visualizer(), if that is one of this module's. Usage error unless lights.culling =
  /// tiled. A light that is in no list of the frame gives a dark picture without a tile; why is told once. Leaves alone
  /// what LightListViewTaken says.
  [[nodiscard]] Status add_pass(FrameBuilder& frame);

 private:
  /// Place of the named light among the view's sorted local lights, if it is there.
  [[nodiscard]] std::optional<std::uint32_t> shown_light(const FrameBuilder& frame, std::string_view name);

  std::set<std::string> told_;  ///< warnings
};

}  // namespace gloam
