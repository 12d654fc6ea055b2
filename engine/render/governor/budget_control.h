// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/governor/frame_budget.h"
#include "engine/render/governor/governor.h"
#include "engine/render/knobs/knobs.h"

namespace gloam {

/// Sets knobs to the points that the governor chooses. Knobs that no point names, and locked ones, are left alone.
class BudgetControl {
 public:
  /// Frames after a change of point that are not judged: they make images and fill histories.
  static constexpr std::uint32_t kUnjudged = 2;

  /// Usage error for a budget that is not above 0, without a point, or with a setting that the registry refuses. Then
  /// nothing has changed. knobs: those that add() will set.
  [[nodiscard]] static Result<BudgetControl> create(FrameBudget budget, const KnobRegistry& knobs);

  /// Changes the time and the locked knobs. The point in use and what its frames have shown stay. Usage error as of
  /// create(); then nothing has changed.
  [[nodiscard]] Status change(double ms, std::vector<std::string> locked, const KnobRegistry& knobs);
  /// Sets the knobs to the point in use.
  void apply(KnobRegistry& knobs) const;
  /// Adds a frame and decides about the next ones. drawn_version: KnobRegistry::version of the values that it was drawn
  /// with. After a change the knobs have the new point's values. Allocates nothing.
  GovernorDecision add(const FrameTime& time, std::uint64_t drawn_version, KnobRegistry& knobs);
  /// Whether the point in use has just been drawn often enough to be judged; once after each change of point. Then is
  /// the time to make the pipelines of the points beside it.
  [[nodiscard]] bool take_settled() { return std::exchange(just_settled_, false); }
  /// Sets the governed knobs of `knobs` to a neighbour of the point in use; false: there is none. step: −1 or 1.
  [[nodiscard]] bool set_neighbour(int step, KnobRegistry& knobs) const;
  [[nodiscard]] BudgetState state() const;
  [[nodiscard]] const std::string& effect() const { return effect_; }
  [[nodiscard]] double budget_ms() const { return governor_.budget_ms(); }
  /// A knob that both budgets set; nullptr if there is none.
  [[nodiscard]] const std::string* shared_knob(const BudgetControl& other) const;

 private:
  BudgetControl(std::vector<FrontPoint> front, const Governor& governor)
      : front_(std::move(front)), governor_(governor) {}
  [[nodiscard]] BudgetStep step_to(std::size_t point) const;
  void set_point(std::size_t point, KnobRegistry& knobs) const;
  /// Finds the knobs that points set, and their numbers in each point.
  [[nodiscard]] Status resolve(std::vector<std::string> locked, const KnobRegistry& knobs);

  std::string effect_;
  std::vector<std::string> locked_;
  std::vector<FrontPoint> front_;      ///< the fastest first, each more right than all before it
  std::vector<std::size_t> governed_;  ///< indices into KnobRegistry::knobs()
  std::vector<std::string> governed_names_;
  std::vector<std::string> named_;
  std::vector<KnobOverride> exact_;
  std::vector<double> numbers_;  ///< of the governed knobs, point by point
  Governor governor_;
  std::uint32_t frames_here_ = 0;  ///< drawn with the point in use
  bool just_settled_ = false;
  std::size_t changes_ = 0;
  GovernorDecision last_change_;
};

}  // namespace gloam
