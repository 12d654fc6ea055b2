// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/entity.h"
#include "engine/render/frame_builder.h"
#include "modules/closeups/pairs/views.h"
#include "modules/shadows/outputs.h"
#include "shaders/closeups/closeups_shared.h"

namespace gloam {

/// The close-up part of visualizers "shadow_unculled:LIGHT" and "shadow_filtered:LIGHT": the share of the light that
/// its pairs' maps leave at every pixel, without umbra ranges and lists. Does nothing if the frame shows another
/// visualizer.
class UnculledPairs {
 public:
  explicit UnculledPairs(const FrameBuilder& frame);
  /// Adds the pair's pass if the pair is of the shown light. Call it while the pair's map exists. shadows: with the
  /// filter for close-up maps and the atlas, pyramid and block of the close-up map. constants: as for compose.glsl.
  void add(FrameBuilder& frame, const CloseupView& pair, const ShadowsOutputs& shadows,
           const shaders::CloseupConstants& constants);
  /// Puts UnculledCloseups on the board if a pair was added.
  void finish(FrameBuilder& frame) const;

 private:
  Entity light_ = kNoEntity;  ///< the shown light
  ImageRef visibility_;
};

}  // namespace gloam
