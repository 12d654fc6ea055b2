// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"

namespace gloam {

/// Identifies one request of a Readback.
struct ReadbackTicket {
  std::uint64_t id = 0;
  [[nodiscard]] explicit operator bool() const { return id != 0; }
};

/// Copies results of a frame to the CPU: a pass of the graph copies them to mapped memory, and take() returns the bytes
/// once that frame has finished on the GPU. Must outlive the execution of the graphs that it added passes to.
class Readback {
 public:
  /// Memory is accounted to `module`.
  explicit Readback(gpu::Device& device, std::string module = "engine");
  ~Readback();
  Readback(const Readback&) = delete;
  Readback& operator=(const Readback&) = delete;

  /// Requests the texels of one mip of one layer, tightly packed, as they are after all passes declared so far.
  [[nodiscard]] Result<ReadbackTicket> read_image(FrameGraph& graph, ImageRef image, std::uint32_t mip = 0,
                                                  std::uint32_t layer = 0);
  /// Requests a range of a buffer as it is after all passes declared so far. offset, size: bytes. `size` 0: to the end
  /// of the buffer.
  [[nodiscard]] Result<ReadbackTicket> read_buffer(FrameGraph& graph, BufferRef buffer, std::uint64_t offset = 0,
                                                   std::uint64_t size = 0);
  /// Returns the bytes, once; nullopt if the frame has not finished, or if the bytes were already taken or dropped.
  [[nodiscard]] std::optional<std::vector<std::byte>> take(ReadbackTicket ticket);
  /// Cancels a request; its bytes are never returned.
  void drop(ReadbackTicket ticket);
  /// Requests that were neither taken nor dropped.
  [[nodiscard]] std::size_t open_requests() const;

 private:
  struct Request {
    std::uint64_t id = 0;
    gpu::BufferHandle buffer;
    std::uint64_t size = 0;
    std::uint64_t frame = 0;  ///< the frame that copies; until it is recorded, the frame of the request
    bool recorded = false;
    bool dropped = false;
  };
  [[nodiscard]] Result<Request*> make_request(std::uint64_t size);
  [[nodiscard]] BufferRef import_target(FrameGraph& graph, const Request& request);
  void recycle_finished();

  gpu::Device& device_;
  std::string module_;
  std::uint64_t last_id_ = 0;
  std::vector<std::unique_ptr<Request>> requests_;  ///< passes hold pointers to them
  std::vector<gpu::BufferHandle> free_buffers_;
};

}  // namespace gloam
