// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "engine/render/declare/compute_pass.h"
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
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::visualize && control_.fail) return frame.fail({ErrorKind::failed, "given up for the test"});
    if (phase != PassPhase::post) return;
    control_.view = frame.view();
    frame.on_commit([this] { ++control_.commits; });
    add_step_pass(frame);
    add_mean_pass(frame);
  }

 private:
  void add_step_pass(FrameBuilder& frame) {
    gpu::BufferDesc desc;
    desc.name = "steps";
    desc.module = kName;
    desc.size = sizeof(std::uint32_t);
    desc.usage = gpu::BufferUsage::storage;
    const auto steps =
        frame.history_buffer(desc, {.scope = HistoryScope::world, .final_access = gpu::Access::compute_read});
    if (!frame.check(steps)) return;
    control_.steps = *steps;
    if (steps->written) return;
    ComputePass pass(frame, "temporal_step", shaders::gpu_test::step_comp);
    control_.steps.buffer = pass.write("steps", steps->buffer);
    pass.push(std::uint32_t{!steps->valid()});
    pass.dispatch(1);
  }

  void add_mean_pass(FrameBuilder& frame) {
    const RenderView& view = frame.view();
    gpu::ImageDesc desc;
    desc.name = "mean";
    desc.module = kName;
    desc.format = gpu::Format::rgba32_float;
    desc.width = view.width;
    desc.height = view.height;
    desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::storage | gpu::ImageUsage::transfer_source;
    const auto mean =
        frame.history_image_pair(desc, {.final_access = gpu::Access::compute_read, .reset = control_.rule});
    if (!frame.check(mean)) return;
    control_.mean = *mean;
    ComputePass pass(frame, "temporal_mean", shaders::gpu_test::temporal_comp);
    pass.read("previous", mean->previous);
    pass.read("steps", control_.steps.buffer);
    const ImageRef current = pass.write("current", mean->current);
    pass.push(uvec2(static_cast<std::uint32_t>(view.frame), mean->valid() ? 0u : 1u));
    pass.dispatch_over(view.width, view.height);
    frame.expose(current, "mean");
  }

  TemporalControl& control_;
};

}  // namespace gloam::test
