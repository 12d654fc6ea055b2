// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/render/governor/governor.h"
#include "engine/render/knobs/knobs.h"

// A time for frames, and the measured settings to choose from (Renderer::set_budget).

namespace gloam {

/// A whole setting that was measured: a point of a cost ledger.
struct FrontPoint {
  double ms = 0.0;     ///< of a frame, when it was measured; only ratios between points are used
  double error = 0.0;  ///< against the exact setting, on any scale on which less is better
  /// The knobs that are not at their declared default.
  std::vector<KnobOverride> settings;
};

struct FrameBudget {
  std::string effect = {};        ///< the module whose passes are to keep within `ms`; empty: whole frames
  double ms = 0.0;                ///< of a frame, > 0; infinity: the most exact point
  std::vector<FrontPoint> front;  ///< at least one point, in any order; a point that another one beats is never chosen
  std::vector<std::string> locked;  ///< knobs that keep their values
};

/// How long a frame took, for the budget.
struct FrameTime {
  std::string_view effect = {};  ///< FrameBudget::effect of the budget that it is for
  double ms = 0.0;               ///< by the caller's clock: what the budget is for
  bool judged = true;            ///< false: the frame says nothing of others, for example because a window was resized
  std::uint64_t view = 0;        ///< another number than in the frame before: other things are seen (a camera cut)
};

/// A neighbour of the point in use.
struct BudgetStep {
  double ms = 0.0;  ///< 90th percentile to expect there, by the last frames; without frames, when it was measured
  double error = 0.0;
  std::vector<KnobOverride> settings = {};
};

/// What a budget has chosen so far.
struct BudgetState {
  std::string effect = {};                 ///< FrameBudget::effect
  double ms = 0.0;                         ///< the budget
  std::size_t points = 0;                  ///< that can be chosen, from the fastest to the most exact
  std::size_t point = 0;                   ///< index of the one in use
  std::size_t changes = 0;                 ///< of point, since the budget was set
  double error = 0.0;                      ///< of the point in use
  std::vector<KnobOverride> settings;      ///< FrontPoint::settings of the point in use
  GovernorDecision last_change;            ///< the decision that changed the point last
  double measured_ms = 0.0;                ///< 90th percentile of the last frames in the point in use; 0: none yet
  std::optional<BudgetStep> cheaper = {};  ///< none at the fastest point
  std::optional<BudgetStep> better = {};   ///< none at the most exact point
  std::vector<std::string> governed = {};  ///< knobs that the budget sets
  std::vector<std::string> named = {};     ///< knobs that the front's points name: governed or locked
  std::vector<std::string> locked = {};    ///< FrameBudget::locked
  std::vector<KnobOverride> exact = {};    ///< values of the governed knobs in the most exact point
};

}  // namespace gloam
