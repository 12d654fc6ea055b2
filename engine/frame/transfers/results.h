// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <any>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/assert.h"
#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"

namespace gloam {

/// Identifies a result of one module for one view of one world.
struct ResultKey {
  std::string module;
  std::string name;
  std::uint64_t world = 0;
  std::uint32_t view = 0;
  auto operator<=>(const ResultKey&) const = default;
};

/// One result of one frame: bytes from the GPU, and the note that the CPU passed to FrameResults::keep.
struct FrameResult {
  std::uint64_t frame = 0;  ///< number of the device's frame
  std::vector<std::byte> bytes;
  std::any note;

  /// The bytes as a trivially copyable T; asserts if their number is not sizeof(T).
  template <class T>
  [[nodiscard]] T value() const {
    GLOAM_ASSERT(bytes.size() == sizeof(T), "a frame's result is read as what was kept");
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }
};

/// Small GPU results (counters, the farthest depth) that the CPU reads when their frame has finished, without waiting
/// for the GPU. One pass copies all results of a frame to mapped memory; each frame in flight has its own buffer. For
/// use on one thread.
class FrameResults {
 public:
  /// Results and memory that have not been renewed for this many frames are released.
  static constexpr std::uint64_t kFramesKept = 60;

  explicit FrameResults(gpu::Device& device) : device_(device) {}
  ~FrameResults();
  FrameResults(const FrameResults&) = delete;
  FrameResults& operator=(const FrameResults&) = delete;

  /// Call it after Device::begin_frame. Settles results: settled() then returns the results of frames that are at least
  /// Device::kFramesInFlight frames old. Newer results are not settled even if the GPU has finished them, because
  /// decisions based on settled results must not depend on timing.
  void begin_frame();
  /// Requests `size` bytes (> 0, a multiple of 4) of a buffer as they are at the end of the frame. `buffer`: the
  /// version that no later pass writes. At most one request per key and frame.
  void keep(ResultKey key, BufferRef buffer, std::uint64_t offset, std::uint64_t size, std::any note = {});
  /// Call it after all passes are declared. Adds the pass that copies the requested results, if there are any.
  [[nodiscard]] Status add_pass(FrameGraph& graph);
  /// Call it if the frame begun last is given up: it has no results.
  void give_up_frame();

  /// The newest settled result, or null. Valid until the next begin_frame, forget_world or forget_module.
  [[nodiscard]] const FrameResult* settled(const ResultKey& key) const;
  /// The result of the newest finished frame, settled or not; nullopt if there is none.
  [[nodiscard]] std::optional<FrameResult> newest(const ResultKey& key) const;
  void for_each_settled(std::uint64_t world, std::uint32_t view,
                        const std::function<void(const ResultKey&, const FrameResult&)>& function) const;
  /// The keys that the frame declared last has requested.
  [[nodiscard]] std::vector<ResultKey> kept_keys() const;

  void forget_world(std::uint64_t world);
  void forget_view(std::uint32_t view);
  void forget_module(std::string_view module);

 private:
  struct Request {
    ResultKey key;
    BufferRef source;
    std::uint64_t source_offset = 0;
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    std::any note;
  };
  struct Slot {
    gpu::BufferHandle buffer;
    std::uint64_t frame = 0;
    std::uint64_t last_used = 0;  ///< the last frame that requested a result in this slot
    std::uint64_t bytes = 0;
    bool recorded = false;
    std::vector<Request> requests;
  };
  [[nodiscard]] Status reserve(Slot& slot);
  [[nodiscard]] FrameResult read(const Slot& slot, const Request& request) const;
  void settle(Slot& slot);
  void erase_if(const std::function<bool(const ResultKey&)>& unwanted);

  gpu::Device& device_;
  std::array<Slot, gpu::Device::kFramesInFlight> slots_;
  std::size_t current_ = 0;
  std::map<ResultKey, FrameResult> settled_;
};

}  // namespace gloam
