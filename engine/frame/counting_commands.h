// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/frame/forwarding_commands.h"

namespace gloam::frame {

/// Forwards every command to another CommandList and counts dispatches and draws.
class CountingCommands final : public ForwardingCommands {
 public:
  using ForwardingCommands::ForwardingCommands;

  [[nodiscard]] std::uint32_t dispatches() const { return dispatches_; }
  /// Each draw of an indirect call is counted.
  [[nodiscard]] std::uint32_t draws() const { return draws_; }
  void reset() { dispatches_ = draws_ = 0; }

  void draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex,
            std::uint32_t first_instance) override {
    ++draws_;
    ForwardingCommands::draw(vertices, instances, first_vertex, first_instance);
  }
  void draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                    std::int32_t vertex_offset, std::uint32_t first_instance) override {
    ++draws_;
    ForwardingCommands::draw_indexed(indices, instances, first_index, vertex_offset, first_instance);
  }
  void draw_indirect(gpu::BufferHandle buffer, std::uint64_t offset) override {
    ++draws_;
    ForwardingCommands::draw_indirect(buffer, offset);
  }
  void draw_indexed_indirect(gpu::BufferHandle buffer, std::uint64_t offset, std::uint32_t draw_count) override {
    draws_ += draw_count;
    ForwardingCommands::draw_indexed_indirect(buffer, offset, draw_count);
  }
  void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) override {
    ++dispatches_;
    ForwardingCommands::dispatch(x, y, z);
  }
  void dispatch_indirect(gpu::BufferHandle buffer, std::uint64_t offset) override {
    ++dispatches_;
    ForwardingCommands::dispatch_indirect(buffer, offset);
  }

 private:
  std::uint32_t dispatches_ = 0;
  std::uint32_t draws_ = 0;
};

}  // namespace gloam::frame
