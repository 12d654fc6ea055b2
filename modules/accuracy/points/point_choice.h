// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "modules/accuracy/points/cost_model.h"

namespace gloam {

/// At most `count` of the combinations, from the first to the last, about equally far apart in the logarithms of
/// predicted time and error. front: CostModel::front().
[[nodiscard]] std::vector<Changes> spread(const CostModel& model, const std::vector<Changes>& front, std::size_t count);

/// A combination that was measured.
struct MeasuredCost {
  Changes changes;
  Cost cost;
};

/// How often each stretch of the front was chosen for an improvement, by its faster end.
using Improvements = std::map<Changes, std::size_t>;

/// The combination to measure next: a neighbour of the measured front, which differs from one of its points in one
/// knob, and whose predicted error is at most 10 % above the line between the two points of the front beside it. Of
/// these, the one that would add the greatest area to what the front covers, on logarithmic scales: it fills the widest
/// gap best. Each improvement of a segment makes its next one count less. None: no neighbour promises anything.
[[nodiscard]] std::optional<Changes> improve(const CostModel& model, const std::vector<MeasuredCost>& measured,
                                             Improvements& improvements);

}  // namespace gloam
