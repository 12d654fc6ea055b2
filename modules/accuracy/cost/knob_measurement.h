// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modules/accuracy/cost/picture_error.h"
#include "modules/accuracy/ledger/reference_cache.h"
#include "modules/accuracy/module.h"

namespace gloam {

/// Measures the values of one knob. The reference is drawn when the first value needs it. Puts the knob back when it
/// ends.
class KnobMeasurement {
 public:
  KnobMeasurement(const CostRequest& request, CostSubject& subject, const Knob& knob);
  ~KnobMeasurement();
  KnobMeasurement(const KnobMeasurement&) = delete;
  KnobMeasurement& operator=(const KnobMeasurement&) = delete;

  /// All that a row of this value depends on, one line.
  [[nodiscard]] std::string identity(const std::string& value) const;
  [[nodiscard]] Result<LedgerRow> measure(const std::string& value);

 private:
  struct Drawn {
    FramePictures frame;
    std::vector<LinearPicture> sequence;  ///< empty unless the request asks for one
  };
  struct Held {
    PictureJudge judge;
    double noise = 0.0;
  };

  /// All that a drawn frame depends on, one line.
  [[nodiscard]] std::string frame_identity(const std::string& value) const;
  [[nodiscard]] Status set(const std::string& value);
  [[nodiscard]] Status settle();
  /// With the knobs as they are; leaves frame 0 as the last one drawn.
  [[nodiscard]] Result<Drawn> draw();
  [[nodiscard]] Result<Drawn> draw(const std::string& value);
  [[nodiscard]] Status judge(const std::string& value, LedgerRow& row);
  /// Draws the reference that all values are held against.
  [[nodiscard]] Status hold_reference();
  /// Draws what a measure holds all values against: the right picture, and what the default counts.
  [[nodiscard]] Status hold_standard();
  [[nodiscard]] Status judge_by_measure(const std::string& value, LedgerRow& row);
  [[nodiscard]] Status judge_by_exact(const Drawn& drawn, LedgerRow& row);
  [[nodiscard]] Status judge_by_module(const std::string& value, const Drawn& drawn, LedgerRow& row);
  [[nodiscard]] Result<Held> module_reference(const std::string& value, const FramePictures& frame);
  [[nodiscard]] Result<JudgedReference> compute(const FramePictures& frame);
  [[nodiscard]] Status time(const std::string& value, LedgerRow& row);

  const CostRequest& request_;
  CostSubject& subject_;
  const Knob& knob_;
  std::string users_;  ///< the knob's value before
  std::string default_;
  std::optional<MeasureInfo> measure_;      ///< of the module; goes before a reference
  FrameCounters standard_;                  ///< what the measure's default counts
  std::optional<ReferenceInfo> reference_;  ///< of the module; none: the exact value, if there is one
  ReferenceCache cache_;
  std::optional<Held> held_;  ///< of references that serve all values
  std::vector<LinearPicture> exact_sequence_;
};

}  // namespace gloam
