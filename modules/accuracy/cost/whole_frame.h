// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "modules/accuracy/cost/comparison.h"
#include "modules/accuracy/cost/drawn_settings.h"
#include "modules/accuracy/module.h"

namespace gloam {

/// The values of the whole-frame reference: each knob's exact value, or its default if it has none. Looks are left out,
/// and knobs whose values all draw one picture: they keep the user's value.
[[nodiscard]] std::vector<KnobOverride> exact_settings(const KnobRegistry& knobs);

/// The whole-frame reference of a ledger: drawn once, and kept in the folder of references.
class WholeFrame {
 public:
  /// All must outlive it. The knobs must have the user's values.
  WholeFrame(const CostRequest& request, CostSubject& subject, DrawnSettings& drawn);

  /// Draws it, or reads it from the folder, and lets the subject's memory settle after it, unless that is done already.
  /// The knobs must have the user's values, and have them afterwards.
  [[nodiscard]] Status prepare(CostProgress& progress);
  /// The errors of a frame. Only after prepare().
  [[nodiscard]] Result<WholeError> judge(const FramePictures& frame) const;
  [[nodiscard]] const NoisyReference& reference() const { return *reference_; }

 private:
  [[nodiscard]] Status draw_reference();

  const CostRequest& request_;
  CostSubject& subject_;
  DrawnSettings& drawn_;
  std::optional<NoisyReference> reference_;
};

}  // namespace gloam
