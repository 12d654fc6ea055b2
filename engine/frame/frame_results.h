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

/// Names a result: what a module found out about one view of one world.
struct ResultKey {
  std::string module;
  std::string name;
  std::uint64_t world = 0;
  std::uint32_t view = 0;
  auto operator<=>(const ResultKey&) const = default;
};

/// What one frame left: bytes from the GPU, and what the CPU noted beside them when it declared the frame.
struct FrameResult {
  std::uint64_t frame = 0;  ///< of the device
  std::vector<std::byte> bytes;
  std::any note;

  /// The bytes as a plain struct of exactly their size.
  template <class T>
  [[nodiscard]] T value() const {
    GLOAM_ASSERT(bytes.size() == sizeof(T), "a frame's result is read as what was kept");
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }
};

/// Small results of frames (counters, the farthest depth) that the CPU looks at when their frame has ended, without
/// waiting for the GPU: one pass copies all of a frame's results to mapped memory, of which there is a piece a frame in
/// flight. One thread.
class FrameResults {
 public:
  /// Results and memory that nobody renews for so many frames are given back.
  static constexpr std::uint64_t kFramesKept = 60;

  explicit FrameResults(gpu::Device& device) : device_(device) {}
  ~FrameResults();
  FrameResults(const FrameResults&) = delete;
  FrameResults& operator=(const FrameResults&) = delete;

  /// After Device::begin_frame: settles the results of frames that are Device::kFramesInFlight or more ago. Always of
  /// those and never of later ones, however fast the GPU was: what systems make of a result does not depend on time.
  void begin_frame();
  /// Asks for `size` bytes (a multiple of 4) of a buffer as the frame leaves it. `buffer` is the version no later pass
  /// writes; one request a key and frame.
  void keep(ResultKey key, BufferRef buffer, std::uint64_t offset, std::uint64_t size, std::any note = {});
  /// When all passes are declared: adds the pass that copies, if anything is to be kept.
  [[nodiscard]] Status add_pass(FrameGraph& graph);

  /// The newest settled result; null when there is none.
  [[nodiscard]] const FrameResult* settled(const ResultKey& key) const;
  /// The result of the newest frame that has ended, settled or not.
  [[nodiscard]] std::optional<FrameResult> newest(const ResultKey& key) const;
  void for_each_settled(std::uint64_t world, std::uint32_t view,
                        const std::function<void(const ResultKey&, const FrameResult&)>& function) const;
  /// Keys of the frame that was declared last.
  [[nodiscard]] std::vector<ResultKey> kept_keys() const;

  void forget_world(std::uint64_t world);
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
    std::uint64_t last_used = 0;  ///< the last frame that kept anything here
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
