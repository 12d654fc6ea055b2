// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/whole_frame.h"

#include <utility>

#include "engine/core/assert.h"
#include "modules/accuracy/cost/frame_identity.h"
#include "modules/accuracy/cost/knob_overrides.h"
#include "modules/accuracy/ledger/reference_cache.h"

namespace gloam {

std::vector<KnobOverride> exact_settings(const KnobRegistry& knobs) {
  std::vector<KnobOverride> settings;
  for (const Knob& knob : knobs.knobs()) {
    if (knob.is_look || knob.same_picture) continue;
    settings.push_back({knob.name, knob.exact.empty() ? value_text(knob, knob.default_number) : knob.exact});
  }
  return settings;
}

WholeFrame::WholeFrame(const CostRequest& request, CostSubject& subject, DrawnSettings& drawn)
    : request_(request), subject_(subject), drawn_(drawn) {}

Status WholeFrame::prepare(CostProgress& progress) {
  if (reference_) return {};
  progress.phase(CostPhase::exact);
  GLOAM_TRY(draw_reference());
  progress.phase(CostPhase::start);
  return subject_.settle_memory();
}

Status WholeFrame::draw_reference() {
  KnobOverrides overrides(subject_.knobs());
  GLOAM_TRY(overrides.set(exact_settings(subject_.knobs())));
  const ReferenceCache cache(request_.folder + "/references");
  const std::string identity = "whole frame " + conditions_identity(request_) + knobs_identity(subject_.knobs());
  std::optional<JudgedReference> stored = cache.load(identity);
  if (!stored) {
    auto drawn = drawn_.frame_now();
    if (!drawn) return Error{drawn.error().kind, "the whole-frame reference: " + drawn.error().message};
    stored = JudgedReference{.pictures = std::move(drawn->pictures)};
    GLOAM_TRY(cache.save(identity, *stored));
  }
  const std::string hash = hash_of(stored->pictures);
  reference_.emplace(NoisyReference{PictureJudge(std::move(stored->pictures)), hash});
  return {};
}

Result<WholeError> WholeFrame::judge(const FramePictures& frame) const {
  GLOAM_ASSERT(reference_.has_value(), "the whole frame is drawn before frames are compared with it");
  LedgerRow errors;
  GLOAM_TRY(reference_->judge.judge(frame, errors));
  return WholeError{.flip = *errors.flip, .rmse = *errors.rmse, .psnr_db = *errors.psnr_db};
}

}  // namespace gloam
