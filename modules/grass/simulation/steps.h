// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

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

  /// Advances by the scene's time, once in each frame of the world (RenderView::frame). A frame that is drawn again,
  /// that follows one that was given up, or whose time is that of the frame before, has the steps of the first time. If
  /// time has gone back, the clock starts again at step 0.
  void advance_in(std::uint64_t frame, const SceneClock& scene);

  /// Steps that the last call of advance() has made.
  [[nodiscard]] std::uint32_t frame_steps() const { return frame_steps_; }
  /// Number of the step that the frame reaches. After 2³² − 2 follows 0, so it is never GLOAM_GRASS_NO_STEP.
  [[nodiscard]] std::uint32_t now() const { return now_; }
  /// Number of the step from which the frame begins, i.e. now() of the frame before.
  [[nodiscard]] std::uint32_t first_step() const { return first_step_; }
  /// Time that the next frame begins with, in [0, kGrassStep).
  [[nodiscard]] double remainder_s() const { return remainder_s_; }

  /// Whether the last frame has made steps since the frame before. False if their times are equal.
  [[nodiscard]] bool moves() const { return moves_ && frame_steps_ > 0; }
  /// Times that the clock was started again. The blades of another start are put at rest.
  [[nodiscard]] std::uint32_t restarts() const { return restarts_; }

  /// Starts again at this step, with no remainder.
  void restart(std::uint32_t step);

 private:
  std::uint64_t frame_ = ~std::uint64_t{0};
  double time_s_ = std::numeric_limits<double>::quiet_NaN();  ///< of the scene in the last frame; NaN: none
  double remainder_s_ = 0.0;
  std::uint32_t frame_steps_ = 0;
  std::uint32_t first_step_ = 0;
  std::uint32_t now_ = 0;
  std::uint32_t restarts_ = 0;
  bool moves_ = false;
};

/// Steps from `from` to `to` in the numbering of StepClock, where 0 follows 2³² − 2.
[[nodiscard]] std::uint32_t steps_between(std::uint32_t from, std::uint32_t to);

/// Advances the clock to the frame's time.
void grass_steps_system(ViewResource<const RenderView> view, Resource<const SceneClock> clock,
                        Resource<StepClock> steps);

}  // namespace gloam
