// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/drawn_settings.h"

#include <algorithm>
#include <utility>

#include "modules/accuracy/cost/frame_identity.h"
#include "modules/accuracy/cost/settled_frame.h"

namespace gloam {
namespace {

/// Of the user's settings, of a knob's exact value, and of the frames that a measure compares. A frame has 18 MB at
/// 1280×720.
constexpr std::size_t kMostFrames = 4;

}  // namespace

Result<DrawnFrame> DrawnSettings::frame_now(bool fresh) {
  const std::string settings = knobs_identity(subject_.knobs());
  const auto kept = std::ranges::find(frames_, settings, &KeptFrame::settings);
  if (kept != frames_.end()) {
    std::rotate(frames_.begin(), kept, kept + 1);
    if (!fresh) return frames_.front().frame;
    frames_.pop_front();
  }
  auto pictures = draw_settled(subject_);
  if (!pictures) return pictures.error();
  const std::string hash = hash_of(*pictures);
  frames_.push_front({settings, {std::move(pictures).value(), subject_.counters(), hash}});
  if (frames_.size() > kMostFrames) frames_.pop_back();
  return frames_.front().frame;
}

Result<std::uint64_t> DrawnSettings::gpu_bytes_now() {
  const std::string settings = knobs_identity(subject_.knobs());
  if (const auto known = gpu_bytes_.find(settings); known != gpu_bytes_.end()) return known->second;
  const auto bytes = subject_.gpu_bytes();
  if (bytes) gpu_bytes_.emplace(settings, *bytes);
  return bytes;
}

Result<std::string> DrawnSettings::idle_reason_now(const Knob& knob) {
  const std::string settings = knobs_identity(subject_.knobs());
  if (settings != settings_of_reasons_) {
    GLOAM_TRY(settle(subject_));
    settings_of_reasons_ = settings;
    for (const Knob& any : subject_.knobs().knobs()) reasons_[any.name] = subject_.no_effect_reason(any);
  }
  return reasons_[knob.name];
}

}  // namespace gloam
