// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/frame/declaration.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/recording_device.h"

namespace gloam::test {

/// A random frame as data, which can be declared to a graph or looked at by an oracle.
struct RandomFrame {
  struct Resource {
    bool is_image = false;
    bool imported = false;
    bool content_kept = false;  ///< of an import: its contents pass from frame to frame
    std::uint32_t size = 1;     ///< side of an image in texels, or 16-byte units of a buffer
  };
  struct Use {
    std::uint32_t resource = 0;
    gpu::Access access = gpu::Access::none;
  };
  struct Pass {
    std::vector<Use> uses;
    bool keep = false;
  };
  std::vector<Resource> resources;
  std::vector<Pass> passes;

  /// Decodes any numbers to a legal frame; more numbers give more passes.
  [[nodiscard]] static RandomFrame from(const std::vector<std::uint32_t>& numbers);
  /// Which passes must run, found by following edges from the roots.
  [[nodiscard]] std::vector<bool> reachable() const;
  [[nodiscard]] frame::Declaration declaration() const;
};

/// Runs random frames on a recording device, each access by the command that it stands for.
class RandomFrameRunner {
 public:
  explicit RandomFrameRunner(const RandomFrame& frame);
  /// Declares and runs the first `pass_count` passes as one frame; gives the names of the passes that ran.
  std::vector<std::string> run(std::uint32_t pass_count);
  [[nodiscard]] const std::vector<std::string>& faults() const { return device_->faults(); }

 private:
  struct Imported {
    gpu::ImageHandle image;
    gpu::BufferHandle buffer;
    bool used = false;
  };
  void make_imports();
  void declare_resources(std::vector<ImageRef>& images, std::vector<BufferRef>& buffers);
  void touch_image(gpu::CommandList& commands, gpu::ImageHandle image, gpu::Access access);
  void touch_buffer(gpu::CommandList& commands, gpu::BufferHandle buffer, gpu::Access access);
  void dispatch(gpu::CommandList& commands, const gpu::Binding& binding);
  void draw(gpu::CommandList& commands, const gpu::Binding& binding);

  const RandomFrame& frame_;
  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  FrameGraph graph_{*device_};
  std::vector<Imported> imports_;
  gpu::PipelineHandle compute_;
  gpu::PipelineHandle paint_;
  gpu::PipelineHandle paint_stream_;
  gpu::BufferHandle scratch_;
};

}  // namespace gloam::test
