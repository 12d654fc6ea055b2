// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/view.h"
#include "engine/scene/resources.h"
#include "engine/schedule/parameters.h"

namespace gloam {

inline constexpr double kGrassStep = 1.0 / 120.0;    // s
inline constexpr std::uint32_t kMostGrassSteps = 8;  // in a frame
inline constexpr std::uint32_t kMostGrassIterations = 64;

/// Divides the time of frames into steps of equal length; a world resource. A frame advances at most kMostGrassSteps;
/// the time beyond is dropped.
class StepClock {
 public:
  /// dt_s: duration of the frame. NaN and negative durations count as 0.
  void advance(double dt_s);

  /// The same, once in each frame of the world (RenderView::frame): a frame that is drawn again, or that follows one
  /// that was given up, has the steps of the first time.
  void advance_in(std::uint64_t frame, double dt_s);

  /// Steps that the last call of advance() has made.
  [[nodiscard]] std::uint32_t frame_steps() const { return frame_steps_; }
  /// Number of the step that the frame reaches. After 2³² − 2 follows 0, so it is never GLOAM_GRASS_NO_STEP.
  [[nodiscard]] std::uint32_t now() const { return now_; }
  /// Number of the step from which the frame begins, i.e. now() of the frame before.
  [[nodiscard]] std::uint32_t first_step() const { return first_step_; }
  /// Time that the next frame begins with, in [0, kGrassStep).
  [[nodiscard]] double remainder_s() const { return remainder_s_; }

  /// Continues at this step, with no remainder.
  void restart(std::uint32_t step);

 private:
  std::uint64_t frame_ = ~std::uint64_t{0};
  double remainder_s_ = 0.0;
  std::uint32_t frame_steps_ = 0;
  std::uint32_t first_step_ = 0;
  std::uint32_t now_ = 0;
};

/// Steps from `from` to `to` in the numbering of StepClock, where 0 follows 2³² − 2.
[[nodiscard]] std::uint32_t steps_between(std::uint32_t from, std::uint32_t to);

/// Advances the clock by the frame's duration.
void grass_steps_system(ViewResource<const RenderView> view, Resource<const SceneClock> clock,
                        Resource<StepClock> steps);

}  // namespace gloam
