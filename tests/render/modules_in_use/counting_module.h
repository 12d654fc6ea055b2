// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "engine/ecs/view.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "engine/schedule/parameters.h"
#include "engine/schedule/schedule.h"

namespace gloam::test {

/// Makes the world demand the counting module. in_view: whether views demand it, too.
struct Counted {
  bool in_view = true;
};

/// Runs of the counting module's systems; a resource of the world.
struct CountedRuns {
  std::uint32_t world = 0;
  std::uint32_t view = 0;
};

/// Calls of a counting module's functions.
struct CountedCalls {
  std::uint32_t prepared = 0;
  std::uint32_t passes = 0;  ///< add_passes, any phase
  std::uint32_t counters = 0;
  std::uint32_t releases = 0;
};

/// A minimal module with one of everything: two systems, a pipeline, a pass with one dispatch, a transient image, and a
/// buffer that it keeps until release. `calls` must outlive it.
class CountingModule final : public Module {
 public:
  static constexpr std::uint64_t kKeptBytes = 4096;

  explicit CountingModule(CountedCalls& calls) : calls_(calls) {}

  [[nodiscard]] std::string_view name() const override { return "counting"; }
  void register_components(World& world) const override {
    world.register_component<Counted>("counted");
    world.set_resource(CountedRuns{});
  }
  void scene_keys(KeyRegistry&) const override {}
  void add_systems(Schedule& schedule) override {
    schedule.add_system("count_world", "counting", Stage::world, &count_world_system);
    schedule.add_system("count_view", "counting", Stage::view, &count_view_system);
  }
  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    bool any = false, seen = false;
    world.view<const Counted>().each([&](const Counted& counted) {
      any = true;
      seen = seen || counted.in_view;
    });
    if (!any) return {false, "nothing to count"};
    return {view == nullptr || seen, seen ? "something to count" : "nothing to count in view"};
  }
  void prepare_view(World&, ViewId, const KnobRegistry&) const override { ++calls_.prepared; }
  void pipelines(const KnobRegistry&, const gpu::DeviceInfo&, PipelineList& list) const override {
    list.push_back(pipeline());
  }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    ++calls_.passes;
    if (phase != PassPhase::lists || !frame.check(keep_buffer(frame.services().device))) return;
    const auto made = frame.services().pipelines.get(pipeline());
    if (!frame.check(made)) return;
    gpu::ImageDesc desc;
    desc.name = "counted";
    desc.module = "counting";
    desc.format = gpu::Format::r32_uint;
    desc.width = desc.height = 8;
    const ImageRef image = frame.graph().create_image(desc);
    PassBuilder pass = frame.graph().add_pass("counting", "counting");
    static_cast<void>(pass.write(image, gpu::Access::compute_write));
    pass.keep();
    pass.execute([pipeline = *made](PassContext& context) {
      context.commands().bind_pipeline(pipeline);
      context.commands().dispatch(1, 1, 1);
    });
  }
  void counters(const World&, const RenderView&, CounterSink& sink) const override {
    ++calls_.counters;
    sink.count("counting.calls", calls_.counters);
  }
  void release() override {
    ++calls_.releases;
    if (buffer_) device_->destroy(buffer_);
    buffer_ = {};
  }

 private:
  static void count_world_system(Resource<CountedRuns> runs) { ++runs->world; }
  static void count_view_system(ViewId, Resource<CountedRuns> runs) { ++runs->view; }

  [[nodiscard]] static gpu::ComputePipelineDesc pipeline() {
    gpu::ComputePipelineDesc desc;
    desc.name = "counting";
    desc.module = "counting";
    return desc;
  }
  [[nodiscard]] Status keep_buffer(gpu::Device& device) {
    if (buffer_) return {};
    gpu::BufferDesc desc;
    desc.name = "kept";
    desc.module = "counting";
    desc.size = kKeptBytes;
    desc.usage = gpu::BufferUsage::storage;
    auto made = device.create_buffer(desc);
    if (!made.ok()) return made.error();
    device_ = &device;
    buffer_ = *made;
    return {};
  }

  CountedCalls& calls_;
  gpu::Device* device_ = nullptr;
  gpu::BufferHandle buffer_;
};

}  // namespace gloam::test
