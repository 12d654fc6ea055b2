// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/gpu/device.h"

namespace gloam::gpu {

/// One recorded command: its name ("dispatch", "barrier", …), its text in full, and its numbers.
struct RecordedCommand {
  std::string name;
  std::string text;
};

/// A device without a GPU for tests: hands out handles, counts bytes and pipelines, keeps upload and readback memory as
/// plain bytes, and writes down every command. Frames complete at once. Barriers, bindings and copies are checked: an
/// object that is not alive, a copy out of range, or an image used in another state than its last barrier left it is a
/// fault; so is a write that no barrier orders against what other passes (outermost labels) do, a barrier that does not
/// wait for all earlier uses, and a use of an image whose shared memory another one took. Copies and fills between
/// buffers and images move bytes; drawing and dispatching do nothing.
class RecordingDevice : public Device {
 public:
  [[nodiscard]] virtual const std::vector<RecordedCommand>& commands() const = 0;
  [[nodiscard]] virtual const std::vector<std::string>& faults() const = 0;
  virtual void forget_commands() = 0;
  /// The next creation fails with this error, once.
  virtual void fail_next_creation(Error error) = 0;
};

[[nodiscard]] std::unique_ptr<RecordingDevice> make_recording_device();

}  // namespace gloam::gpu
