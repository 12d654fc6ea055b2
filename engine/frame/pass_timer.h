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

/// Records which passes the frames in flight ran, and matches them with the device's timestamps. A pass ends with a
/// timestamp, and begins with one after its barriers. A pass without barriers begins where the pass before it has
/// ended: it needs no timestamp, and software devices wait for their threads at each one. On devices that run threads
/// in turn, every pass but the first begins where the last one has ended.
class PassTimer {
 public:
  static constexpr std::uint32_t kNone = ~0u;
  static constexpr std::size_t kFramesKept = 4;  ///< completed frames that take() returns

  void begin_frame(std::uint64_t frame);
  /// Forgets the frame, if it is the one begun last: the GPU does not execute it, and it has no times.
  void drop_frame(std::uint64_t frame);
  /// Writes the timestamp with which the next pass begins. Without `stamp`, it begins where the last one has ended.
  void begin_pass(gpu::CommandList& commands, bool stamp);
  /// Writes the timestamp with which the pass ends. Passes for which no timestamps are left are not timed.
  void end_pass(gpu::CommandList& commands, const DeclaredPass& pass, std::uint32_t dispatches, std::uint32_t draws);
  /// Reads the times of all completed frames that the device still has.
  void refresh(gpu::Device& device);
  /// Of the newest completed frame.
  [[nodiscard]] const GpuFrameTimes& newest() const { return newest_; }
  /// The completed frames since the last call, oldest first.
  [[nodiscard]] std::vector<GpuFrameTimes> take();
  /// The same for a second caller, from its first call on.
  [[nodiscard]] std::vector<GpuFrameTimes> take_for_profiler();

 private:
  struct PassRecord {
    std::string name;
    std::string module;
    std::uint32_t view = 0;
    std::uint32_t begin = kNone;  ///< index of its timestamp; kNone: not timed
    std::uint32_t end = kNone;
    std::uint32_t dispatches = 0;
    std::uint32_t draws = 0;
  };
  struct FrameRecord {
    std::uint64_t frame = 0;
    bool waits = false;  ///< its times have not been read yet
    SlotVector<PassRecord> passes;
  };
  [[nodiscard]] static GpuFrameTimes times_of(const FrameRecord& record, const std::vector<std::uint64_t>& timestamps);

  std::array<FrameRecord, gpu::Device::kFramesInFlight + 2> records_;
  std::size_t current_ = 0;
  std::uint32_t stamps_ = 0;          ///< timestamps written in the current frame
  std::uint32_t pass_begin_ = kNone;  ///< timestamp with which the current pass begins
  GpuFrameTimes newest_;
  std::vector<GpuFrameTimes> finished_;  ///< not taken yet, oldest first
  std::vector<GpuFrameTimes> for_profiler_;
  bool has_profiler_ = false;
};

}  // namespace gloam::frame
