// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "modules/accuracy/module.h"

namespace gloam {

/// The settled frame 0 of a subject with some values of its knobs.
struct DrawnFrame {
  FramePictures pictures;
  FrameCounters counters;
  std::string hash;  ///< of the pictures
};

/// What a run has found out about values of all knobs, so that nothing is drawn twice: many rows of a ledger are of the
/// user's settings, and many references are drawn with the same values. "Now" means the subject's current values.
class DrawnSettings {
 public:
  explicit DrawnSettings(CostSubject& subject) : subject_(subject) {}

  /// fresh: it is drawn in any case, and is the subject's last frame then.
  [[nodiscard]] Result<DrawnFrame> frame_now(bool fresh = false);
  /// CostSubject::gpu_bytes().
  [[nodiscard]] Result<std::uint64_t> gpu_bytes_now();
  /// CostSubject::no_effect_reason() in the settled frame.
  [[nodiscard]] Result<std::string> idle_reason_now(const Knob& knob);

 private:
  struct KeptFrame {
    std::string settings;
    DrawnFrame frame;
  };
  CostSubject& subject_;
  std::deque<KeptFrame> frames_;  ///< the last one used comes first
  std::map<std::string, std::uint64_t> gpu_bytes_;
  std::string settings_of_reasons_;
  std::map<std::string, std::string> reasons_;  ///< of each knob
};

}  // namespace gloam
