// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "shaders/gpu_test/shaders.h"

namespace gloam::test {

/// Switches and observations of a temporal module.
struct TemporalControl {
  HistoryRule rule{.camera_cut = true, .most_missed = 2};
  bool fail = false;          ///< the frame's declaration fails after the module has added its passes
  bool demanded = true;       ///< by the world
  HistoryImagePair mean;      ///< of the last declared view
  HistoryBuffer steps;        ///< of the last declared view
  RenderView view;            ///< the last declared one
  std::uint32_t commits = 0;  ///< frames of which the module was told that they count
};

/// A module as somebody outside the engine would write it: each view has the running mean of per-frame noise (image
/// "mean"), each world a buffer of steps that is advanced once per frame. `control` must outlive it.
class TemporalModule final : public Module {
 public:
  static constexpr const char* kName = "temporal";

  explicit TemporalModule(TemporalControl& control) : control_(control) {}

  [[nodiscard]] std::string_view name() const override { return kName; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override {
    return {control_.demanded, "as the test says"};
  }
  [[nodiscard]] Status add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::visualize && control_.fail) return Error{ErrorKind::failed, "given up for the test"};
    if (phase != PassPhase::post) return {};
    control_.view = frame.view();
    frame.on_commit([this] { ++control_.commits; });
    GLOAM_TRY(add_step_pass(frame));
    return add_mean_pass(frame);
  }

 private:
  [[nodiscard]] Status add_step_pass(FrameBuilder& frame) {
    gpu::BufferDesc desc;
    desc.name = "steps";
    desc.module = kName;
    desc.size = sizeof(std::uint32_t);
    desc.usage = gpu::BufferUsage::storage;
    auto steps = frame.history_buffer(desc, {.scope = HistoryScope::world, .rest = gpu::Access::compute_read});
    if (!steps.ok()) return steps.error();
    control_.steps = *steps;
    if (steps->written) return {};
    auto pipeline = frame.services().pipelines.get(
        gpu::ComputePipelineDesc{"temporal_step", kName, shaders::gpu_test::step_comp, {}});
    if (!pipeline.ok()) return pipeline.error();
    PassBuilder pass = frame.graph().add_pass("temporal_step", kName);
    control_.steps.buffer = pass.write(steps->buffer, gpu::Access::compute_write);
    pass.execute([pipeline = *pipeline, buffer = control_.steps.buffer,
                  restart = std::uint32_t{!steps->valid()}](PassContext& context) {
      context.commands().bind_pipeline(pipeline);
      const gpu::Binding bindings[] = {{0, gpu::Binding::BufferRange{context.buffer(buffer)}}};
      context.commands().bind(bindings);
      context.commands().push(restart);
      context.commands().dispatch(1, 1, 1);
    });
    return {};
  }

  [[nodiscard]] Status add_mean_pass(FrameBuilder& frame) {
    const RenderView& view = frame.view();
    gpu::ImageDesc desc;
    desc.name = "mean";
    desc.module = kName;
    desc.format = gpu::Format::rgba32_float;
    desc.width = view.width;
    desc.height = view.height;
    desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::storage | gpu::ImageUsage::transfer_source;
    auto mean = frame.history_image_pair(desc, {.rest = gpu::Access::compute_read, .reset = control_.rule});
    if (!mean.ok()) return mean.error();
    control_.mean = *mean;
    auto pipeline = frame.services().pipelines.get(
        gpu::ComputePipelineDesc{"temporal_mean", kName, shaders::gpu_test::temporal_comp, {}});
    if (!pipeline.ok()) return pipeline.error();
    auto sampler = frame.nearest_sampler();
    if (!sampler.ok()) return sampler.error();
    struct {
      std::uint32_t frame;
      std::uint32_t restart;
    } const constants{static_cast<std::uint32_t>(view.frame), std::uint32_t{!mean->valid()}};
    PassBuilder pass = frame.graph().add_pass("temporal_mean", kName);
    pass.read(mean->previous, gpu::Access::compute_read);
    pass.read(control_.steps.buffer, gpu::Access::compute_read);
    const ImageRef current = pass.write(mean->current, gpu::Access::compute_write);
    pass.execute([=, &view, pipeline = *pipeline, sampler = *sampler, previous = mean->previous,
                  steps = control_.steps.buffer](PassContext& context) {
      context.commands().bind_pipeline(pipeline);
      const gpu::Binding bindings[] = {{0, gpu::Binding::Sampled{{.image = context.image(previous)}, sampler}},
                                       {1, gpu::Binding::Storage{{.image = context.image(current)}}},
                                       {2, gpu::Binding::BufferRange{context.buffer(steps)}}};
      context.commands().bind(bindings);
      context.commands().push(constants);
      context.commands().dispatch((view.width + 7) / 8, (view.height + 7) / 8, 1);
    });
    frame.expose(current, "mean");
    return {};
  }

  TemporalControl& control_;
};

}  // namespace gloam::test
