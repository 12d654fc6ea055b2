// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/default_times.h"

#include <optional>

#include "modules/accuracy/cost/timing.h"

namespace gloam {
namespace {

/// Times and memory of the rows of knobs that have their default in common.
void share(const std::vector<KnobRows*>& knobs) {
  std::vector<FrameCost> frames;
  std::optional<std::uint64_t> bytes;
  for (const KnobRows* knob : knobs)
    for (const TimedRow& measured : knob->rows) {
      frames.insert(frames.end(), measured.standard.begin(), measured.standard.end());
      if (measured.row.is_default && !bytes) bytes = measured.row.gpu_bytes;
    }
  if (frames.empty()) return;
  for (KnobRows* knob : knobs) {
    const TimedValue standard = summarize_frames(frames, knob->module);
    for (TimedRow& measured : knob->rows) {
      LedgerRow& row = measured.row;
      if (row.is_default) {
        set_times(standard, row);
        row.pairs = static_cast<std::uint32_t>(frames.size());
        row.gpu_bytes = *bytes;
      } else if (row.pairs == 0) {  // it changes nothing, and was not timed
        set_times(standard, row);
      } else if (row.ms.median_ms > 0.0) {
        const double scale = row.ratio * standard.ms.median_ms / row.ms.median_ms;
        row.ms = {row.ms.median_ms * scale, row.ms.p10_ms * scale, row.ms.p90_ms * scale};
      }
    }
  }
}

}  // namespace

void share_default_times(std::vector<KnobRows>& knobs) {
  std::vector<KnobRows*> common;
  for (KnobRows& knob : knobs) {
    if (knob.default_is_users)
      common.push_back(&knob);
    else
      share({&knob});
  }
  share(common);
}

}  // namespace gloam
