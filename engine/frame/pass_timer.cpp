// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/pass_timer.h"

#include <algorithm>

namespace gloam::frame {

namespace {
constexpr double kMsPerNs = 1e-6;
}

void PassTimer::begin_frame(std::uint64_t frame) {
  current_ = (current_ + 1) % records_.size();
  records_[current_].frame = frame;
  records_[current_].waits = true;
  records_[current_].passes.forget();
}

void PassTimer::add(const DeclaredPass& pass, std::uint32_t dispatches, std::uint32_t draws) {
  PassRecord& record = records_[current_].passes.add();
  record.name = pass.name;
  record.module = pass.module;
  record.dispatches = dispatches;
  record.draws = draws;
}

void PassTimer::refresh(gpu::Device& device) {
  const std::uint64_t completed = device.completed_frames();
  FrameRecord* newest = nullptr;
  for (FrameRecord& record : records_) {
    if (!record.waits || record.frame >= completed) continue;
    if (newest == nullptr || record.frame > newest->frame) newest = &record;
  }
  if (newest == nullptr) return;
  const std::vector<std::uint64_t> timestamps = device.timestamps(newest->frame);
  if (!timestamps.empty()) take(*newest, timestamps);
  const std::uint64_t frame = newest->frame;
  for (FrameRecord& record : records_) record.waits = record.waits && record.frame > frame;
}

void PassTimer::take(const FrameRecord& record, const std::vector<std::uint64_t>& timestamps) {
  times_.clear();
  std::uint64_t first = ~std::uint64_t{0};
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < record.passes.size(); ++i) {
    const PassRecord& pass = record.passes[i];
    PassTime& time = times_.emplace_back(PassTime{
        .name = pass.name, .module = pass.module, .ms = 0.0, .dispatches = pass.dispatches, .draws = pass.draws});
    if (i + 1 >= timestamps.size()) continue;
    const std::uint64_t begin = timestamps[i];
    const std::uint64_t end = timestamps[i + 1];
    if (begin == 0 || end < begin) continue;
    time.ms = static_cast<double>(end - begin) * kMsPerNs;
    first = std::min(first, begin);
    last = std::max(last, end);
  }
  gpu_ms_ = last > first ? static_cast<double>(last - first) * kMsPerNs : 0.0;
}

}  // namespace gloam::frame
