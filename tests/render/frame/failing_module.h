// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "engine/schedule/parameters.h"
#include "engine/schedule/schedule.h"

namespace gloam::test {

/// Places of a frame in which the failing module can fail.
enum class FailAt {
  nowhere,
  demand,               ///< throws
  world_system,         ///< throws
  world_job,            ///< one job of many throws
  view_system,          ///< throws
  prepare_view,         ///< throws
  early_declaration,    ///< throws in the first phase
  late_declaration,     ///< throws in the last phase
  declaration_job,      ///< one job of many throws
  declaration_error,    ///< returns an error
  recording,            ///< throws in a pass
  recording_rendering,  ///< throws in a pass, inside begin_rendering
  recording_job,        ///< one job of many throws in a pass
  recording_error,      ///< a pass reports an error
  foreign,              ///< throws what is no std::exception, inside begin_rendering
};

/// Where the module fails; a resource of the world. `jobs`: jobs that have ended.
struct Failure {
  FailAt at = FailAt::nowhere;
  std::uint32_t view = ~0u;  ///< only in this view; ~0: in any
  std::uint32_t* ended = nullptr;
};

inline constexpr std::uint32_t kFailingJobs = 64;

/// A module that draws nothing visible and fails on demand. It keeps a result every frame.
class FailingModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "failing"; }
  void register_components(World& world) const override { world.set_resource(Failure{}); }
  void scene_keys(KeyRegistry&) const override {}
  void add_systems(Schedule& schedule) override {
    schedule.add_system("fail_in_world", "failing", Stage::world, &fail_in_world);
    schedule.add_system("fail_in_view", "failing", Stage::view, &fail_in_view);
  }
  [[nodiscard]] Demand demand(const World& world, const RenderView*) const override {
    if (world.resource<Failure>().at == FailAt::demand) throw std::runtime_error("text of demand");
    return {true, "it fails"};
  }
  void prepare_view(World& world, ViewId, const KnobRegistry&) const override {
    if (world.resource<Failure>().at == FailAt::prepare_view) throw std::runtime_error("text of prepare_view");
  }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    Failure failure = frame.world().resource<Failure>();
    if (failure.view != ~0u && failure.view != frame.view().id.value) failure.at = FailAt::nowhere;
    if (failure.at == FailAt::early_declaration && phase == PassPhase::announce)
      throw std::runtime_error("text of early_declaration");
    if (phase != PassPhase::visualize) return;
    if (failure.at == FailAt::late_declaration) throw std::runtime_error("text of late_declaration");
    if (failure.at == FailAt::declaration_job) fail_in_a_job(frame.services().executor, failure);
    if (failure.at == FailAt::declaration_error) return frame.fail({ErrorKind::input, "text of declaration_error"});
    add_kept_pass(frame);
    add_failing_pass(frame, failure);
    // The frame's passes end behind the failing one.
    frame.graph().add_pass("behind_the_failure", "failing").keep();
  }

  /// Runs jobs of which one throws. The others are counted when they end.
  static void fail_in_a_job(JobExecutor& executor, const Failure& failure) {
    std::atomic<std::uint32_t> begun = 0, ended = 0;
    try {
      executor.parallel_for(kFailingJobs, 1, [&](JobRange range) {
        ++begun;
        if (range.ordinal == kFailingJobs / 2) {
          ++ended;
          throw std::runtime_error("text of a job");
        }
        volatile std::uint32_t work = 0;
        for (std::uint32_t i = 0; i < 20000; ++i) work = work + i;
        ++ended;
      });
    } catch (...) {
      if (failure.ended != nullptr) *failure.ended = begun == ended ? ended.load() : 0;
      throw;
    }
  }

 private:
  static void fail_in_world(Resource<const Failure> failure, JobExecutor& executor) {
    if (failure->at == FailAt::world_system) throw std::runtime_error("text of world_system");
    if (failure->at == FailAt::world_job) fail_in_a_job(executor, *failure);
  }
  static void fail_in_view(ViewId view, Resource<const Failure> failure) {
    const bool here = failure->view == ~0u || failure->view == view.value;
    if (here && failure->at == FailAt::view_system) throw std::runtime_error("text of view_system");
  }

  static void add_kept_pass(FrameBuilder& frame) {
    gpu::BufferDesc desc{.name = "failing_words", .module = "failing", .size = 16};
    PassBuilder fill = frame.graph().add_pass("fill", "failing");
    const BufferRef words = fill.write(frame.graph().create_buffer(desc), gpu::Access::transfer_write);
    fill.execute([words](PassContext& context) { context.commands().fill_buffer(context.buffer(words), 0, 16, 1); });
    frame.keep_result("failing", "words", words);
  }
  static void add_failing_pass(FrameBuilder& frame, const Failure& failure) {
    gpu::ImageDesc desc{.name = "failing_image", .module = "failing", .format = gpu::Format::rgba8_unorm};
    desc.width = desc.height = 8;
    PassBuilder pass = frame.graph().add_pass("may_fail", "failing");
    const ImageRef image = pass.write(frame.graph().create_image(desc), gpu::Access::color_target);
    pass.keep();
    pass.execute([image, failure, &executor = frame.services().executor](PassContext& context) {
      if (failure.at == FailAt::recording) throw std::runtime_error("text of recording");
      if (failure.at == FailAt::recording_job) fail_in_a_job(executor, failure);
      if (failure.at == FailAt::recording_error) context.fail({ErrorKind::input, "text of recording_error"});
      gpu::RenderingDesc rendering{.width = 8, .height = 8};
      rendering.colors.push_back({.view = {.image = context.image(image)}, .load = gpu::LoadOp::clear});
      context.commands().begin_rendering(rendering);
      if (failure.at == FailAt::recording_rendering) throw std::runtime_error("text of\nrecording_rendering");
      if (failure.at == FailAt::foreign) throw 17;
      context.commands().end_rendering();
    });
  }
};

}  // namespace gloam::test
