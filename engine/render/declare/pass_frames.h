// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "engine/core/log.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/declare/recording.h"
#include "engine/render/frame_builder.h"
#include "engine/render/scene/gpu_scene.h"

namespace gloam {

/// Frames that consist of declared passes only, without a renderer, a scene or a draw: for tests and benchmarks of
/// passes.
class PassFrames {
 public:
  /// device, log: must outlive it. owner: names the memory of uploads. view: of all frames.
  PassFrames(gpu::Device& device, LogSink& log, const char* owner, const RenderView& view = {});
  /// Waits for the device.
  ~PassFrames();
  PassFrames(const PassFrames&) = delete;
  PassFrames& operator=(const PassFrames&) = delete;

  /// Begins the declaration of a frame. The builder is valid until the next call.
  [[nodiscard]] FrameBuilder& begin();
  /// Ends the declaration: compiles pipelines that do not exist yet, and the plan.
  [[nodiscard]] Status compile();
  /// Records the passes of the compiled frame.
  [[nodiscard]] Status record(gpu::CommandList& commands);
  /// The three calls above; declare adds the passes.
  [[nodiscard]] Status record(gpu::CommandList& commands, const std::function<void(FrameBuilder&)>& declare);

  [[nodiscard]] FrameGraph& graph() { return graph_; }
  /// Knobs that the passes read; none are registered at first.
  [[nodiscard]] KnobRegistry& knobs() { return knobs_; }
  [[nodiscard]] Pipelines& pipelines() { return pipelines_; }

 private:
  gpu::Device& device_;
  std::unique_ptr<JobExecutor> executor_ = make_serial_executor();
  KnobRegistry knobs_;
  Pipelines pipelines_;
  UploadRing uniforms_;
  UploadRing storage_;
  FrameResults results_;
  declare::State declared_;
  History history_;
  FrameGraph graph_;
  World world_;
  RenderView view_;
  GpuScene scene_;
  FrameDraws draws_;
  Board shared_;
  FrameServices services_;
  std::optional<FrameBuilder> frame_;
};

}  // namespace gloam
