// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <tuple>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"
#include "engine/render/declare/shader_interface.h"

namespace gloam {

/// Small resources with undefined content. They stand for resources that a frame does not have, because a descriptor
/// set must be complete even where a shader reads nothing. Created on first use.
class Placeholders {
 public:
  explicit Placeholders(gpu::Device& device) : device_(device) {}
  ~Placeholders();
  Placeholders(const Placeholders&) = delete;
  Placeholders& operator=(const Placeholders&) = delete;

  /// An image that the binding accepts, imported into the graph's current frame.
  [[nodiscard]] Result<ImageRef> image(FrameGraph& graph, const InterfaceBinding& binding);
  /// A uniform and storage buffer of kBufferBytes.
  [[nodiscard]] Result<gpu::Binding::BufferRange> buffer();
  static constexpr std::uint64_t kBufferBytes = 65536;
  /// Destroys all; they are created again when they are needed.
  void release();

 private:
  using Key = std::tuple<gpu::ImageDimension, bool, gpu::TexelKind, bool>;  ///< dimension, arrayed, texels, storage
  struct Image {
    gpu::ImageHandle image;
    ImageRef imported;
  };
  gpu::Device& device_;
  std::map<Key, Image> images_;
  gpu::BufferHandle buffer_;
};

}  // namespace gloam
