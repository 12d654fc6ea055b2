// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/pass_timer.h"

#include <algorithm>
#include <utility>

namespace gloam::frame {

namespace {
constexpr double kMsPerNs = 1e-6;
}

void PassTimer::begin_frame(std::uint64_t frame) {
  current_ = (current_ + 1) % records_.size();
  records_[current_].frame = frame;
  records_[current_].waits = true;
  records_[current_].passes.forget();
  stamps_ = 0;
}

void PassTimer::drop_frame(std::uint64_t frame) {
  FrameRecord& record = records_[current_];
  if (record.frame != frame || !record.waits) return;
  record.waits = false;
  current_ = (current_ + records_.size() - 1) % records_.size();
}

void PassTimer::begin_pass(gpu::CommandList& commands, bool stamp) {
  const bool fresh = stamp || stamps_ == 0;
  pass_begin_ = kNone;
  if (stamps_ + (fresh ? 2 : 1) > gpu::Device::kTimestampsPerFrame) {  // its end needs one, too
    stamps_ = gpu::Device::kTimestampsPerFrame;                        // no later pass is timed
    return;
  }
  if (fresh) commands.write_timestamp(stamps_++);
  pass_begin_ = stamps_ - 1;
}

void PassTimer::end_pass(gpu::CommandList& commands, const DeclaredPass& pass, std::uint32_t dispatches,
                         std::uint32_t draws) {
  PassRecord& record = records_[current_].passes.add();
  record.name = pass.name;
  record.module = pass.module;
  record.view = pass.view;
  record.begin = pass_begin_;
  record.end = kNone;
  record.dispatches = dispatches;
  record.draws = draws;
  if (pass_begin_ == kNone) return;
  record.end = stamps_++;
  commands.write_timestamp(record.end);
}

void PassTimer::refresh(gpu::Device& device) {
  const std::uint64_t completed = device.completed_frames();
  // The slot after the current one holds the oldest frame.
  for (std::size_t i = 1; i <= records_.size(); ++i) {
    FrameRecord& record = records_[(current_ + i) % records_.size()];
    if (!record.waits || record.frame >= completed) continue;
    record.waits = false;
    const std::vector<std::uint64_t> timestamps = device.timestamps(record.frame);
    if (timestamps.empty()) continue;  // too old, or given up
    newest_ = times_of(record, timestamps);
    if (finished_.size() == kFramesKept) finished_.erase(finished_.begin());
    finished_.push_back(newest_);
    if (!has_profiler_) continue;
    if (for_profiler_.size() == kFramesKept) for_profiler_.erase(for_profiler_.begin());
    for_profiler_.push_back(newest_);
  }
}

GpuFrameTimes PassTimer::times_of(const FrameRecord& record, const std::vector<std::uint64_t>& timestamps) {
  GpuFrameTimes times;
  times.frame = record.frame;
  std::uint64_t first = ~std::uint64_t{0};
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < record.passes.size(); ++i) {
    const PassRecord& pass = record.passes[i];
    PassTime& time = times.passes.emplace_back(PassTime{.name = pass.name,
                                                        .module = pass.module,
                                                        .dispatches = pass.dispatches,
                                                        .draws = pass.draws,
                                                        .view = pass.view});
    if (pass.end >= timestamps.size()) continue;  // kNone as well
    const std::uint64_t begin = timestamps[pass.begin];
    const std::uint64_t end = timestamps[pass.end];
    if (begin == 0 || end < begin) continue;
    time.begin_ns = begin;
    time.end_ns = end;
    time.ms = static_cast<double>(end - begin) * kMsPerNs;
    first = std::min(first, begin);
    last = std::max(last, end);
  }
  if (last > first) times.gpu_ms = static_cast<double>(last - first) * kMsPerNs;
  return times;
}

std::vector<GpuFrameTimes> PassTimer::take() { return std::exchange(finished_, {}); }

std::vector<GpuFrameTimes> PassTimer::take_for_profiler() {
  has_profiler_ = true;
  return std::exchange(for_profiler_, {});
}

}  // namespace gloam::frame
