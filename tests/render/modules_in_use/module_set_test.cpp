// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/modules_in_use/module_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/modules_in_use/knobs_in_use.h"
#include "engine/render/worlds/world_slots.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Answers and calls of an AskedModule. Must outlive it.
struct Answers {
  bool world = true;
  bool view = true;
  bool casters = false;
  bool essential = false;
  bool moves = false;
  std::string reason = "asked";
  bool pipeline = false;  ///< lists one pipeline
  std::uint32_t released = 0;
  std::uint32_t given_up = 0;
};

class AskedModule final : public Module {
 public:
  AskedModule(std::string name, Answers& answers) : name_(std::move(name)), answers_(answers) {}
  [[nodiscard]] std::string_view name() const override { return name_; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView* view) const override {
    return {view == nullptr ? answers_.world : answers_.view, answers_.reason};
  }
  [[nodiscard]] bool needs_casters(const World&, const KnobRegistry&) const override { return answers_.casters; }
  [[nodiscard]] bool essential() const override { return answers_.essential; }
  [[nodiscard]] bool changes_at_rest(const World&, const KnobRegistry&) const override { return answers_.moves; }
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override {
    return {{name_ + "_view", name_, "", "a legend"}};
  }
  void pipelines(const KnobRegistry&, const gpu::DeviceInfo&, PipelineList& list) const override {
    gpu::ComputePipelineDesc desc;
    desc.name = name_;
    desc.module = name_;
    if (answers_.pipeline) list.push_back(desc);
  }
  void give_up_frame(std::uint64_t) override { ++answers_.given_up; }
  void release() override { ++answers_.released; }

 private:
  std::string name_;
  Answers& answers_;
};

/// Two modules, `a` and `b`, and a world with one view, without a renderer.
struct TwoModules {
  TwoModules() {
    slots.add(world);
    view.id = ViewId{4};
  }
  [[nodiscard]] static ModuleList make(Answers& a, Answers& b) {
    ModuleList list;
    list.push_back(std::make_unique<AskedModule>("a", a));
    list.push_back(std::make_unique<AskedModule>("b", b));
    return list;
  }
  [[nodiscard]] ViewQuery query() const { return {world, view, without, knobs}; }
  [[nodiscard]] PipelineWait wait(Readiness readiness = Readiness::wait) {
    return {readiness, resources.pipelines, device->info(), null_log()};
  }
  /// A frame with the view in it. Returns the names of the modules that take part.
  std::vector<std::string> draw(Readiness readiness = Readiness::wait) {
    modules.begin_frame(world, schedule);
    std::vector<std::string> names;
    for (const Module* module : modules.begin_view(query(), wait(readiness))) names.emplace_back(module->name());
    modules.end_frame(resources);
    return names;
  }

  std::unique_ptr<gpu::RecordingDevice> device = gpu::make_recording_device();
  Answers a, b;
  FrameResources resources{*device};
  WorldSlots slots{*device, resources.pipelines, {}};
  Schedule schedule;
  World world;
  RenderView view;
  std::vector<std::string> without;
  KnobRegistry knobs;
  ModuleSet modules{make(a, b)};
};

TEST(ModuleSet, a_module_takes_part_if_world_and_view_demand_it_and_the_view_does_not_leave_it_out) {
  TwoModules set;
  EXPECT_THAT(set.draw(), ElementsAre("a", "b"));
  set.a.world = false;
  EXPECT_THAT(set.draw(), ElementsAre("b"));
  set.a.world = true;
  set.b.view = false;
  EXPECT_THAT(set.draw(), ElementsAre("a"));
  set.without = {"a"};
  EXPECT_THAT(set.draw(), IsEmpty());
}

TEST(ModuleSet, questions_reach_only_the_modules_that_are_demanded) {
  TwoModules set;
  set.b.casters = true;
  set.draw();
  EXPECT_TRUE(set.modules.any_needs(&Module::needs_casters, set.world, set.knobs));
  EXPECT_TRUE(set.modules.view_needs(&Module::needs_casters, set.query()));
  set.b.view = false;
  EXPECT_TRUE(set.modules.any_needs(&Module::needs_casters, set.world, set.knobs)) << "the world still demands it";
  EXPECT_FALSE(set.modules.view_needs(&Module::needs_casters, set.query()));
  set.b.world = false;
  set.draw();
  EXPECT_FALSE(set.modules.any_needs(&Module::needs_casters, set.world, set.knobs));
}

TEST(ModuleSet, only_demanded_modules_are_asked_whether_they_change_pictures_at_rest) {
  TwoModules set;
  const auto moves = [&] { return set.modules.any_needs(&Module::changes_at_rest, set.world, set.knobs); };
  set.draw();
  EXPECT_FALSE(moves());
  set.b.moves = true;
  EXPECT_TRUE(moves());
  set.b.world = false;
  set.draw();
  EXPECT_FALSE(moves());
}

TEST(ModuleSet, an_idle_module_gives_its_memory_back_once) {
  TwoModules set;
  set.draw();
  set.a.view = false;
  for (std::uint32_t frame = 1; frame < kFramesUntilRelease; ++frame) set.draw();
  EXPECT_EQ(set.a.released, 0u);
  set.draw();
  EXPECT_EQ(set.a.released, 1u);
  for (std::uint32_t frame = 0; frame < 2 * kFramesUntilRelease; ++frame) set.draw();
  EXPECT_EQ(set.a.released, 1u);
  EXPECT_EQ(set.b.released, 0u);
}

TEST(ModuleSet, a_module_is_released_with_the_last_of_its_views) {
  TwoModules set;
  set.draw();
  set.view.id = ViewId{5};
  set.b.view = false;
  set.draw();
  const auto is_view = [](std::uint32_t id) { return [id](std::uint64_t, std::uint32_t view) { return view == id; }; };
  set.modules.release_modules_of(is_view(4), set.resources);
  EXPECT_EQ(set.a.released, 0u) << "it took part in view 5 as well";
  EXPECT_EQ(set.b.released, 1u);
  set.modules.release_modules_of(is_view(5), set.resources);
  EXPECT_EQ(set.a.released, 1u);
}

TEST(ModuleSet, a_given_up_frame_concerns_the_modules_of_its_views) {
  TwoModules set;
  set.b.view = false;
  set.draw();
  set.modules.give_up_frame(1);
  EXPECT_EQ(set.a.given_up, 1u);
  EXPECT_EQ(set.b.given_up, 0u);
}

TEST(ModuleSet, in_the_background_a_module_waits_for_its_pipelines_unless_it_is_essential) {
  TwoModules set;
  set.a.pipeline = set.b.pipeline = true;
  set.b.essential = true;
  EXPECT_THAT(set.draw(Readiness::background), ElementsAre("b"));
  while (set.resources.pipelines.pending() > 0) std::this_thread::yield();
  EXPECT_THAT(set.draw(Readiness::background), ElementsAre("a", "b"));
}

TEST(ModuleSet, an_idle_visualizer_has_the_reason_of_its_module) {
  TwoModules set;
  set.a.view = false;
  set.a.reason = "nothing to show";
  set.draw();
  EXPECT_EQ(set.modules.reason_of_idle_visualizer("a_view:ARGUMENT", set.query()), "nothing to show");
  EXPECT_EQ(set.modules.reason_of_idle_visualizer("b_view", set.query()), "");
  EXPECT_EQ(set.modules.reason_of_idle_visualizer("unknown", set.query()), "");
}

Knob level_knob() {
  Knob knob;
  knob.name = "a.level";
  knob.module = "a";
  knob.meaning = "a level";
  knob.type = Knob::Type::integer;
  knob.min = 0;
  knob.max = 9;
  return knob;
}

TEST(KnobsInUse, changed_values_wait_for_the_pipelines_of_shown_modules) {
  TwoModules set;
  KnobsInUse knobs;
  knobs.set.add(level_knob());
  const auto drawn_level = [&](Readiness readiness) {
    const KnobRegistry& drawn = knobs.settle(set.modules, set.wait(readiness));
    return drawn.text(*drawn.find("a.level"));
  };
  set.draw(Readiness::background);
  EXPECT_EQ(drawn_level(Readiness::background), "0");
  set.a.pipeline = true;  // with the new value the module needs a pipeline that does not exist yet
  ASSERT_TRUE(knobs.set.set("a.level", "3").ok());
  EXPECT_EQ(drawn_level(Readiness::background), "0");
  EXPECT_EQ(drawn_level(Readiness::wait), "3") << "a frame that waits has the new value at once";
  while (set.resources.pipelines.pending() > 0) std::this_thread::yield();
  EXPECT_EQ(drawn_level(Readiness::background), "3");
}

}  // namespace
}  // namespace gloam
