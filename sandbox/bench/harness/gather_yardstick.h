// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"

namespace gloam {

/// The gather pass: one full-screen pass of 48 gathers per pixel from a 1024² depth map. Frame times are compared with
/// it, so that a bar holds on any machine.
class GatherYardstick {
 public:
  [[nodiscard]] static Result<std::unique_ptr<GatherYardstick>> create(gpu::Device& device, std::uint32_t width,
                                                                       std::uint32_t height);
  ~GatherYardstick();
  GatherYardstick(const GatherYardstick&) = delete;
  GatherYardstick& operator=(const GatherYardstick&) = delete;

  /// Submits the pass and waits for it.
  [[nodiscard]] Status draw();
  /// Hash of the picture that the pass drew last.
  [[nodiscard]] Result<std::uint64_t> picture_hash();

 private:
  explicit GatherYardstick(gpu::Device& device) : device_(device), graph_(device) {}
  [[nodiscard]] Status prepare(std::uint32_t width, std::uint32_t height);

  gpu::Device& device_;
  FrameGraph graph_;
  gpu::ImageHandle map_;
  gpu::ImageHandle target_;
  gpu::SamplerHandle sampler_;
  gpu::PipelineHandle pipeline_;
};

}  // namespace gloam
