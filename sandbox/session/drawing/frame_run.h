// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Draws frames of one view and measures each, with up to `in_flight` frames unfinished at a time. With 1, each frame
/// is waited for before the next one begins. With 2, the CPU prepares a frame while the GPU draws the one before it.
class FrameRun {
 public:
  /// in_flight: 1 to gpu::Device::kFramesInFlight. `session` must outlive the run.
  FrameRun(Session& session, std::uint32_t in_flight);

  /// Draws the next frame. Returns when fewer than in_flight frames are unfinished.
  [[nodiscard]] Status draw(const ViewRequest& request);
  /// Waits for all frames and returns them in order.
  [[nodiscard]] Result<std::vector<FrameSample>> finish();

 private:
  [[nodiscard]] Status finish_oldest();
  /// Gives the GPU times that have arrived to their frames.
  /// The report of the frame drawn last.
  [[nodiscard]] FrameReport report_of_frame() const;
  void take_times();

  Session& session_;
  std::uint32_t in_flight_;
  std::vector<FrameSample> samples_;
  std::vector<std::uint64_t> numbers_;  ///< Device::frame_number of each sample
  std::size_t finished_ = 0;            ///< samples whose frame has ended
};

}  // namespace gloam
