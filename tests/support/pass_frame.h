// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/declare/recording.h"
#include "engine/render/frame_builder.h"
#include "engine/render/scene/gpu_scene.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// Frames that consist of declared passes only, without a renderer, a view or a draw, so they run at every vector width
/// of lavapipe. Any error fails the test.
class PassFrames {
 public:
  explicit PassFrames(gpu::Device& device)
      : device_(device),
        pipelines_(device),
        uniforms_(device, "test", gpu::BufferUsage::uniform),
        storage_(device, "test", gpu::BufferUsage::storage | gpu::BufferUsage::transfer_source),
        results_(device),
        declared_(device),
        history_(device),
        graph_(device),
        scene_(device, pipelines_) {}
  ~PassFrames() {
    static_cast<void>(device_.wait_idle());
    for (const gpu::BufferHandle buffer : buffers_) device_.destroy(buffer);
  }
  PassFrames(const PassFrames&) = delete;
  PassFrames& operator=(const PassFrames&) = delete;

  /// Draws a frame with the passes that declare(FrameBuilder&) adds, and waits for it.
  void draw(const std::function<void(FrameBuilder&)>& declare) {
    run_frame(device_, [&](gpu::CommandList& commands) {
      uniforms_.begin_frame();
      storage_.begin_frame();
      results_.begin_frame();
      graph_.begin();
      declared_.recordings.begin_frame();
      declared_.due_pipelines.begin_frame();
      history_.begin_frame();
      shared_.clear();
      FrameBuilder frame(services(), graph_, world_, view_, scene_, draws_, 0, shared_);
      declare(frame);
      expect(frame.status());
      expect(declared_.due_pipelines.make_all(pipelines_, *executor_));
      expect(graph_.compile());
      graph_.execute(commands);
      expect(graph_.recorded());
    });
  }
  /// In declare(): a buffer of the frame with these items (at least one).
  template <class T>
  [[nodiscard]] BufferRef input(const std::string& name, const std::vector<T>& items) {
    buffers_.push_back(make_upload(device_, items));
    return graph_.import_buffer(name, buffers_.back(), gpu::Access::none, gpu::Access::none);
  }
  /// In declare(): keeps the first `bytes` of a buffer for read(). buffer: the version that no later pass writes.
  void keep(FrameBuilder& frame, const std::string& name, BufferRef buffer, std::uint64_t bytes) {
    const gpu::BufferHandle target = make_readback(device_, bytes);
    buffers_.push_back(target);
    kept_[name] = target;
    PassBuilder pass = graph_.add_pass("keep_" + name, frame.module());
    pass.keep();
    pass.read(buffer, gpu::Access::transfer_read);
    const BufferRef copy =
        pass.write(graph_.import_buffer(name + "_copy", target, gpu::Access::none, gpu::Access::host_read),
                   gpu::Access::transfer_write);
    pass.execute([buffer, copy, bytes](PassContext& context) {
      context.commands().copy_buffer(context.buffer(buffer), 0, context.buffer(copy), 0, bytes);
    });
  }
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& name) {
    return items_of<T>(device_, kept_.at(name));
  }

 private:
  [[nodiscard]] FrameServices services() {
    return {.device = device_,
            .executor = *executor_,
            .log = gpu_log(),
            .knobs = knobs_,
            .pipelines = pipelines_,
            .uniforms = uniforms_,
            .storage = storage_,
            .results = results_,
            .declared = declared_,
            .history = history_};
  }
  static void expect(const Status& status) { EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message); }

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
  std::vector<gpu::BufferHandle> buffers_;
  std::map<std::string, gpu::BufferHandle> kept_;
};

}  // namespace gloam::test
