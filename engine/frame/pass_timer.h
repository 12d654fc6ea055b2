// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/frame/declaration.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"

namespace gloam::frame {

/// Records which passes the frames in flight ran, and matches them with the device's timestamps. Pass i of a frame
/// begins at timestamp i, where pass i - 1 has ended, and ends at timestamp i + 1. Adjacent passes share one timestamp,
/// because software devices wait for their threads at each one.
class PassTimer {
 public:
  static constexpr std::uint32_t kPassesTimed = gpu::Device::kTimestampsPerFrame - 1;

  void begin_frame(std::uint64_t frame);
  void add(const DeclaredPass& pass, std::uint32_t dispatches, std::uint32_t draws);
  /// Reads the times of the newest completed frame, if the device still has them.
  void refresh(gpu::Device& device);
  [[nodiscard]] const std::vector<PassTime>& times() const { return times_; }
  [[nodiscard]] double gpu_ms() const { return gpu_ms_; }

 private:
  struct PassRecord {
    std::string name;
    std::string module;
    std::uint32_t dispatches = 0;
    std::uint32_t draws = 0;
  };
  struct FrameRecord {
    std::uint64_t frame = 0;
    bool waits = false;  ///< its times have not been read yet
    SlotVector<PassRecord> passes;
  };
  void take(const FrameRecord& record, const std::vector<std::uint64_t>& timestamps);

  std::array<FrameRecord, gpu::Device::kFramesInFlight + 2> records_;
  std::size_t current_ = 0;
  std::vector<PassTime> times_;
  double gpu_ms_ = 0.0;
};

}  // namespace gloam::frame
