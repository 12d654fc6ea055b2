// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "engine/frame/upload.h"
#include "engine/render/frame_builder.h"
#include "modules/reflections/frame.h"

namespace gloam {

/// Staging memory of the module, for captured images. It exists while a world with captures is drawn.
class ReflectionStaging {
 public:
  [[nodiscard]] UploadRing& ring(gpu::Device& device);
  void release() { ring_.reset(); }

 private:
  std::unique_ptr<UploadRing> ring_;
  std::uint64_t frame_ = ~0ull;
};

/// PassPhase::announce: puts ReflectionFrame on the board and takes over the specular ambient term, if a visible
/// material reflects.
void announce_reflections(FrameBuilder& frame);

/// PassPhase::shading, after lighting: adds the reflections to LitOutput.
void add_reflection_passes(FrameBuilder& frame, ReflectionStaging& staging);

/// Pipelines that add_reflection_passes() uses with these knobs in a world with proxies. direct: on a device that runs
/// threads in turn. probes: number of captured probes.
void list_reflection_pipelines(const ReflectionKnobs& knobs, bool direct, std::size_t probes, PipelineList& list);

}  // namespace gloam
