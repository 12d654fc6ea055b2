// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame/declaration.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"
#include "engine/gpu/subresources.h"

namespace gloam::test {

/// A random frame as data. A test can declare it to a graph and compute the expected result from it.
struct RandomFrame {
  struct Resource {
    bool is_image = false;
    bool imported = false;
    bool content_kept = false;  ///< of an import: its contents are kept from frame to frame
    std::uint32_t size = 1;     ///< side of an image in texels, or 16-byte units of a buffer
    std::uint32_t mips = 1;
    std::uint32_t layers = 1;
    /// Whether two uses have a mip of a layer in common.
    [[nodiscard]] bool overlap(const gpu::ImageRange& a, const gpu::ImageRange& b) const;
  };
  struct Use {
    std::uint32_t resource = 0;
    gpu::Access access = gpu::Access::none;
    gpu::ImageRange range;  ///< the whole resource, or one mip of one layer
  };
  struct Pass {
    std::vector<Use> uses;
    bool keep = false;
  };
  std::vector<Resource> resources;
  std::vector<Pass> passes;

  /// Decodes arbitrary numbers into a valid frame; more numbers give more passes.
  [[nodiscard]] static RandomFrame from(const std::vector<std::uint32_t>& numbers);
  /// For each pass, whether it must run; found by following dependencies back from the root passes.
  [[nodiscard]] std::vector<bool> reachable() const;
  [[nodiscard]] frame::Declaration declaration() const;
};

/// Runs a random frame on a device. For each access it records a command that makes this access.
class RandomFrameRunner {
 public:
  /// with_shaders false: accesses that need a shader are declared but record nothing.
  RandomFrameRunner(const RandomFrame& frame, gpu::Device& device, bool with_shaders);
  ~RandomFrameRunner();
  RandomFrameRunner(const RandomFrameRunner&) = delete;
  RandomFrameRunner& operator=(const RandomFrameRunner&) = delete;

  /// Declares and runs the first `pass_count` passes as one frame. Returns the names of the passes that ran.
  std::vector<std::string> run(std::uint32_t pass_count);
  /// Call it when the device is idle. Describes all wrong values that the last frame's copies have read; empty if there
  /// are none. Only for devices that execute clears.
  [[nodiscard]] std::string wrong_contents();

 private:
  struct Imported {
    gpu::ImageHandle image;
    gpu::BufferHandle buffer;
    bool used = false;
  };
  /// A copy to the scratch buffer with a known first byte.
  struct Expected {
    std::uint64_t offset = 0;
    std::uint8_t value = 0;
    std::string text;
  };
  void make_imports();
  void declare_resources(std::vector<ImageRef>& images, std::vector<BufferRef>& buffers);
  void record(PassContext& context, std::uint32_t pass, const std::vector<ImageRef>& images,
              const std::vector<BufferRef>& buffers);
  void follow_contents(std::uint32_t pass, const RandomFrame::Use& use);
  void touch_image(gpu::CommandList& commands, gpu::ImageHandle image, const RandomFrame::Use& use, std::uint8_t value);
  [[nodiscard]] gpu::ImageDesc image_desc(const RandomFrame::Resource& resource, std::string name) const;
  void touch_buffer(gpu::CommandList& commands, gpu::BufferHandle buffer, gpu::Access access, std::uint8_t value);
  void dispatch(gpu::CommandList& commands, const gpu::Binding& binding);
  void draw(gpu::CommandList& commands, const gpu::Binding& binding);
  void make_scratch_ready(gpu::CommandList& commands, gpu::Access access);

  const RandomFrame& frame_;
  gpu::Device& device_;
  bool with_shaders_;
  FrameGraph graph_{device_};
  std::vector<Imported> imports_;
  gpu::PipelineHandle compute_;
  gpu::PipelineHandle paint_;
  gpu::PipelineHandle paint_stream_;
  gpu::BufferHandle scratch_;
  std::uint64_t scratch_used_ = 0;
  std::vector<std::string> ran_;
  /// The value of each resource, for images of each mip and layer, where known.
  std::vector<gpu::Subresources<std::optional<std::uint8_t>>> contents_;
  std::vector<Expected> expected_;
};

}  // namespace gloam::test
