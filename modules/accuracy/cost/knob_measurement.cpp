// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/knob_measurement.h"

#include <algorithm>
#include <span>
#include <utility>

#include "engine/core/assert.h"
#include "engine/math/srgb.h"
#include "modules/accuracy/cost/frame_identity.h"
#include "modules/accuracy/cost/knob_overrides.h"
#include "modules/accuracy/cost/settled_frame.h"

namespace gloam {
namespace {

/// The light of pictures before they were encoded, 0…1.
LinearPicture displayed_light(const Picture& picture) {
  LinearPicture light{picture.width, picture.height, {}};
  light.rgba.reserve(picture.rgba.size());
  for (const std::uint8_t code : picture.rgba) light.rgba.push_back(srgb_to_linear(static_cast<float>(code) / 255.0f));
  return light;
}

std::vector<LinearPicture> light_of(const std::vector<FramePictures>& frames, bool displayed) {
  std::vector<LinearPicture> light;
  for (const FramePictures& frame : frames) light.push_back(displayed ? displayed_light(frame.picture) : frame.linear);
  return light;
}

}  // namespace

KnobMeasurement::KnobMeasurement(const CostRequest& request, CostSubject& subject, CostProgress& progress,
                                 WholeFrame& whole, DrawnSettings& settings, TimePlan& plan, const Knob& knob)
    : request_(request),
      subject_(subject),
      progress_(progress),
      whole_(whole),
      settings_(settings),
      plan_(plan),
      knob_(knob),
      users_(subject.knobs().text(knob)),
      default_(value_text(knob, knob.default_number)),
      cache_(request.folder + "/references") {
  for (ReferenceInfo& reference : subject.references()) {
    if (reference.knob == knob.name) reference_ = std::move(reference);
  }
  for (MeasureInfo& measure : subject.measures()) {
    if (measure.knob == knob.name) measure_ = std::move(measure);
  }
}

KnobMeasurement::~KnobMeasurement() {
  const Status restored = set(users_);
  GLOAM_ASSERT(restored.ok(), "a knob's own value can be set");
}

Status KnobMeasurement::set(const std::string& value) {
  // A set counts as a change for observers of the knobs, even with the same value.
  if (subject_.knobs().text(knob_) == value) return {};
  return subject_.knobs().set(knob_.name, value);
}

std::string KnobMeasurement::frame_identity(const std::string& value) const {
  return conditions_identity(request_) + knobs_identity(subject_.knobs(), knob_.name) + " measured " + knob_.name +
         "=" + value;
}

std::string KnobMeasurement::identity(const std::string& value) const {
  return frame_identity(value) + protocol_identity(request_);
}

Result<KnobMeasurement::Measured> KnobMeasurement::measure(const std::string& value) {
  TimedRow measured = {.row = {.knob = knob_.name, .value = value, .is_default = value == default_}};
  LedgerRow& row = measured.row;
  {
    KnobOverrides users(subject_.knobs());
    GLOAM_TRY(users.set(std::vector<KnobOverride>{{knob_.name, users_}}));
    GLOAM_TRY(whole_.prepare(progress_));
  }
  GLOAM_TRY(judge(value, row));
  progress_.phase(CostPhase::memory);
  GLOAM_TRY(set(value));
  const auto bytes = settings_.gpu_bytes_now();
  if (!bytes) return bytes.error();
  row.gpu_bytes = *bytes;
  const auto idle = is_idle(row);
  if (!idle) return idle.error();
  return Measured{std::move(measured), !row.is_default && !*idle};
}

Result<bool> KnobMeasurement::is_idle(LedgerRow& row) {
  progress_.phase(CostPhase::pictures);
  GLOAM_TRY(set(default_));
  auto reason = settings_.idle_reason_now(knob_);
  if (!reason) return reason.error();
  if (row.is_default) row.no_effect_reason = *reason;
  if (reason->empty() || !row.wrong.empty()) return false;
  const auto standard = settings_.frame_now();
  if (!standard) return standard.error();
  return row.picture == standard->hash;
}

Status KnobMeasurement::time(std::span<TimedRow* const> rows) {
  std::vector<std::string> values;
  for (const TimedRow* row : rows) values.push_back(row->row.value);
  auto times = time(values);
  if (!times) return times.error();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    set_times(summarize_times((*times)[i], knob_.module), rows[i]->row);
    rows[i]->row.pairs = static_cast<std::uint32_t>((*times)[i].candidate.size());
  }
  const auto frames = [](const AlternatingTimes& own) { return own.standard.size(); };
  rows.front()->standard = std::move(std::ranges::max_element(*times, {}, frames)->standard);
  return {};
}

Result<KnobMeasurement::Drawn> KnobMeasurement::draw(const std::string& value) {
  progress_.phase(CostPhase::pictures);
  GLOAM_TRY(set(value));
  // Distances and references that follow the value are computed from the last frame.
  return draw(reference_ && (reference_->distance || reference_->follows_value));
}

Result<KnobMeasurement::Drawn> KnobMeasurement::draw(bool fresh) {
  Drawn drawn;
  if (request_.sequence >= 2) {
    GLOAM_TRY(settle(subject_));
    for (std::uint32_t index = 0; index < request_.sequence; ++index) {
      GLOAM_TRY(subject_.draw(static_cast<std::int32_t>(index)));
      auto frame = subject_.read();
      if (!frame) return frame.error();
      drawn.sequence.push_back(std::move(frame->linear));
    }
  }
  auto frame = settings_.frame_now(fresh);
  if (!frame) return frame.error();
  drawn.frame = std::move(frame).value();
  return drawn;
}

Status KnobMeasurement::judge(const std::string& value, LedgerRow& row) {
  if (measure_) return judge_by_measure(value, row);
  if (!draws_reference() && knob_.exact.empty()) {
    row.no_reference = knob_.taste;
    const auto drawn = draw(value);
    if (!drawn) return drawn.error();
    row.picture = drawn->frame.hash;
    GLOAM_TRY(judge_whole(drawn->frame.pictures, row));
    GLOAM_TRY(progress_.picture(row.picture, drawn->frame.pictures.picture));
    return judge_distance(row);
  }
  const bool serves_all = !draws_reference() || !reference_->follows_value;
  if (serves_all && !common_reference_) GLOAM_TRY(draw_common_reference());
  const auto drawn = draw(value);
  if (!drawn) return drawn.error();
  GLOAM_TRY(judge_distance(row));
  return draws_reference() ? judge_by_module(value, *drawn, row) : judge_by_exact(*drawn, row);
}

Status KnobMeasurement::judge_distance(LedgerRow& row) {
  if (!reference_ || !reference_->distance) return {};
  row.reference_kind = reference_->kind;
  row.reference_name = reference_->name;
  progress_.phase(CostPhase::references);
  const auto distance = subject_.measure_distance(*reference_, request_.header.samples);
  if (!distance) return distance.error();
  if (*distance) row.counted = CountedError{(*distance)->mean, reference_->unit, (*distance)->p99};
  return {};
}

void KnobMeasurement::check_same_picture(const NoisyReference& reference, LedgerRow& row) const {
  if (!knob_.same_picture || !row.wrong.empty() || row.picture == reference.hash) return;
  row.wrong = "its picture is not equal to the bit to that of " + row.reference_name;
}

Status KnobMeasurement::judge_whole(const FramePictures& frame, LedgerRow& row) const {
  if (knob_.is_look) return {};
  const auto errors = whole_.judge(frame);
  if (!errors) return errors.error();
  row.whole = *errors;
  return {};
}

Status KnobMeasurement::judge_model(const FramePictures& frame, LedgerRow& row) const {
  if (!model_reference_) return {};
  LedgerRow errors;
  GLOAM_TRY(model_reference_->judge.judge(frame, errors));
  row.effect_model = EffectModelError{.name = reference_->model_name,
                                      .flip = errors.flip.value_or(ErrorPair{}),
                                      .rmse = errors.rmse.value_or(0.0),
                                      .noise = model_reference_->noise};
  return {};
}

Status KnobMeasurement::judge_by(const NoisyReference& reference, const FramePictures& frame, LedgerRow& row) {
  GLOAM_TRY(compare(reference, frame, progress_, row));
  return judge_whole(frame, row);
}

Status KnobMeasurement::draw_common_reference() {
  progress_.phase(CostPhase::exact);
  GLOAM_TRY(set(draws_reference() ? default_ : knob_.exact));
  KnobOverrides overrides(subject_.knobs());
  if (draws_reference()) GLOAM_TRY(overrides.set(reference_->drawn_with));
  auto drawn = draw(draws_reference());
  if (!drawn) return drawn.error();
  if (!draws_reference()) {
    exact_sequence_ = std::move(drawn->sequence);
    common_reference_.emplace(NoisyReference{PictureJudge(std::move(drawn->frame.pictures)), drawn->frame.hash});
    return {};
  }
  auto reference = module_reference(*reference_, default_, drawn->frame.pictures);
  if (!reference) return reference.error();
  common_reference_.emplace(std::move(reference).value());
  if (!reference_->draw_model) return {};
  ReferenceInfo model = *reference_;
  model.name = model.model_name;
  model.draw = model.draw_model;
  model.samples = true;
  auto exact = module_reference(model, default_, drawn->frame.pictures);
  if (!exact) return exact.error();
  model_reference_.emplace(std::move(exact).value());
  return {};
}

Status KnobMeasurement::draw_standard() {
  progress_.phase(CostPhase::exact);
  GLOAM_TRY(set(default_));
  {
    KnobOverrides overrides(subject_.knobs());
    GLOAM_TRY(overrides.set(measure_->picture));
    auto right = draw(false);
    if (!right) return right.error();
    exact_sequence_ = std::move(right->sequence);
    common_reference_.emplace(NoisyReference{PictureJudge(std::move(right->frame.pictures)), right->frame.hash});
  }
  KnobOverrides overrides(subject_.knobs());
  GLOAM_TRY(overrides.set(measure_->judged_with));
  auto standard = settings_.frame_now();
  if (!standard) return standard.error();
  standard_ = std::move(standard->counters);
  return {};
}

Status KnobMeasurement::judge_by_measure(const std::string& value, LedgerRow& row) {
  row.reference_kind = measure_->kind;
  row.reference_name = measure_->name;
  if (!common_reference_) GLOAM_TRY(draw_standard());
  progress_.phase(CostPhase::pictures);
  GLOAM_TRY(set(value));
  KnobOverrides overrides(subject_.knobs());
  GLOAM_TRY(overrides.set(measure_->judged_with));
  const auto drawn = draw(false);
  if (!drawn) return drawn.error();
  const FrameCounters& counters = drawn->frame.counters;
  if (const auto error = measure_->error(counters, standard_)) row.counted = CountedError{*error, measure_->unit};
  row.wrong = measure_->fault(counters);
  GLOAM_TRY(judge_by(*common_reference_, drawn->frame.pictures, row));
  check_same_picture(*common_reference_, row);
  return request_.sequence < 2 ? Status() : judge_sequence(exact_sequence_, drawn->sequence, row);
}

Status KnobMeasurement::judge_by_exact(const Drawn& drawn, LedgerRow& row) {
  const std::string exact = knob_.name + "=" + knob_.exact;
  row.reference_name = row.reference_name.empty() ? exact : row.reference_name + "; pictures against " + exact;
  if (row.reference_kind.empty()) row.reference_kind = "brute force";
  GLOAM_TRY(judge_by(*common_reference_, drawn.frame.pictures, row));
  check_same_picture(*common_reference_, row);
  return request_.sequence < 2 ? Status() : judge_sequence(exact_sequence_, drawn.sequence, row);
}

Status KnobMeasurement::judge_by_module(const std::string& value, const Drawn& drawn, LedgerRow& row) {
  row.reference_kind = reference_->kind;
  row.reference_name = reference_->name;
  std::optional<NoisyReference> own;
  if (reference_->follows_value) {
    auto reference = module_reference(*reference_, value, drawn.frame.pictures);
    if (!reference) return reference.error();
    own.emplace(std::move(reference).value());
  }
  const NoisyReference& reference = own ? *own : *common_reference_;
  GLOAM_TRY(judge_by(reference, drawn.frame.pictures, row));
  row.reference_noise = reference.noise;
  const double error = row.flip ? row.flip->mean : *row.rmse;
  row.below_noise = reference.noise > 0.0 && error < reference.noise;
  GLOAM_TRY(judge_model(drawn.frame.pictures, row));
  const bool moves = request_.sequence >= 2 && reference_->kind == "accumulated" && !reference_->follows_value;
  return moves ? judge_motion(value, row) : Status();
}

Status KnobMeasurement::judge_motion(const std::string& value, LedgerRow& row) {
  if (reference_sequence_.empty()) {
    progress_.phase(CostPhase::references);
    auto references = draw_motion(default_, true);
    if (!references) return references.error();
    reference_sequence_ = std::move(references).value();
  }
  progress_.phase(CostPhase::pictures);
  const auto frames = draw_motion(value, false);
  if (!frames) return frames.error();
  const bool displayed = reference_sequence_.front().linear.width == 0;
  return judge_sequence(light_of(reference_sequence_, displayed), light_of(*frames, displayed), row);
}

Result<std::vector<FramePictures>> KnobMeasurement::draw_motion(const std::string& value, bool references) {
  GLOAM_TRY(set(value));
  GLOAM_TRY(settle(subject_));
  std::vector<FramePictures> frames;
  for (std::uint32_t index = 0; index < request_.sequence; ++index) {
    GLOAM_TRY(subject_.draw(static_cast<std::int32_t>(index)));
    auto frame = subject_.read();
    if (frame && references) frame = subject_.draw_reference(*reference_, *frame, request_.header.samples);
    if (!frame) return frame.error();
    frames.push_back(std::move(frame).value());
  }
  return frames;
}

Result<NoisyReference> KnobMeasurement::module_reference(const ReferenceInfo& info, const std::string& value,
                                                         const FramePictures& frame) {
  const std::string identity =
      joined_line(info.kind + " " + info.name + " of " + hash_of(frame) + " " + frame_identity(value));
  std::optional<JudgedReference> reference = cache_.load(identity);
  if (!reference) {
    progress_.phase(CostPhase::references);
    auto computed = compute(info, frame);
    if (!computed) return computed.error();
    reference = std::move(computed).value();
    GLOAM_TRY(cache_.save(identity, *reference));
  }
  const double noise = reference->noise;
  const std::string hash = hash_of(reference->pictures);
  return NoisyReference{PictureJudge(std::move(reference->pictures)), hash, noise};
}

Result<JudgedReference> KnobMeasurement::compute(const ReferenceInfo& info, const FramePictures& frame) {
  const std::uint32_t samples = std::max(request_.header.samples, 2u);
  auto full = subject_.draw_reference(info, frame, samples);
  if (!full) return full.error();
  JudgedReference reference = {.pictures = std::move(full).value()};
  if (!info.samples) return reference;
  auto half = subject_.draw_reference(info, frame, samples / 2);
  if (!half) return half.error();
  LedgerRow change;
  GLOAM_TRY(PictureJudge(reference.pictures).judge(*half, change));
  reference.noise = change.flip ? change.flip->mean : *change.rmse;
  return reference;
}

Result<std::vector<AlternatingTimes>> KnobMeasurement::time(const std::vector<std::string>& values) {
  progress_.phase(CostPhase::timing);
  std::int32_t index = 0;  // time goes on, so that frames include the work of simulations
  const auto run = [&](TimedSide side) -> Result<FrameCost> {
    GLOAM_TRY(set(side == kStandardSide ? default_ : values[side - 1]));
    return subject_.draw(index++);
  };
  return time_in_plan(request_.header, plan_, values.size(), run);
}

Result<std::vector<FrameCost>> KnobMeasurement::time_default() {
  auto times = time(std::vector<std::string>{default_});
  if (!times) return times.error();
  return std::move(times->front().standard);
}

}  // namespace gloam
