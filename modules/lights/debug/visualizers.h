// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/core/once_log.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"

namespace gloam {

/// Names and legends of this module's visualizers.
[[nodiscard]] std::vector<VisualizerInfo> light_visualizers();

/// Draws the visualizers of the light lists over the picture. Each is also drawn into an image of the same name, for
/// captures.
class LightViews {
 public:
  /// Adds the pass of FrameBuilder::visualizer() if the visualizer belongs to this module. Usage error unless
  /// lights.culling = tiled. If the named light is in none of the frame's lists, the picture is darkened, no tile is
  /// marked and one warning says why. Adds nothing if a later module draws the visualizer (LightListViewTaken).
  void add_pass(FrameBuilder& frame);

 private:
  /// Index of the named light in the view's sorted local lights; none if it is not among
  /// them (logs one warning).
  [[nodiscard]] std::optional<std::uint32_t> shown_light(const FrameBuilder& frame, std::string_view name);

  OnceLog once_log_;
};

}  // namespace gloam
