// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "engine/render/governor/governor.h"

// A made-up machine that draws frames for a governor, and the figures of what the governor did. Nothing here knows how
// the governor decides.

namespace gloam::test {

enum class Noise { uniform, gaussian };

/// Noise of frame times. The same seed gives the same noise on every platform: distributions of the standard library
/// do not.
class NoiseSource {
 public:
  /// level: half the width of a uniform noise, or the standard deviation of a Gaussian one; both relative, 0…0.15.
  NoiseSource(std::uint32_t seed, Noise kind, double level) : random_(seed), kind_(kind), level_(level) {}

  /// A factor on a frame's time.
  double next() {
    if (kind_ == Noise::uniform) return 1.0 + level_ * (2.0 * unit() - 1.0);
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit()));
    return std::max(0.2, 1.0 + level_ * radius * std::cos(2.0 * std::numbers::pi * unit()));
  }
  /// The 90th percentile of the factor.
  [[nodiscard]] double percentile_90() const { return 1.0 + level_ * (kind_ == Noise::uniform ? 0.8 : 1.2816); }

 private:
  double unit() { return static_cast<double>(random_()) / 4294967296.0; }

  std::mt19937 random_;
  Noise kind_;
  double level_;
};

struct Machine {
  std::vector<double> ms;  ///< true time of each point at load 1, milliseconds
  /// Factor on a point's time in a frame.
  std::function<double(std::size_t frame, std::size_t point)> load = [](std::size_t, std::size_t) { return 1.0; };
  std::function<std::uint64_t(std::size_t frame)> view = [](std::size_t) { return std::uint64_t{0}; };
  Noise kind = Noise::uniform;
  double noise = 0.0;
  std::uint32_t seed = 1;
  std::size_t unjudged = 2;  ///< frames after a change of point; they take half as long again

  [[nodiscard]] double true_ms(std::size_t frame, std::size_t point) const { return ms[point] * load(frame, point); }
  [[nodiscard]] double noise_percentile_90() const { return NoiseSource(seed, kind, noise).percentile_90(); }
};

struct DrawnFrame {
  double ms = 0.0;
  double true_ms = 0.0;  ///< without noise and without the cost of a change
  double budget_ms = 0.0;
  std::size_t point = 0;
  GovernorDecision decision;
};
using Drive = std::vector<DrawnFrame>;

/// Draws frames with the points that the governor chooses. budget_ms: of each frame; without it the governor's stays.
inline Drive draw(Governor& governor, const Machine& machine, std::size_t frames,
                  const std::function<double(std::size_t)>& budget_ms = {}) {
  Drive run;
  run.reserve(frames);
  NoiseSource noise(machine.seed, machine.kind, machine.noise);
  std::size_t since_change = machine.unjudged;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    if (budget_ms) governor.set_budget(budget_ms(frame));
    DrawnFrame drawn;
    drawn.point = governor.point();
    drawn.budget_ms = governor.budget_ms();
    drawn.true_ms = machine.true_ms(frame, drawn.point);
    const bool judged = since_change >= machine.unjudged;
    drawn.ms = drawn.true_ms * noise.next() * (judged ? 1.0 : 1.5);
    drawn.decision = governor.add({drawn.ms, judged, machine.view(frame)});
    since_change = drawn.decision.changed() ? 0 : since_change + 1;
    run.push_back(drawn);
  }
  return run;
}

/// What the governor did in a part of a run.
struct Figures {
  std::size_t changes = 0;
  double seconds = 0.0;
  std::size_t settle_frames = 0;  ///< until the point stays within one of the point at the end
  double settle_seconds = 0.0;
  double over_share = 0.0;     ///< of frames that took longer than the budget
  double p90_of_budget = 0.0;  ///< 90th percentile of the frames' times, divided by the budget
  std::size_t longest_over =
      0;  ///< frames in a row whose true time was more than 10 % over the budget, of those not at point 0
  std::size_t lowest = 0;   ///< the cheapest point that was used
  std::size_t last = 0;     ///< the point at the end
  std::size_t main = 0;     ///< the point that most frames were drawn with
  double mean_error = 0.0;  ///< of the points that frames were drawn with
};

inline Figures figures_of(std::span<const DrawnFrame> part, std::span<const GovernorPoint> front) {
  Figures figures;
  std::vector<double> relative;
  std::vector<std::size_t> used(front.size());
  figures.last = part.back().decision.point;
  std::size_t over = 0;
  std::size_t over_now = 0;
  figures.lowest = front.size();
  for (std::size_t i = 0; i < part.size(); ++i) {
    const DrawnFrame& frame = part[i];
    figures.seconds += frame.ms / 1000.0;
    figures.changes += frame.decision.changed() ? 1 : 0;
    if (frame.point + 1 < figures.last || frame.point > figures.last + 1) {
      figures.settle_frames = i + 1;
      figures.settle_seconds = figures.seconds;
    }
    over += frame.ms > frame.budget_ms ? 1 : 0;
    // At point 0 nothing can be done.
    over_now = frame.point > 0 && frame.true_ms > 1.1 * frame.budget_ms ? over_now + 1 : 0;
    figures.longest_over = std::max(figures.longest_over, over_now);
    figures.lowest = std::min(figures.lowest, frame.point);
    ++used[frame.point];
    figures.mean_error += front[frame.point].error / static_cast<double>(part.size());
    relative.push_back(frame.ms / frame.budget_ms);
  }
  figures.main = static_cast<std::size_t>(std::max_element(used.begin(), used.end()) - used.begin());
  figures.over_share = static_cast<double>(over) / static_cast<double>(part.size());
  std::sort(relative.begin(), relative.end());
  figures.p90_of_budget = relative[(relative.size() * 9 + 9) / 10 - 1];
  return figures;
}

/// The 90th percentile of the frames' times if a point is held.
inline double fixed_percentile_90(const Machine& machine, std::size_t begin, std::size_t end, std::size_t point) {
  std::vector<double> times;
  for (std::size_t frame = begin; frame < end; ++frame) times.push_back(machine.true_ms(frame, point));
  std::sort(times.begin(), times.end());
  return times[(times.size() * 9 + 9) / 10 - 1] * machine.noise_percentile_90();
}

/// The most exact point whose fixed_percentile_90() is at most limit_ms; 0 if there is none.
inline std::size_t best_fixed_point(const Machine& machine, std::size_t begin, std::size_t end, double limit_ms) {
  for (std::size_t point = machine.ms.size() - 1; point > 0; --point)
    if (fixed_percentile_90(machine, begin, end, point) <= limit_ms) return point;
  return 0;
}

/// A recorded series: a line for each frame, a number for each point, in milliseconds.
inline std::vector<std::vector<double>> parse_series(std::string_view text) {
  std::vector<std::vector<double>> frames;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, length);
    text.remove_prefix(std::min(length + 1, text.size()));
    std::vector<double> frame;
    while (!line.empty()) {
      double ms = 0.0;
      const auto [end, fault] = std::from_chars(line.data(), line.data() + line.size(), ms);
      if (fault != std::errc()) {
        line.remove_prefix(1);
        continue;
      }
      frame.push_back(ms);
      line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    }
    if (!frame.empty()) frames.push_back(frame);
  }
  return frames;
}

/// A machine that repeats a recorded series without its first frames, which made pipelines.
inline Machine recorded_machine(std::string_view text, std::size_t skipped) {
  const std::vector<std::vector<double>> series = parse_series(text);
  Machine machine;
  machine.ms.assign(series.front().size(), 1.0);
  machine.load = [series, skipped](std::size_t frame, std::size_t point) {
    return series[skipped + frame % (series.size() - skipped)][point];
  };
  return machine;
}

/// A front whose times and errors change by the same factors from point to point.
inline std::vector<GovernorPoint> geometric_front(std::size_t count, double first_ms, double growth) {
  std::vector<GovernorPoint> front;
  for (std::size_t i = 0; i < count; ++i)
    front.push_back({first_ms * std::pow(growth, static_cast<double>(i)), 0.2 * std::pow(0.8, static_cast<double>(i))});
  return front;
}

/// A machine whose times are the front's, times a factor.
inline Machine machine_of(std::span<const GovernorPoint> front, double factor = 1.0) {
  Machine machine;
  for (const GovernorPoint& point : front) machine.ms.push_back(point.ms * factor);
  return machine;
}

}  // namespace gloam::test
