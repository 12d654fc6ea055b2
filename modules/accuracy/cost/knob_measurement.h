// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "modules/accuracy/cost/comparison.h"
#include "modules/accuracy/cost/drawn_settings.h"
#include "modules/accuracy/cost/time_plan.h"
#include "modules/accuracy/cost/timing.h"
#include "modules/accuracy/cost/whole_frame.h"
#include "modules/accuracy/ledger/reference_cache.h"
#include "modules/accuracy/ledger/row_json.h"
#include "modules/accuracy/module.h"

namespace gloam {

/// Measures the values of one knob. Draws the reference when the first value needs it. The destructor restores the
/// knob.
class KnobMeasurement {
 public:
  /// All must outlive it. progress: gets the pictures.
  KnobMeasurement(const CostRequest& request, CostSubject& subject, CostProgress& progress, WholeFrame& whole,
                  DrawnSettings& settings, TimePlan& plan, const Knob& knob);
  ~KnobMeasurement();
  KnobMeasurement(const KnobMeasurement&) = delete;
  KnobMeasurement& operator=(const KnobMeasurement&) = delete;

  /// Everything that a row of this value depends on, in one line.
  [[nodiscard]] std::string identity(const std::string& value) const;
  struct Measured {
    TimedRow row;
    bool needs_times = false;
  };
  /// Errors, pictures and memory of a value. Rows that differ from the default's still need their times.
  [[nodiscard]] Result<Measured> measure(const std::string& value);
  /// Times rows beside the default, all together: 1 to kMostCandidates. The frames of the default go to one of them.
  [[nodiscard]] Status time(std::span<TimedRow* const> rows);
  /// Times the default against itself.
  [[nodiscard]] Result<std::vector<FrameCost>> time_default();
  /// Whether the user's own value of the knob is the default, so that frames of its default are the user's frames.
  [[nodiscard]] bool default_is_users() const { return users_ == default_; }

 private:
  struct Drawn {
    DrawnFrame frame;
    std::vector<LinearPicture> sequence;  ///< empty unless the request asks for one
  };
  /// Everything that a drawn frame depends on, in one line.
  [[nodiscard]] std::string frame_identity(const std::string& value) const;
  [[nodiscard]] Status set(const std::string& value);
  /// Frame 0 with the current knobs. fresh: it is the last frame drawn.
  [[nodiscard]] Result<Drawn> draw(bool fresh);
  [[nodiscard]] Result<Drawn> draw(const std::string& value);
  [[nodiscard]] Status judge(const std::string& value, LedgerRow& row);
  /// Whether the module has a reference that is pictures, not only a distance.
  [[nodiscard]] bool draws_reference() const { return reference_ && (reference_->draw || !reference_->distance); }
  /// Sets row.counted if the module's reference has a distance. The last frame is that of the row's value.
  [[nodiscard]] Status judge_distance(LedgerRow& row);
  /// Marks the row wrong if its picture must be that of the reference and is not. The row has its picture.
  void check_same_picture(const NoisyReference& reference, LedgerRow& row) const;
  /// Sets the row's errors and pictures by a reference and by the whole frame, and gives the pictures to progress_.
  [[nodiscard]] Status judge_by(const NoisyReference& reference, const FramePictures& frame, LedgerRow& row);
  [[nodiscard]] Status judge_whole(const FramePictures& frame, LedgerRow& row) const;
  /// Draws the reference that all values are compared with.
  [[nodiscard]] Status draw_common_reference();
  /// For a measure: draws the right picture, and reads the counters of the default value.
  [[nodiscard]] Status draw_standard();
  [[nodiscard]] Status judge_by_measure(const std::string& value, LedgerRow& row);
  [[nodiscard]] Status judge_by_exact(const Drawn& drawn, LedgerRow& row);
  [[nodiscard]] Status judge_by_module(const std::string& value, const Drawn& drawn, LedgerRow& row);
  /// Sets row.temporal from a reference of each frame of a sequence.
  [[nodiscard]] Status judge_motion(const std::string& value, LedgerRow& row);
  /// The frames of a sequence with a value; with `references`, the module's reference of each.
  [[nodiscard]] Result<std::vector<FramePictures>> draw_motion(const std::string& value, bool references);
  [[nodiscard]] Result<NoisyReference> module_reference(const ReferenceInfo& info, const std::string& value,
                                                        const FramePictures& frame);
  [[nodiscard]] Result<JudgedReference> compute(const ReferenceInfo& info, const FramePictures& frame);
  /// Sets row.effect_model if the module's reference judges its model.
  [[nodiscard]] Status judge_model(const FramePictures& frame, LedgerRow& row) const;
  /// Whether it is known why the knob changes nothing, and the row's picture is that of the default. Sets
  /// row.no_effect_reason of the default.
  [[nodiscard]] Result<bool> is_idle(LedgerRow& row);
  [[nodiscard]] Result<std::vector<AlternatingTimes>> time(const std::vector<std::string>& values);

  const CostRequest& request_;
  CostSubject& subject_;
  CostProgress& progress_;
  WholeFrame& whole_;
  DrawnSettings& settings_;
  TimePlan& plan_;
  const Knob& knob_;
  std::string users_;  ///< the knob's value before measuring
  std::string default_;
  std::optional<MeasureInfo> measure_;  ///< the module's measure; takes precedence over a reference
  FrameCounters standard_;              ///< counters of the default value, for the measure
  std::optional<ReferenceInfo>
      reference_;  ///< the module's reference; none: a frame with the knob's exact value, if it has one
  ReferenceCache cache_;
  std::optional<NoisyReference> common_reference_;  ///< the reference, if one serves all values
  std::optional<NoisyReference> model_reference_;   ///< by ReferenceInfo::draw_model; drawn with common_reference_
  std::vector<LinearPicture> exact_sequence_;
  std::vector<FramePictures> reference_sequence_;  ///< empty until judge_motion() needs it
};

}  // namespace gloam
