// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gpu/recording/objects.h"

namespace gloam::gpu::recording {

/// Tracks barriers and uses and reports faults, like a small synchronization validator:
/// - An object may be used only for accesses that its last barrier made it ready for.
/// - A barrier must wait for all accesses since the previous barrier and start from the layout that the previous
///   barrier left.
/// - Of the images that share memory, only the one whose barrier last discarded the contents may be used.
/// - After one outermost label has written a resource, another label may use it only after a barrier.
/// A buffer that never had a barrier may be used freely until a command writes it.
class Tracker {
 public:
  explicit Tracker(Objects& objects) : objects_(objects) {}

  void begin_frame(std::uint64_t frame) {
    frame_ = frame;
    changes_.clear();
  }
  /// Gives all objects the states that they had when the frame began.
  void abandon_frame();
  /// Clears all pending accesses: the device is idle.
  void idle();
  void begin_label();
  /// Returns false if no label is open.
  bool end_label();
  [[nodiscard]] bool label_open() const { return label_depth_ > 0; }

  void barrier(std::span<const BufferBarrier> buffers, std::span<const ImageBarrier> images);
  /// `possible`: the accesses that the command may make; the object's state decides which of them it makes.
  void use(BufferHandle handle, AccessMask possible, std::string_view command);
  void use(ImageHandle handle, AccessMask possible, std::string_view command);

 private:
  /// Applies all barriers in `barriers` that concern the buffer of the first one.
  void buffer_barriers(std::span<const BufferBarrier> barriers);
  void image_barrier(const ImageBarrier& barrier);
  void pass_barrier(SyncState& sync, AccessMask before, AccessMask after, const std::string& object);
  void note_use(SyncState& sync, AccessMask possible, const std::string& object, std::string_view command);

  /// A state before one change. Objects and their memory never move.
  struct Change {
    SyncState* sync = nullptr;
    SyncState before;
    ImageMemory* memory = nullptr;  ///< null: of a buffer
    std::uint32_t owner = ImageMemory::kNobody;
  };
  void remember(SyncState& sync) { changes_.push_back({.sync = &sync, .before = sync}); }

  Objects& objects_;
  std::uint64_t frame_ = 0;
  std::vector<Change> changes_;  ///< of this frame, in order
  std::uint32_t label_ = 0;      ///< number of the outermost open label; 0: none
  std::uint32_t labels_ = 0;
  std::uint32_t label_depth_ = 0;
};

/// The names of the accesses, such as "uniform_read|compute_read"; "nothing" if the mask is empty.
[[nodiscard]] std::string text_of(AccessMask mask);

}  // namespace gloam::gpu::recording
