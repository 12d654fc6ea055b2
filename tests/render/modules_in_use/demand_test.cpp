// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "modules/closeups/components.h"
#include "modules/grass/components.h"
#include "modules/particles/components.h"
#include "modules/shadows/components.h"
#include "tests/render/modules_in_use/demand_fixture.h"

namespace gloam {
namespace {

using test::CountingModule;
using test::kFramesKept;
using test::kOptionalModules;
using test::Seen;
using ::testing::IsEmpty;

/// The parameter is the name of a module that the scene can demand.
class DemandOf : public test::DemandTest, public ::testing::WithParamInterface<std::string> {
 protected:
  [[nodiscard]] Seen now() { return seen(GetParam()); }

  void expect_nothing_at_all() {
    expect_nothing_in_the_frame();
    EXPECT_EQ(now().pipelines, 0u);
    EXPECT_EQ(now().bytes, 0u);
  }
  void expect_nothing_in_the_frame() {
    const Seen n = now();
    EXPECT_EQ(n.passes, 0u);
    EXPECT_EQ(n.dispatches, 0u);
    EXPECT_EQ(n.draws, 0u);
  }
  void expect_at_work() {
    const Seen n = now();
    EXPECT_GE(n.passes, 1u);
    EXPECT_GE(n.dispatches + n.draws, 1u);
    EXPECT_GE(n.pipelines, 1u);
  }
};
INSTANTIATE_TEST_SUITE_P(Modules, DemandOf, ::testing::ValuesIn(kOptionalModules),
                         [](const auto& instance) { return instance.param; });

using DemandOfEveryModule = test::DemandTest;

// A window keeps the picture of a scene at rest, so a module that forgets to answer would stand still in it.
TEST_F(DemandOfEveryModule, pictures_at_rest_change_with_what_simulates_or_adapts_and_nothing_else) {
  every_module_ = true;
  make_renderer(Readiness::wait);
  EXPECT_FALSE(renderer_->changes_at_rest(*world_)) << "no frame has asked the modules yet";
  static_cast<void>(call_for("lights"));
  static_cast<void>(call_for("fog"));
  frames();
  EXPECT_FALSE(renderer_->changes_at_rest(*world_)) << "lights, shadows and fog stand still";
  ASSERT_TRUE(renderer_->knobs().set("lighting.exposure", "adapting").ok());
  EXPECT_TRUE(renderer_->changes_at_rest(*world_));
  ASSERT_TRUE(renderer_->knobs().set("lighting.exposure", "metered").ok());
  EXPECT_FALSE(renderer_->changes_at_rest(*world_));
  const Entity fountain = world_->create(WorldTransform{in_view()}, ParticleEmitter{.kind = EmitterKind::dust});
  frames();
  EXPECT_TRUE(renderer_->changes_at_rest(*world_));
  world_->destroy(fountain);
  frames();
  EXPECT_FALSE(renderer_->changes_at_rest(*world_));
  static_cast<void>(world_->create(WorldTransform{in_view()}, GrassSurface{.density = 10.0f}));
  frames();
  EXPECT_TRUE(renderer_->changes_at_rest(*world_));
}

TEST_F(DemandOfEveryModule, without_it_a_module_runs_nothing_and_owns_nothing) {
  every_module_ = true;
  make_renderer(Readiness::wait);
  frames(3);
  std::size_t idle = 0;
  for (const ModuleState& state : renderer_->report().modules) {
    if (state.demanded || state.name == "engine") continue;
    SCOPED_TRACE(state.name);
    const Seen n = seen(state.name);
    EXPECT_THAT(n.systems, IsEmpty());
    EXPECT_EQ(n.passes + n.dispatches + n.draws + n.pipelines, 0u);
    EXPECT_EQ(n.bytes, 0u);
    ++idle;
  }
  EXPECT_EQ(idle, make_all_modules().size() - 1) << "the small scene is lit, and calls for nothing else";
}

/// Modules whose demand depends on the view.
class DemandInView : public DemandOf {};
INSTANTIATE_TEST_SUITE_P(Modules, DemandInView, ::testing::Values("lights", "counting"),
                         [](const auto& instance) { return instance.param; });

TEST_P(DemandOf, absent_it_runs_nothing_and_owns_nothing) {
  for (int frame = 0; frame < 130; ++frame) {
    frames();
    EXPECT_THAT(now().systems, IsEmpty());
    expect_nothing_at_all();
  }
  EXPECT_EQ(gate_->asked_here(GetParam()) + gate_->asked_elsewhere(GetParam()), 0u);
  EXPECT_EQ(calls_.prepared + calls_.passes + calls_.counters, 0u);
  EXPECT_EQ(world_->resource<test::CountedRuns>().world + world_->resource<test::CountedRuns>().view, 0u);
  EXPECT_FALSE(renderer_->report().counters.contains("lights.total"));
  EXPECT_THAT(log_.lines(), IsEmpty());
}

TEST_P(DemandOf, one_that_appears_is_in_the_very_first_frame) {
  frames(3);
  static_cast<void>(call_for(GetParam()));
  frames();
  expect_at_work();
}

TEST_P(DemandOf, one_that_is_there_from_the_start_is_in_the_very_first_frame) {
  static_cast<void>(call_for(GetParam()));
  frames();
  expect_at_work();
}

TEST_P(DemandOf, one_that_disappears_works_no_more_in_the_next_frame) {
  frames(2);
  const auto before = work();
  const Entity cause = call_for(GetParam());
  frames(3);
  EXPECT_NE(work(), before);
  world_->destroy(cause);
  frames();
  EXPECT_THAT(now().systems, IsEmpty());
  expect_nothing_in_the_frame();
  EXPECT_EQ(work(), before);
}

TEST_P(DemandOf, one_that_disappeared_gives_everything_back) {
  frames(2);
  const std::string before = belongings();
  const Entity cause = call_for(GetParam());
  frames(3);
  EXPECT_NE(belongings(), before);
  world_->destroy(cause);
  frames(kFramesKept - 1);
  EXPECT_GE(now().pipelines, 1u) << "it might come back";
  frames();
  expect_nothing_at_all();
}

TEST_P(DemandInView, one_out_of_view_works_no_more_from_that_frame_on_and_keeps_its_pipelines) {
  const Entity cause = call_for(GetParam());
  settle();
  const Seen visible = now();
  show(GetParam(), cause, false);
  for (std::uint32_t frame = 0; frame < 2 * kFramesKept; ++frame) {
    frames();
    expect_nothing_in_the_frame();
    EXPECT_EQ(now().pipelines, visible.pipelines);
    if (frame + 1 >= kFramesKept) {
      EXPECT_EQ(now().bytes, 0u);
    }
  }
  const std::uint32_t made = gate_->asked_here(GetParam());
  show(GetParam(), cause, true);
  frames(2);  // the first one uploads what the view has lost
  const Seen again = now();
  EXPECT_EQ(again.passes, visible.passes);
  EXPECT_EQ(again.dispatches, visible.dispatches);
  EXPECT_EQ(again.bytes, visible.bytes);
  EXPECT_EQ(again.systems, visible.systems);
  EXPECT_EQ(gate_->asked_here(GetParam()), made);
}

TEST_P(DemandInView, one_out_of_view_for_long_gives_its_pipelines_back_once_it_is_gone) {
  const Entity cause = call_for(GetParam());
  frames(3);
  show(GetParam(), cause, false);
  frames(kFramesKept + 50);
  world_->destroy(cause);
  frames(kFramesKept - 1);
  EXPECT_GE(now().pipelines, 1u);
  frames();
  expect_nothing_at_all();
}

TEST_P(DemandOf, a_hundred_quick_toggles_grow_nothing) {
  settle();
  std::string on, off;
  std::uint64_t resources = 0;
  for (int toggle = 0; toggle < 100; ++toggle) {
    const Entity cause = call_for(GetParam());
    frames();
    expect_at_work();
    if (toggle == 3) on = belongings();
    ASSERT_TRUE(toggle <= 3 || belongings() == on) << toggle << "\n" << belongings();
    world_->destroy(cause);
    frames();
    expect_nothing_in_the_frame();
    if (toggle == 3) off = belongings();
    ASSERT_TRUE(toggle <= 3 || belongings() == off) << toggle << "\n" << belongings();
    if (toggle == 3) resources = gate_->resources_made();
  }
  EXPECT_EQ(gate_->resources_made(), resources) << "toggling makes nothing anew";
}

TEST_P(DemandOf, slow_toggles_return_to_the_same_numbers) {
  frames(2);  // lighting compiles its variant without lights and keeps it
  std::string with, without;
  for (int toggle = 0; toggle < 4; ++toggle) {
    const Entity cause = call_for(GetParam());
    frames(kFramesKept);
    if (toggle == 0) with = belongings();
    EXPECT_EQ(belongings(), with) << toggle;
    world_->destroy(cause);
    frames(kFramesKept);
    expect_nothing_at_all();
    if (toggle == 0) without = belongings();  // taken only here, because lighting keeps its variant with lights
    EXPECT_EQ(belongings(), without) << toggle;
  }
}

TEST_P(DemandOf, another_world_without_it_takes_nothing_from_the_one_that_has_it) {
  World other;
  renderer_->prepare_world(other);
  static_cast<void>(call_for(GetParam()));
  settle();
  const std::uint64_t bytes = now().bytes;
  for (std::uint32_t i = 0; i < kFramesKept + 10; ++i) {
    ASSERT_TRUE(render(other, {request(1)}).ok());
    expect_nothing_in_the_frame();
    frames();
    expect_at_work();
  }
  EXPECT_GE(now().bytes, bytes);
  EXPECT_TRUE(GetParam() != "counting" || calls_.releases == 0u);
  renderer_->release_world(other);
}

class DemandFrames : public test::DemandTest {};

TEST_F(DemandFrames, memory_goes_after_120_frames_and_not_after_119) {
  const Entity counted = call_for("counting");
  settle();
  EXPECT_EQ(seen("counting").bytes, CountingModule::kKeptBytes + 8 * 8 * 4);
  show("counting", counted, false);
  for (int round = 0; round < 2; ++round) {
    frames(kFramesKept - 1);
    EXPECT_EQ(seen("counting").bytes, CountingModule::kKeptBytes) << "the transient image goes with its plan, sooner";
    EXPECT_EQ(calls_.releases, 0u);
    if (round > 0) break;
    show("counting", counted, true);  // one frame with demand restarts the count
    frames();
    show("counting", counted, false);
  }
  frames();
  EXPECT_EQ(seen("counting").bytes, 0u);
  EXPECT_EQ(seen("counting").pipelines, 1u);
  EXPECT_EQ(calls_.releases, 1u);
  frames(3 * kFramesKept);
  EXPECT_EQ(calls_.releases, 1u) << "once is enough";
}

TEST_F(DemandFrames, what_is_out_of_view_runs_its_systems_but_adds_no_passes) {
  const Entity counted = call_for("counting");
  frames(2);
  const std::uint32_t passes = calls_.passes;
  show("counting", counted, false);
  frames(3);
  EXPECT_EQ(world_->resource<test::CountedRuns>().world, 5u);
  EXPECT_EQ(world_->resource<test::CountedRuns>().view, 5u);
  EXPECT_EQ(calls_.passes, passes);
  world_->destroy(counted);
  frames(3);
  EXPECT_EQ(world_->resource<test::CountedRuns>().world, 5u);
  EXPECT_EQ(world_->resource<test::CountedRuns>().view, 5u);
}

// Hard case: program.counters
TEST_F(DemandFrames, counters_are_those_of_modules_that_took_part_in_the_last_view) {
  const Entity counted = call_for("counting");
  static_cast<void>(call_for("lights"));
  frames();
  EXPECT_EQ(calls_.counters, 1u);
  EXPECT_TRUE(renderer_->report().counters.contains("lights.visible"));
  show("counting", counted, false);
  ViewRequest away = request(1);
  away.settings.world_from_camera =
      test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(4.0, 6.0, 18.0), 64, 40).world_from_camera;
  frames(1, {request(), away});
  EXPECT_EQ(calls_.counters, 1u);
  EXPECT_FALSE(renderer_->report().counters.contains("lights.visible"));
  frames(1, {away, request()});
  EXPECT_TRUE(renderer_->report().counters.contains("lights.visible"));
  frames(1, {});
  EXPECT_FALSE(renderer_->report().counters.contains("lights.visible"));
}

TEST_F(DemandFrames, lights_work_for_the_view_that_sees_them_alone) {
  static_cast<void>(call_for("lights"));
  ViewRequest away = request(1);
  away.settings.world_from_camera =
      test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(4.0, 6.0, 18.0), 64, 40).world_from_camera;
  frames(2, {request(), away});
  EXPECT_EQ(seen("lights").passes, 3u);  // zBins and masks are those of the frame before
  const std::uint64_t bytes = seen("lights").bytes;
  frames(kFramesKept + 5, {away, request()});
  EXPECT_EQ(seen("lights").passes, 3u);
  EXPECT_EQ(seen("lights").bytes, bytes);
  frames(1, {away});
  EXPECT_EQ(seen("lights").passes, 0u);
}

/// A renderer of all modules.
class DemandOfAll : public test::DemandTest {
 protected:
  void SetUp() override {
    every_module_ = true;
    make_renderer(Readiness::wait);
  }
  /// Above the camera, so that only sky is in view, also of the lights' ranges.
  [[nodiscard]] static ViewRequest skyward() {
    ViewRequest up = request();
    up.settings.world_from_camera = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(2.0, 9.0, 9.5), 64, 40).world_from_camera;
    return up;
  }
  [[nodiscard]] ModuleState state_of(std::string_view name) const {
    const FrameReport report = renderer_->report();
    for (const ModuleState& state : report.modules)
      if (state.name == name) return state;
    ADD_FAILURE() << "there is no module " << name;
    return {};
  }
  [[nodiscard]] std::set<std::string> pass_names() const {
    std::set<std::string> names;
    for (const PassTime& pass : renderer_->report().passes) names.insert(pass.name);
    return names;
  }
  void expect_idle(std::string_view name, std::string_view why) {
    const Seen n = seen(std::string(name));
    EXPECT_EQ(n.passes + n.dispatches + n.draws, 0u) << name << " " << why;
    EXPECT_EQ(n.bytes, 0u) << name << " " << why;
  }
};

TEST_F(DemandOfAll, with_only_sky_in_view_there_is_no_light_search_no_shadow_and_no_antialiasing) {
  ASSERT_TRUE(renderer_->knobs().set("lighting.antialiasing", "smaa").ok());
  for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional}) {
    Light light;
    light.kind = kind;
    light.intensity = 10.0f;
    light.range_m = 1000.0f;  // reaches the view
    world_->create(light, ShadowCaster{}, WorldTransform{glm::translate(dmat4(1.0), dvec3(0.0, 4.0, 0.0))});
  }
  frames(3);
  EXPECT_GT(seen("lights").passes, 0u);
  EXPECT_GT(seen("shadows").passes, 0u);
  EXPECT_THAT(pass_names(), testing::Contains("antialiasing_edges"));
  frames(3, {skyward()});
  EXPECT_EQ(seen("lights").passes + seen("shadows").passes + seen("reflections").passes, 0u);
  EXPECT_FALSE(pass_names().contains("antialiasing_edges"));
  EXPECT_TRUE(pass_names().contains("tone_map"));
  frames(kFramesKept, {skyward()});
  for (const char* module : {"lights", "shadows", "closeups", "reflections"}) expect_idle(module, "after 120 frames");
  frames(3);
  EXPECT_GT(seen("lights").passes, 0u);
  EXPECT_GT(seen("shadows").passes, 0u);
  EXPECT_THAT(pass_names(), testing::Contains("antialiasing_edges"));
}

TEST_F(DemandOfAll, fog_before_the_sky_keeps_the_lights) {
  world_->create(Light{.intensity = 10.0f, .range_m = 1000.0f}, WorldTransform{});
  world_->create(Fog{0.05f, vec3(1.0f, 2.0f, 3.0f)});
  frames(3, {skyward()});
  EXPECT_GT(seen("fog").passes, 0u);
  EXPECT_GT(seen("lights").passes, 0u);
}

TEST_F(DemandOfAll, a_knob_that_switches_a_module_off_is_no_demand) {
  world_->create(Light{.intensity = 10.0f}, ShadowCaster{},
                 WorldTransform{glm::translate(dmat4(1.0), dvec3(2.0, 4.0, 3.0))});
  world_->resource<SceneAssets>().materials.front().metallic = 1.0f;
  world_->resource<SceneAssets>().materials.front().roughness = 0.0f;
  ++world_->resource<SceneAssets>().version;
  Entity subject;
  world_->view<const MeshInstance>().each([&](Entity entity, const MeshInstance&) { subject = entity; });
  world_->add(subject, CloseupSubject{.enabled = true});
  const std::pair<const char*, std::pair<const char*, const char*>> knobs[] = {
      {"closeups", {"closeups.max_pairs", "0"}},
      {"reflections", {"reflections.mode", "off"}},
      {"shadows", {"shadows.mode", "off"}}};
  frames(3);
  for (const auto& [module, knob] : knobs) {
    const std::string was = renderer_->knobs().text(*renderer_->knobs().find(knob.first));
    EXPECT_TRUE(state_of(module).demanded) << module;
    EXPECT_GT(seen(module).passes, 0u) << module;
    ASSERT_TRUE(renderer_->knobs().set(knob.first, knob.second).ok());
    frames();
    EXPECT_EQ(seen(module).passes, 0u) << module;
    EXPECT_THAT(seen(module).systems, IsEmpty()) << module;
    EXPECT_FALSE(state_of(module).demanded) << module;
    EXPECT_THAT(state_of(module).reason, testing::HasSubstr(std::string(knob.first) + "=" + knob.second));
    frames(kFramesKept);
    expect_idle(module, knob.first);
    ASSERT_TRUE(renderer_->knobs().set(knob.first, was).ok());
    frames(2);
    EXPECT_GT(seen(module).passes, 0u) << module;
  }
  // A view of its own may have what the others switch off.
  ASSERT_TRUE(renderer_->knobs().set("shadows.mode", "off").ok());
  ViewRequest own = request(1);
  own.settings.knobs = {{"shadows.mode", "deferred"}};
  frames(2, {request(), own});
  EXPECT_GT(seen("shadows").passes, 0u);
  // Other knobs of its own switch nothing on.
  own.settings.knobs = {{"shadows.texels_per_pixel", "2"}};
  frames(2, {request(), own});
  EXPECT_EQ(seen("shadows").passes, 0u);
  EXPECT_FALSE(state_of("shadows").demanded);
}

TEST_F(DemandFrames, fog_without_density_is_no_fog) {
  static_cast<void>(world_->create(Fog{0.0f, vec3(1.0f)}));
  frames(3);
  const Seen fog = seen("fog");
  EXPECT_EQ(fog.passes + fog.pipelines, 0u);
  EXPECT_EQ(fog.bytes, 0u);
}

TEST_F(DemandFrames, frames_without_views_count_as_frames_without_demand) {
  static_cast<void>(call_for("counting"));
  frames(2);
  frames(kFramesKept, {});
  EXPECT_EQ(seen("counting").bytes, 0u);
  EXPECT_EQ(seen("counting").pipelines, 1u) << "the world still calls for it";
}

TEST_F(DemandFrames, transient_images_are_counted_under_the_module_of_the_largest_in_their_memory) {
  settle();
  const std::uint64_t before = seen("engine").bytes + seen("lighting").bytes;
  const Entity lamp = call_for("lights");
  settle();
  // For 8 × 5 shadow tiles in one tile group: texels of lights, tiles, the group mask, 24 list entries per tile (3 per
  // word), counters. The view keeps 1024 zBins and the masks of 2 × 2 tiles.
  const std::uint64_t kept = 1024u * 8u + 4u * 33u * 4u;
  EXPECT_EQ(seen("lights").bytes, 3u * 1024u * 16u + 8u * 5u * 8u + 33u * 4u + 8u * 5u * 8u * 4u + 12u * 4u + kept);
  world_->destroy(lamp);
  static_cast<void>(call_for("counting"));
  settle();
  EXPECT_EQ(seen("counting").bytes, CountingModule::kKeptBytes + 8 * 8 * 4);
  EXPECT_EQ(seen("lights").bytes, kept);
  EXPECT_EQ(seen("engine").bytes + seen("lighting").bytes, before) << "nobody else is charged";
  frames(kFramesKept);
  EXPECT_EQ(seen("lights").bytes, 0u);
}

TEST_F(DemandFrames, a_frame_whose_submission_fails_is_as_if_it_had_not_been_begun) {
  call_for("counting");
  frames(2);
  const test::CountedCalls before = calls_;
  gate_->break_submission({ErrorKind::failed, "the queue is full"});
  const Status refused = render(*world_, {request()});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "the queue is full");
  EXPECT_EQ(renderer_->report().counters.at("counting.calls"), before.counters) << "counters of the last good frame";
  EXPECT_EQ(calls_.releases, before.releases + 1) << "the module was not told that its frame was given up";
  frames();
  EXPECT_EQ(renderer_->report().counters.at("counting.calls"), calls_.counters);
  EXPECT_EQ(seen("counting").dispatches, 1u);
}

}  // namespace
}  // namespace gloam
