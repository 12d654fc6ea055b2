// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/points/point_measurement.h"

#include <utility>

#include "engine/core/assert.h"
#include "modules/accuracy/cost/frame_identity.h"
#include "modules/accuracy/cost/knob_overrides.h"

namespace gloam {

std::vector<KnobValue> settings_with(const KnobRegistry& knobs, const Changes& changes) {
  std::vector<KnobValue> settings;
  for (const Knob& knob : knobs.knobs()) {
    const auto change = changes.find(knob.name);
    std::string value = change != changes.end() ? change->second : knobs.text(knob);
    if (reuses_last_frame(knob)) continue;
    if (value != value_text(knob, knob.default_number)) settings.push_back({knob.name, std::move(value)});
  }
  return settings;
}

PointMeasurement::PointMeasurement(const CostRequest& request, CostSubject& subject, CostProgress& progress,
                                   WholeFrame& whole, DrawnSettings& drawn, TimePlan& plan, Changes changes)
    : request_(request),
      subject_(subject),
      progress_(progress),
      whole_(whole),
      drawn_(drawn),
      plan_(plan),
      settings_(settings_with(subject.knobs(), changes)) {
  for (const auto& [name, value] : changes) {
    const Knob* knob = subject.knobs().find(name);
    GLOAM_ASSERT(knob != nullptr, "a combination is of existing knobs");
    users_.push_back({name, subject.knobs().text(*knob)});
    changes_.push_back({name, value});
  }
}

std::string PointMeasurement::identity() const {
  std::string text = "point " + conditions_identity(request_) + knobs_identity(subject_.knobs()) + " changed";
  for (const KnobOverride& change : changes_) text += " " + change.name + "=" + change.value;
  return joined_line(text + protocol_identity(request_));
}

Status PointMeasurement::set(TimedSide side) {
  KnobRegistry& knobs = subject_.knobs();
  for (const KnobOverride& knob : side == kStandardSide ? users_ : changes_)
    if (knobs.text(*knobs.find(knob.name)) != knob.value) GLOAM_TRY(knobs.set(knob.name, knob.value));
  return {};
}

Status PointMeasurement::judge(LedgerRow& row) {
  row.reference_kind = kWholeFrameKind;
  row.reference_name = kWholeFrameName;
  progress_.phase(CostPhase::pictures);
  const auto frame = drawn_.frame_now();
  if (!frame) return frame.error();
  GLOAM_TRY(compare(whole_.reference(), frame->pictures, progress_, row));
  row.whole = WholeError{.flip = *row.flip, .rmse = *row.rmse, .psnr_db = *row.psnr_db};
  return {};
}

Result<AlternatingTimes> PointMeasurement::time() {
  progress_.phase(CostPhase::timing);
  std::int32_t index = 0;  // time goes on, so that frames include the work of simulations
  const auto run = [&](TimedSide side) -> Result<FrameCost> {
    GLOAM_TRY(set(side));
    return subject_.draw(index++);
  };
  auto times = time_in_plan(request_.header, plan_, 1, run);
  if (!times) return times.error();
  return std::move(times->front());
}

Result<TimedRow> PointMeasurement::measure() {
  GLOAM_TRY(whole_.prepare(progress_));
  KnobOverrides overrides(subject_.knobs());  // restores the user's values
  GLOAM_TRY(overrides.set(changes_));
  TimedRow measured = {.row = {.value = settings_text(settings_), .is_default = changes_.empty()}};
  GLOAM_TRY(judge(measured.row));
  progress_.phase(CostPhase::memory);
  const auto bytes = drawn_.gpu_bytes_now();
  if (!bytes) return bytes.error();
  measured.row.gpu_bytes = *bytes;
  auto times = time();
  if (!times) return times.error();
  set_times(summarize_times(*times), measured.row);
  measured.row.pairs = static_cast<std::uint32_t>(times->candidate.size());
  measured.standard = std::move(times->standard);
  return measured;
}

}  // namespace gloam
