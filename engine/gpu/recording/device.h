// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/gpu/device.h"

namespace gloam::gpu {

/// One recorded command. name: "dispatch", "barrier", …; text: the name followed by all arguments.
struct RecordedCommand {
  std::string name;
  std::string text;
};

/// A device without a GPU, for tests. It hands out handles, counts bytes and pipelines, keeps upload and readback
/// memory as plain bytes, and records every command. Frames complete at once. Copies and fills between buffers and
/// images move bytes at once, also those of a frame that is abandoned later; draws and dispatches do nothing. These are
/// reported as faults:
/// - the use of an object that is not alive, or a copy out of range
/// - the use of an image for an access that its last barrier did not make it ready for
/// - the use of a resource that another pass (outermost label) wrote, without a barrier in between
/// - a barrier that does not wait for all earlier accesses
/// - the use of a resource whose memory has been taken over by another resource
/// - a barrier that takes memory over without waiting for its earlier users
class RecordingDevice : public Device {
 public:
  [[nodiscard]] virtual const std::vector<RecordedCommand>& commands() const = 0;
  [[nodiscard]] virtual const std::vector<std::string>& faults() const = 0;
  virtual void forget_commands() = 0;
  /// The number of pieces of memory allocated so far: for each buffer and image that is not placed in a memory block,
  /// for each group of aliased images, and for each block.
  [[nodiscard]] virtual std::uint64_t allocations() const = 0;
  /// Makes the next creation of an object fail with this error, once.
  virtual void fail_next_creation(Error error) = 0;
  /// Makes the device support this format no longer for any of these uses; `blit` also not for blits.
  virtual void withdraw_support(Format format, ImageUsage usage, bool blit = false) = 0;
};

[[nodiscard]] std::unique_ptr<RecordingDevice> make_recording_device();

}  // namespace gloam::gpu
