// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/resolution_scale.h"

#include <algorithm>
#include <cmath>

#include "engine/core/assert.h"
#include "sandbox/session/results/summary.h"

namespace gloam {
namespace {

constexpr double kDownAim = 0.9;  // of the budget, for a change to fewer pixels
constexpr double kUpAim = 0.85;   // and to more
// Of the budget: a step that was too slow is tried again if its frames should be this fast. Then something else was
// slow, such as the first frames of a scene, which draw all shadow maps.
constexpr double kSurelyFast = 0.7;
constexpr double kFixedShareDown = 0.25;  // geometry, shadow maps and lists hardly depend on the number of pixels

}  // namespace

ResolutionScale::ResolutionScale(const Budget& budget, double setting) : budget_(budget), setting_(setting) {
  GLOAM_ASSERT(budget.rest_ms > 0.0 && budget.moving_ms > 0.0, "the time of a frame is above 0");
}

void ResolutionScale::set(double setting) {
  GLOAM_ASSERT(setting == 0.0 || (setting >= kSteps.front() && setting <= 1.0), "a fixed scale is 0.25 to 1");
  setting_ = setting;
  times_.clear();
  unjudged_ = kUnjudged;
}

void ResolutionScale::start(std::uint32_t width, std::uint32_t height, double most_pixels) {
  const double pixels = static_cast<double>(width) * static_cast<double>(height);
  std::size_t step = kSteps.size() - 1;
  while (step > 0 && kSteps[step] * kSteps[step] * pixels > most_pixels) --step;
  change_to(step);
  blocked_until_ = {};
}

bool ResolutionScale::add(double frame_ms, bool moving) {
  ++frame_;
  if (unjudged_ > 0) {
    --unjudged_;
    return false;
  }
  if (times_.size() == kBeforeUp) times_.erase(times_.begin());
  times_.push_back(frame_ms / (moving ? budget_.moving_ms : budget_.rest_ms));
  if (setting_ > 0.0) return false;
  if (times_.size() < kBeforeDown) return false;
  const std::vector<double> newest(times_.end() - kBeforeDown, times_.end());
  const double now = summarize(newest).median;
  if (now > 1.0 && step_ > 0) {
    blocked_until_[step_] = frame_ + kBlockedFrames;
    change_to(std::min(fitting_step(now, kDownAim, kFixedShareDown), step_ - 1));
    return true;
  }
  if (times_.size() < kBeforeUp) return false;
  const double steady = summarize(times_).median;
  std::size_t step = fitting_step(steady, kUpAim, 0.0);
  for (std::size_t above = step_ + 1; above <= step; ++above)
    if (blocked_until_[above] > frame_ && expected(steady, above, 0.0) > kSurelyFast) step = above - 1;
  if (step <= step_) return false;
  change_to(step);
  return true;
}

double ResolutionScale::expected(double time, std::size_t step, double fixed_share) const {
  const double ratio = kSteps[step] / kSteps[step_];
  return time * (fixed_share + (1.0 - fixed_share) * ratio * ratio);
}

std::size_t ResolutionScale::fitting_step(double time, double most, double fixed_share) const {
  std::size_t step = kSteps.size() - 1;
  while (step > 0 && expected(time, step, fixed_share) > most) --step;
  return step;
}

void ResolutionScale::change_to(std::size_t step) {
  step_ = step;
  times_.clear();
  unjudged_ = kUnjudged;
}

ScaleLimits scale_limits(bool on_software) {
  // Software devices should keep 20 frames a second at rest and 10 while the camera moves. A frame of the first pixels
  // takes them about 80 ms.
  return on_software ? ScaleLimits{.budget = {.rest_ms = 46.0, .moving_ms = 85.0}, .first_pixels = 115000.0}
                     : ScaleLimits{.budget = {.rest_ms = 20.0, .moving_ms = 20.0}, .first_pixels = 1e9};
}

std::uint32_t scaled_side(std::uint32_t size, double scale) {
  constexpr std::uint32_t kSmallestSide = 16;
  const auto pixels = static_cast<std::uint32_t>(std::lround(size * scale));
  return std::clamp(pixels, std::min(kSmallestSide, size), size);
}

}  // namespace gloam
