// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace gloam {

/// Times of a run of `play` with a number of frames.
class PlayFigures {
 public:
  using Clock = std::chrono::steady_clock;

  /// start: of the program.
  explicit PlayFigures(Clock::time_point start) : start_(start) {}

  /// Adds a frame that was shown. The first frame of a run must be complete; later ones may be on their way. width and
  /// height of what was drawn, before it was enlarged.
  void add(Clock::time_point now, std::uint32_t width, std::uint32_t height, double scale);

  /// "300 frames; the last 150: 12.3 frames/s (80 ms), drawn at 640x360 (50 %); first picture after 1.21 s". The first
  /// half is left out of the rate: in it the automatic scale settles.
  [[nodiscard]] std::string text() const;

 private:
  Clock::time_point start_;
  std::vector<Clock::time_point> shown_;
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  double scale_ = 1.0;
};

}  // namespace gloam
