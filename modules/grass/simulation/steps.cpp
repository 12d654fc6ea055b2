// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/simulation/steps.h"

#include <algorithm>
#include <cmath>

#include "shaders/grass/grass_shared.h"

namespace gloam {

void StepClock::advance(double dt_s) {
  constexpr double kMost = kGrassStep * kMostGrassSteps;
  const double dt = dt_s > 0.0 ? std::min(dt_s, 2.0 * kMost) : 0.0;  // false for NaN
  // A tolerance, so that frames of whole steps do not lose one to rounding.
  const double due = (remainder_s_ + dt) / kGrassStep;
  const double whole = std::floor(due + 1e-9);
  first_step_ = now_;
  frame_steps_ = static_cast<std::uint32_t>(std::min(whole, double{kMostGrassSteps}));
  remainder_s_ = whole > kMostGrassSteps ? 0.0 : std::max(due - whole, 0.0) * kGrassStep;
  now_ = static_cast<std::uint32_t>((std::uint64_t{now_} + frame_steps_) % GLOAM_GRASS_NO_STEP);
}

void StepClock::advance_in(std::uint64_t frame, const SceneClock& scene) {
  if (frame == frame_) return;
  if (scene.time_s < time_s_) restart(0);
  frame_ = frame;
  moves_ = scene.time_s != time_s_;  // also for NaN
  if (!moves_) return;
  time_s_ = scene.time_s;
  advance(scene.dt_s);
}

void StepClock::restart(std::uint32_t step) {
  const std::uint32_t restarts = restarts_ + 1;
  *this = {};
  restarts_ = restarts;
  first_step_ = now_ = step == GLOAM_GRASS_NO_STEP ? 0 : step;
}

std::uint32_t steps_between(std::uint32_t from, std::uint32_t to) {
  return to >= from ? to - from : GLOAM_GRASS_NO_STEP - from + to;
}

void grass_steps_system(ViewResource<const RenderView> view, Resource<const SceneClock> clock,
                        Resource<StepClock> steps) {
  steps->advance_in(view->frame, *clock);
}

}  // namespace gloam
