// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "engine/gpu/recording/objects.h"

namespace gloam::gpu::recording {

/// Follows barriers and uses and writes down faults, as a small synchronization validator:
/// an object is used only as its last barrier made it ready for; a barrier waits for all accesses since the one before
/// it and starts from the layout that one left; of images that share memory only the one whose barrier threw contents
/// away last is used; what one outermost label wrote, another label touches only behind a barrier.
/// Buffers that never had a barrier may be used freely until something writes them.
class Tracker {
 public:
  explicit Tracker(Objects& objects) : objects_(objects) {}

  void begin_frame(std::uint64_t frame) { frame_ = frame; }
  /// The device is idle: nothing is pending any more.
  void idle();
  void begin_label();
  /// False when no label is open.
  bool end_label();
  [[nodiscard]] bool label_open() const { return label_depth_ > 0; }

  void barrier(std::span<const BufferBarrier> buffers, std::span<const ImageBarrier> images);
  /// `possible`: the accesses this command may be; the object's state tells which it is.
  void use(BufferHandle handle, AccessMask possible, std::string_view command);
  void use(ImageHandle handle, AccessMask possible, std::string_view command);

 private:
  /// Those of the first one's buffer.
  void buffer_barriers(std::span<const BufferBarrier> barriers);
  void image_barrier(const ImageBarrier& barrier);
  void pass_barrier(SyncState& sync, AccessMask before, AccessMask after, const std::string& object);
  void note_use(SyncState& sync, AccessMask possible, const std::string& object, std::string_view command);

  Objects& objects_;
  std::uint64_t frame_ = 0;
  std::uint32_t label_ = 0;  ///< of the outermost label, 0 outside
  std::uint32_t labels_ = 0;
  std::uint32_t label_depth_ = 0;
};

/// "compute_read|uniform_read", or "nothing".
[[nodiscard]] std::string text_of(AccessMask mask);

}  // namespace gloam::gpu::recording
