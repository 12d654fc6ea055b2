// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/figures.h"

#include <cmath>
#include <cstddef>

#include "engine/core/text/formatted.h"

namespace gloam {
namespace {

double seconds(PlayFigures::Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

std::string number(const char* format, double value) { return formatted(format, value); }

}  // namespace

void PlayFigures::add(Clock::time_point now, std::uint32_t width, std::uint32_t height, double scale) {
  shown_.push_back(now);
  width_ = width;
  height_ = height;
  scale_ = scale;
}

std::string PlayFigures::text() const {
  if (shown_.empty()) return "no frame was shown";
  std::string text = std::to_string(shown_.size()) + (shown_.size() == 1 ? " frame" : " frames");
  const std::size_t last = shown_.size() / 2;  // frames with a time, counted from the end
  const double run_s = seconds(shown_.back() - shown_[shown_.size() - 1 - last]);
  if (run_s > 0.0) {
    const double frame_s = run_s / static_cast<double>(last);
    text += "; the last " + std::to_string(last) + ": " + number("%.1f", 1.0 / frame_s) + " frames/s (" +
            number("%.0f", 1e3 * frame_s) + " ms)";
  }
  text += ", drawn at " + std::to_string(width_) + "x" + std::to_string(height_) + " (" +
          std::to_string(std::lround(100.0 * scale_)) + " %); first picture after ";
  return text + number("%.2f", seconds(shown_.front() - start_)) + " s";
}

}  // namespace gloam
