// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/points/point_choice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gloam {
namespace {

/// Errors below it are invisible and equally good: they end the logarithmic scale. Nobody sees 0.01.
constexpr double kLeastError = 0.003;
/// Of the user's time. Gaps of the front beyond it are not worth filling: nobody pays more.
constexpr double kMostRatio = 2.0;
/// A neighbour's predicted error over that of the front's line.
constexpr double kMostAboveFront = 1.1;

double log_error(const Cost& cost) { return std::log(std::max(cost.error(), kLeastError)); }

/// The measured points that no other one makes pointless, the fastest first.
std::vector<const MeasuredCost*> measured_front(const std::vector<MeasuredCost>& measured) {
  std::vector<const MeasuredCost*> points;
  for (const MeasuredCost& point : measured) points.push_back(&point);
  std::ranges::stable_sort(points, [](const MeasuredCost* a, const MeasuredCost* b) {
    return a->cost.ratio != b->cost.ratio ? a->cost.ratio < b->cost.ratio : a->cost.error() < b->cost.error();
  });
  std::vector<const MeasuredCost*> front;
  for (const MeasuredCost* point : points)
    if (front.empty() || point->cost.error() < front.back()->cost.error()) front.push_back(point);
  return front;
}

struct Segment {
  const MeasuredCost& faster;
  const MeasuredCost& slower;

  [[nodiscard]] bool holds(double ratio) const { return ratio >= faster.cost.ratio && ratio < slower.cost.ratio; }
  /// Logarithm of the error over that of the line between the ends; below 0: better than the line.
  [[nodiscard]] double above_line(const Cost& cost) const {
    const double length = std::log(slower.cost.ratio / faster.cost.ratio);
    const double part = length > 0.0 ? std::log(cost.ratio / faster.cost.ratio) / length : 0.0;
    return log_error(cost) - (log_error(faster.cost) + part * (log_error(slower.cost) - log_error(faster.cost)));
  }
};

/// The area that a point would add to what the front covers, on logarithmic scales: over all times from the point's own
/// to that of the slowest one (at most kMostRatio), by how much it is more right than the front. A point near another
/// one adds little.
double added_area(const std::vector<const MeasuredCost*>& front, const Cost& cost) {
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < front.size(); ++i) {
    const double from = std::max(front[i]->cost.ratio, cost.ratio);
    const double to = std::min(front[i + 1]->cost.ratio, kMostRatio);
    if (to > from) area += std::log(to / from) * std::max(log_error(front[i]->cost) - log_error(cost), 0.0);
  }
  return area;
}

struct Proposal {
  Changes changes;
  double gain = 0.0;
};

/// The neighbour of the segment's ends that lies in the segment and would add most.
std::optional<Proposal> best_neighbour(const CostModel& model, const std::vector<MeasuredCost>& measured,
                                       const std::vector<const MeasuredCost*>& front, const Segment& segment) {
  std::optional<Proposal> best;
  for (const MeasuredCost* end : {&segment.faster, &segment.slower}) {
    for (const CostModel::VariedKnob& knob : model.knobs()) {
      for (const CostModel::Option& option : knob.options) {
        const Cost cost = model.predict_from(end->cost, end->changes, knob, option);
        if (!segment.holds(cost.ratio)) continue;
        if (segment.above_line(cost) > std::log(kMostAboveFront)) continue;
        const double gain = added_area(front, cost);
        if (gain <= 0.0 || (best && gain <= best->gain)) continue;
        Changes changes = model.folded(changed(end->changes, knob, option));
        if (std::ranges::find(measured, changes, &MeasuredCost::changes) != measured.end()) continue;
        best = Proposal{std::move(changes), gain};
      }
    }
  }
  return best;
}

}  // namespace

std::vector<Changes> spread(const CostModel& model, const std::vector<Changes>& front, std::size_t count) {
  if (front.size() <= count) return front;
  std::vector<Changes> chosen;
  if (count == 0) return chosen;
  std::vector<double> way = {0.0};  // along the front up to each combination
  for (std::size_t i = 1; i < front.size(); ++i) {
    const Cost a = model.predict(front[i - 1]), b = model.predict(front[i]);
    way.push_back(way.back() + std::hypot(std::log(b.ratio / a.ratio), log_error(b) - log_error(a)));
  }
  std::size_t next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double wanted = count > 1 ? way.back() * static_cast<double>(i) / static_cast<double>(count - 1) : 0.0;
    // Leave a combination for each of the others.
    while (next + (count - i) < front.size() && way[next] < wanted) ++next;
    chosen.push_back(front[next++]);
  }
  return chosen;
}

std::optional<Changes> improve(const CostModel& model, const std::vector<MeasuredCost>& measured,
                               Improvements& improvements) {
  const std::vector<const MeasuredCost*> front = measured_front(measured);
  std::optional<Proposal> best;
  const MeasuredCost* begin = nullptr;
  for (std::size_t i = 0; i + 1 < front.size(); ++i) {
    std::optional<Proposal> proposal = best_neighbour(model, measured, front, {*front[i], *front[i + 1]});
    if (!proposal) continue;
    // A prediction that did not come true leaves its segment as it was: others have their turn.
    proposal->gain /= static_cast<double>(1 + improvements[front[i]->changes]);
    if (best && proposal->gain <= best->gain) continue;
    best = std::move(proposal);
    begin = front[i];
  }
  if (!best) return std::nullopt;
  ++improvements[begin->changes];
  return std::move(best->changes);
}

}  // namespace gloam
