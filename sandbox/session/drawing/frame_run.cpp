// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/drawing/frame_run.h"

#include <algorithm>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {

FrameRun::FrameRun(Session& session, std::uint32_t in_flight) : session_(session), in_flight_(in_flight) {
  GLOAM_ASSERT(in_flight >= 1 && in_flight <= gpu::Device::kFramesInFlight,
               "a run keeps 1 to Device::kFramesInFlight frames in flight");
  static_cast<void>(session_.renderer->take_times());  // of earlier frames
}

Status FrameRun::draw(const ViewRequest& request) {
  FrameSample sample;
  sample.begin_ns = session_.zones.now_ns();
  GLOAM_TRY(session_.renderer->render(session_.world, {&request, 1}));
  numbers_.push_back(session_.device->frame_number() - 1);
  sample.zones = session_.zones.take();
  samples_.push_back(std::move(sample));
  // The CPU times of this frame. Its GPU times follow, and the last frame of all is reported on when it has ended.
  if (in_flight_ > 1) samples_.back().report = report_of_frame();
  return samples_.size() - finished_ < in_flight_ ? Status() : finish_oldest();
}

Status FrameRun::finish_oldest() {
  FrameSample& sample = samples_[finished_];
  const bool newest = finished_ + 1 == samples_.size();
  GLOAM_TRY(newest ? session_.renderer->wait() : session_.device->wait_frame(numbers_[finished_]));
  sample.end_ns = session_.zones.now_ns();
  if (finished_ > 0) sample.previous_end_ns = samples_[finished_ - 1].end_ns;
  if (newest) sample.report = report_of_frame();
  ++finished_;
  take_times();
  return {};
}

FrameReport FrameRun::report_of_frame() const {
  FrameReport report = session_.renderer->report();
  if (report.kept) {  // its GPU figures are of an earlier frame
    report.gpu_ms = 0.0;
    report.passes.clear();
  }
  return report;
}

void FrameRun::take_times() {
  for (GpuFrameTimes& times : session_.renderer->take_times()) {
    const auto found = std::ranges::find(numbers_, times.frame);
    if (found == numbers_.end()) continue;
    FrameReport& report = samples_[static_cast<std::size_t>(found - numbers_.begin())].report;
    report.gpu_ms = times.gpu_ms;
    report.passes = std::move(times.passes);
  }
}

Result<std::vector<FrameSample>> FrameRun::finish() {
  while (finished_ < samples_.size()) GLOAM_TRY(finish_oldest());
  numbers_.clear();
  finished_ = 0;
  return std::exchange(samples_, {});
}

}  // namespace gloam
