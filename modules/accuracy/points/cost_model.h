// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/render/knobs/knobs.h"
#include "modules/accuracy/outputs.h"

namespace gloam {

/// The knobs that a combination changes against the user's settings, and their values.
using Changes = std::map<std::string, std::string>;

/// Whether the knob says what of the last frame is kept. Combinations neither vary nor hold such knobs: they are
/// measured at rest, where these knobs save what a moving camera pays for. Whoever draws with a combination keeps its
/// own values.
[[nodiscard]] bool reuses_last_frame(const Knob& knob);

/// Time and error of a combination, predicted or measured.
struct Cost {
  double ratio = 1.0;          ///< of the frame's time to that of the user's settings
  double squared_error = 0.0;  ///< of the mean FLIP against the whole frame
  [[nodiscard]] double error() const;
};

/// Predicts combinations from the rows of single knobs.
///
/// A row is a frame with the user's settings and one other value. Its ratio less the default's is what the value adds
/// to the time; the square of its whole-frame error less the square of the default's is what it adds to the squared
/// error (errors of independent effects add as variances do). Both may be negative. The model adds them over the
/// changed knobs; ratios of knobs that scale the frame multiply the sum. A difference in time that is not significant
/// counts as none, because the best of many would be the luckiest; so does a difference in error that nobody can see.
class CostModel {
 public:
  struct Option {
    std::string value;
    Cost added;  ///< 0 for the user's value
  };
  struct VariedKnob {
    std::string name;
    std::vector<Option> options;  ///< the first is the user's value
    bool scales_frame = false;    ///< Knob::scales_frame
  };

  /// rows: of a finished ledger. knobs: with the user's values. Knobs without effect, looks and wrong values are not
  /// varied.
  CostModel(const std::vector<LedgerRow>& rows, const KnobRegistry& knobs);

  [[nodiscard]] const std::vector<VariedKnob>& knobs() const { return knobs_; }
  /// The changes without those of knobs that change nothing together with the others (Knob::only_with).
  [[nodiscard]] Changes folded(Changes changes) const;
  /// changes: folded.
  [[nodiscard]] Cost predict(const Changes& changes) const;
  /// The cost of `changes` with one more change, from its measured cost.
  [[nodiscard]] Cost predict_from(const Cost& measured, const Changes& changes, const VariedKnob& knob,
                                  const Option& option) const;
  /// The predicted front of folded combinations, the fastest first.
  [[nodiscard]] std::vector<Changes> front() const;

 private:
  [[nodiscard]] Cost added_by(const VariedKnob& knob, const Changes& changes) const;
  /// Ratio of the knobs that scale the frame.
  [[nodiscard]] double scale(const Changes& changes) const;
  /// All combinations that no other one beats if all added values hold, unfolded.
  [[nodiscard]] std::vector<Changes> candidates() const;

  KnobRegistry users_;
  std::vector<VariedKnob> knobs_;
  double users_squared_error_ = 0.0;
};

/// changes with the knob set to the option. The user's own value is no change.
[[nodiscard]] Changes changed(Changes changes, const CostModel::VariedKnob& knob, const CostModel::Option& option);

}  // namespace gloam
