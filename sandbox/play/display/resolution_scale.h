// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gloam {

/// The share of the window's width and height that frames are drawn at: fixed, or chosen so that frames stay within a
/// time. Automatic changes are rare and go between few sizes, because a change of size makes new images and resets
/// effects that accumulate over frames.
class ResolutionScale {
 public:
  static constexpr std::array kSteps = {0.25, 0.3, 0.35, 0.42, 0.5, 0.6, 0.7, 0.85, 1.0};
  /// Frames after a change that are not judged: they make images and draw what is cached later.
  static constexpr std::size_t kUnjudged = 2;
  /// Judged frames before a change to fewer or to more pixels.
  static constexpr std::size_t kBeforeDown = 3;
  static constexpr std::size_t kBeforeUp = 8;
  /// Frames for which a step that was too slow is not tried again, unless frames have become much faster.
  static constexpr std::uint64_t kBlockedFrames = 400;

  /// The time of a frame that automatic changes aim at, in milliseconds, > 0.
  struct Budget {
    double rest_ms = 0.0;    ///< while the camera rests
    double moving_ms = 0.0;  ///< while it moves, and what is kept at rest is computed
  };
  /// setting: as for set().
  ResolutionScale(const Budget& budget, double setting);

  /// setting: 0 for automatic, otherwise the fixed scale, 0.25…1.
  void set(double setting);
  [[nodiscard]] double setting() const { return setting_; }
  /// The scale of the next frame.
  [[nodiscard]] double scale() const { return setting_ > 0.0 ? setting_ : kSteps[step_]; }

  /// Before the first frame, and after a change of the window's size: the largest step with at most this many pixels,
  /// at least the smallest step. Width and height in pixels, > 0.
  void start(std::uint32_t width, std::uint32_t height, double most_pixels);

  /// Adds a frame's time. moving: the camera has moved in it. Returns whether the automatic scale has changed.
  bool add(double frame_ms, bool moving);

 private:
  // Times are shares of their budgets.
  /// The time at a step, from that at the present one. Of a frame's time, `fixed_share` does not depend on its pixels.
  [[nodiscard]] double expected(double time, std::size_t step, double fixed_share) const;
  /// The largest step whose time is expected within `most`; at least 0.
  [[nodiscard]] std::size_t fitting_step(double time, double most, double fixed_share) const;
  void change_to(std::size_t step);

  Budget budget_;
  double setting_;
  std::size_t step_ = kSteps.size() - 1;
  std::vector<double> times_;  ///< since the last change, without unjudged frames; kBeforeUp at most
  std::size_t unjudged_ = kUnjudged;
  std::uint64_t frame_ = 0;
  std::array<std::uint64_t, kSteps.size()> blocked_until_ = {};
};

/// Limits of the automatic scale on a kind of device.
struct ScaleLimits {
  ResolutionScale::Budget budget;
  double first_pixels = 0.0;  ///< most pixels of the first frames
};
[[nodiscard]] ScaleLimits scale_limits(bool on_software);

/// Width or height at which a frame is drawn. size: of the window, > 0.
[[nodiscard]] std::uint32_t scaled_side(std::uint32_t size, double scale);

}  // namespace gloam
