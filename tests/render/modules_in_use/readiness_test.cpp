// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <vector>

#include "engine/render/pipelines/pipelines.h"
#include "modules/shadows/components.h"
#include "tests/render/modules_in_use/demand_fixture.h"

namespace gloam {
namespace {

using test::kFramesKept;
using test::kOptionalModules;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A renderer that does not wait for pipelines, with a closed gate.
class BackgroundRenderer : public test::DemandTest {
 protected:
  BackgroundRenderer() {
    make_renderer(Readiness::background);
    gate_->close();
  }
  [[nodiscard]] std::vector<std::string> last_commands() const {
    std::vector<std::string> lines;
    for (const gpu::RecordedCommand& command : device_->commands()) lines.push_back(command.name + " " + command.text);
    return lines;
  }
};

class ReadinessOf : public BackgroundRenderer, public ::testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Modules, ReadinessOf, ::testing::ValuesIn(kOptionalModules),
                         [](const auto& instance) { return instance.param; });

TEST_P(ReadinessOf, a_module_comes_when_its_pipelines_are_made_and_no_frame_waits_for_them) {
  frames(2);
  const auto before = work();
  static_cast<void>(call_for(GetParam()));
  frames(5);  // these frames would never end if they waited for pipelines
  EXPECT_TRUE(gate_->wait_for_one_at_the_gate());
  frames();
  EXPECT_EQ(seen(GetParam()).passes, 0u);
  EXPECT_EQ(seen(GetParam()).pipelines, 0u);
  EXPECT_EQ(work(), before) << "nobody else stands in for it";
  gate_->open();
  frames_until_there_are_passes_of(GetParam());
  frames(3);
  EXPECT_GE(seen(GetParam()).passes, 1u);
  EXPECT_EQ(gate_->asked_here(GetParam()), 0u) << "the rendering thread makes none of them";
  EXPECT_EQ(gate_->asked_elsewhere(GetParam()), seen(GetParam()).pipelines) << "each is made once";
  EXPECT_THAT(log_.lines(), IsEmpty());
}

TEST_P(ReadinessOf, what_goes_while_it_is_compiled_leaves_nothing) {
  const Entity cause = call_for(GetParam());
  frames(2);
  ASSERT_TRUE(gate_->wait_for_one_at_the_gate());
  world_->destroy(cause);
  frames(kFramesKept + 10);
  gate_->open();
  std::this_thread::sleep_for(
      std::chrono::milliseconds(20));  // time for the background thread to make something too late
  frames(2 * kFramesKept);
  EXPECT_EQ(seen(GetParam()).pipelines, 0u);
  EXPECT_EQ(seen(GetParam()).bytes, 0u);
  static_cast<void>(call_for(GetParam()));
  frames();
  frames_until_there_are_passes_of(GetParam());
  EXPECT_EQ(gate_->asked_here(GetParam()), 0u);
}

TEST_P(ReadinessOf, once_ready_its_frames_are_those_of_a_renderer_that_waits) {
  static_cast<void>(call_for(GetParam()));
  frames(2);
  gate_->open();
  frames_until_there_are_passes_of(GetParam());
  frames_until_nothing_is_pending();
  frames(10);
  const std::vector<std::string> background = last_commands();
  make_renderer(Readiness::wait);
  static_cast<void>(call_for(GetParam()));
  frames(10);
  EXPECT_EQ(last_commands(), background);
}

TEST_P(ReadinessOf, toggling_grows_nothing) {
  gate_->open();
  std::string with;
  for (int toggle = 0; toggle < 4; ++toggle) {
    const Entity cause = call_for(GetParam());
    frames();
    frames_until_there_are_passes_of(GetParam());
    frames_until_nothing_is_pending();
    frames(kFramesKept);
    if (toggle == 0) with = belongings();
    EXPECT_EQ(belongings(), with);
    world_->destroy(cause);
    frames(kFramesKept);
    EXPECT_EQ(seen(GetParam()).pipelines, 0u);
    EXPECT_EQ(seen(GetParam()).bytes, 0u);
  }
  EXPECT_EQ(gate_->asked_here(GetParam()), 0u);
}

class ReadinessFrames : public BackgroundRenderer {
 protected:
  /// Whether the last frame used the variant of fog that reduces by this divisor.
  [[nodiscard]] bool reduces_to(const std::string& divisor) {
    return std::ranges::any_of(last_commands(), [&](const std::string& line) {
      return line.find("fog/reduce.frag kDivisor=" + divisor) != std::string::npos;
    });
  }
};

TEST_F(ReadinessFrames, a_renderer_that_waited_stops_waiting_and_names_what_it_makes) {
  gate_->open();
  make_renderer(Readiness::wait);
  static_cast<void>(call_for("fog"));
  frames();
  EXPECT_GE(seen("fog").passes, 1u) << "the first frame has every effect";
  EXPECT_EQ(renderer_->report().pipeline_made, "");
  renderer_->set_readiness(Readiness::background);
  frames();
  EXPECT_GE(seen("fog").passes, 1u);
  gate_->close();
  ASSERT_TRUE(renderer_->knobs().set("fog.resolution", "half").ok());
  frames(3);
  ASSERT_TRUE(gate_->wait_for_one_at_the_gate());
  EXPECT_THAT(renderer_->report().pipeline_made, HasSubstr("fog/"));
  gate_->open();
  frames_until_nothing_is_pending();
  EXPECT_EQ(renderer_->report().pipeline_made, "");
}

TEST_F(ReadinessFrames, values_that_were_set_while_it_waited_stay_when_it_waits_no_longer) {
  gate_->open();
  static_cast<void>(call_for("fog"));
  frames();
  frames_until_there_are_passes_of("fog");
  frames_until_nothing_is_pending();
  renderer_->set_readiness(Readiness::wait);
  ASSERT_TRUE(renderer_->knobs().set("fog.resolution", "half").ok());
  frames();
  EXPECT_TRUE(reduces_to("2"));
  renderer_->set_readiness(Readiness::background);
  frames();
  EXPECT_TRUE(reduces_to("2"));
}

TEST_F(ReadinessFrames, a_module_waits_for_the_last_of_its_pipelines) {
  constexpr std::uint32_t kPipelines = 5;  // of the blur, and two each of the passes that read depth
  static_cast<void>(call_for("fog"));
  frames();
  ASSERT_TRUE(gate_->wait_for_one_at_the_gate());
  for (std::uint32_t made = 0; made < kPipelines; ++made) {
    EXPECT_EQ(seen("fog").pipelines, made);
    EXPECT_EQ(seen("fog").passes, 0u);
    gate_->let(1);
    if (made + 1 == kPipelines) break;
    ASSERT_TRUE(gate_->wait_for_one_at_the_gate());
    frames();
  }
  frames_until_there_are_passes_of("fog");
  EXPECT_EQ(seen("fog").passes, 4u);
}

// Hard case: passes.knob_compiling
TEST_F(ReadinessFrames, a_knob_waits_for_its_pipelines_and_the_old_variant_stays) {
  gate_->open();
  static_cast<void>(call_for("fog"));
  frames();
  frames_until_there_are_passes_of("fog");
  frames_until_nothing_is_pending();
  EXPECT_TRUE(reduces_to("4"));
  gate_->close();
  ASSERT_TRUE(renderer_->knobs().set("fog.resolution", "half").ok());
  frames(5);
  ASSERT_TRUE(gate_->wait_for_one_at_the_gate());
  EXPECT_EQ(seen("fog").passes, 4u) << "the module stays in the frame";
  EXPECT_TRUE(reduces_to("4"));
  gate_->open();
  frames_until_nothing_is_pending();
  frames();
  EXPECT_EQ(seen("fog").passes, 4u);
  EXPECT_TRUE(reduces_to("2"));
  EXPECT_EQ(gate_->asked_here("fog"), 0u);
}

TEST_F(ReadinessFrames, essential_modules_are_in_the_first_frame) {
  frames();
  EXPECT_GE(seen("lighting").passes, 2u);
  EXPECT_GE(seen("engine").passes, 1u);
}

TEST_F(ReadinessFrames, modules_do_not_wait_for_each_other) {
  static_cast<void>(call_for("counting"));
  frames();
  ASSERT_TRUE(gate_->wait_for_one_at_the_gate());
  gate_->let(1);
  static_cast<void>(call_for("fog"));
  frames_until_there_are_passes_of("counting");
  EXPECT_EQ(seen("fog").passes, 0u);
}

TEST_F(ReadinessFrames, shading_is_brute_force_until_the_tiled_pipeline_is_made) {
  static_cast<void>(call_for("lights"));
  frames();
  const std::uint32_t asked_before = gate_->asked_here("lighting");
  ASSERT_TRUE(gate_->wait_for_one_at_the_gate());
  gate_->let(3);  // the pipelines of lights; shading does not read the lists yet
  for (int i = 0; i < 20000 && gate_->asked_elsewhere("lighting") == 0; ++i) {
    frames();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_EQ(gate_->asked_elsewhere("lighting"), 1u);
  frames(3);
  EXPECT_EQ(seen("lights").passes, 3u);  // texels and both searches
  gate_->open();
  frames_until_nothing_is_pending();
  EXPECT_EQ(gate_->asked_here("lighting"), asked_before);
}

TEST_F(ReadinessFrames, a_pipeline_that_fails_is_told_once_and_the_next_frame_returns_the_error) {
  gate_->break_pipeline("fog/blur.frag", {ErrorKind::failed, "the compiler gave up"});
  static_cast<void>(call_for("fog"));
  frames(3);
  EXPECT_THAT(log_.lines(), IsEmpty());
  gate_->open();
  Status status;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (status.ok() && std::chrono::steady_clock::now() < deadline) status = render(*world_, {request()});
  for (int again = 0; again < 3; ++again) {
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().message, "the compiler gave up");
    EXPECT_THAT(log_.lines(), ElementsAre(HasSubstr("fog/blur.frag failed in the background: the compiler gave up")));
    status = render(*world_, {request()});
  }
  gate_->heal();
  frames(2);
  EXPECT_EQ(seen("fog").passes, 4u);
  EXPECT_EQ(log_.lines().size(), 1u);
}

TEST_F(ReadinessFrames, a_failure_is_forgotten_with_the_modules_pipelines) {
  gate_->break_pipeline("counting", {ErrorKind::failed, "the compiler gave up"});
  gate_->open();
  const Entity cause = call_for("counting");
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (render(*world_, {request()}).ok()) ASSERT_LT(std::chrono::steady_clock::now(), deadline);
  world_->destroy(cause);
  gate_->heal();
  frames(kFramesKept);
  const std::uint32_t tried = gate_->asked_here("counting");
  static_cast<void>(call_for("counting"));
  frames();
  frames_until_there_are_passes_of("counting");
  EXPECT_EQ(gate_->asked_here("counting"), tried) << "made in the background, as if nothing had been";
}

/// BackgroundRenderer with the shadows module.
class ShadowReadiness : public BackgroundRenderer {
 protected:
  ShadowReadiness() {
    with_shadows_ = true;
    make_renderer(Readiness::background);
    gate_->close();
  }
  /// Whether the last frame's surfaces were shaded with shadows.
  [[nodiscard]] bool shadowed() const {
    return std::ranges::any_of(last_commands(), [](const std::string& line) {
      return line.find("lighting/opaque/deferred") != std::string::npos &&
             (line.find("shadowed") != std::string::npos || line.find("final") != std::string::npos);
    });
  }
  /// The pipelines of a list of commands, in their order.
  [[nodiscard]] static std::vector<std::string> work_of(const std::vector<std::string>& commands) {
    std::vector<std::string> pipelines;
    for (const std::string& line : commands)
      if (line.starts_with("bind_pipeline")) pipelines.push_back(line);
    return pipelines;
  }
  void frames_until_shadowed() {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!shadowed()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "shadows never came";
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      frames();
    }
  }
};

TEST_F(ShadowReadiness, frames_come_without_shadows_and_then_with_them_and_none_waits) {
  frames(2);
  static_cast<void>(call_for("lights"));
  frames(3);
  const std::uint32_t asked_before = gate_->asked_here("lighting");  // the brute-force pipeline, which frames wait for
  ASSERT_TRUE(gate_->wait_for_one_at_the_gate());
  EXPECT_GT(renderer_->report().pipelines_pending, 0u);
  EXPECT_EQ(seen("shadows").passes, 0u);
  EXPECT_FALSE(shadowed());
  gate_->open();
  frames_until_there_are_passes_of("shadows");
  frames_until_shadowed();
  frames_until_nothing_is_pending();
  for (int i = 0; i < 5; ++i) {
    frames();
    EXPECT_TRUE(shadowed());
    EXPECT_EQ(renderer_->report().pipelines_pending, 0u);
  }
  EXPECT_EQ(gate_->asked_here("shadows"), 0u);
  EXPECT_EQ(gate_->asked_here("lighting"), asked_before) << "no frame made a pipeline itself";
  EXPECT_THAT(log_.lines(), IsEmpty());
}

TEST_F(ShadowReadiness, shadows_stay_while_the_pipeline_of_shorter_lists_is_made) {
  ASSERT_TRUE(renderer_->knobs().set("shadows.mode", "monolithic").ok());
  ASSERT_TRUE(renderer_->knobs().set("lights.fixed_slots", "30").ok());
  std::vector<Entity> lamps;
  for (int i = 0; i < 60; ++i) {  // too many for every list to hold all lamps
    lamps.push_back(call_for("lights"));
    if (i > 0) world_->add(lamps.back(), ShadowCaster{false, 0});
  }
  gate_->open();
  frames();
  frames_until_there_are_passes_of("shadows");
  frames_until_shadowed();
  frames_until_nothing_is_pending();
  gate_->close();
  for (std::size_t i = 1; i < lamps.size(); ++i) world_->destroy(lamps[i]);
  for (int i = 0; i < 5; ++i) {
    frames();
    EXPECT_TRUE(shadowed()) << i;
  }
  EXPECT_EQ(renderer_->report().pipelines_pending, 1u);
  gate_->open();
  frames_until_nothing_is_pending();
  frames();
  EXPECT_TRUE(shadowed());
  EXPECT_EQ(gate_->asked_here("shadows"), 0u);
}

struct KnobStep {
  const char* test;
  const char* knob;
  const char* value;
};

class ShadowsOverKnobSteps : public ShadowReadiness, public ::testing::WithParamInterface<KnobStep> {};
INSTANTIATE_TEST_SUITE_P(Steps, ShadowsOverKnobSteps,
                         ::testing::Values(KnobStep{"another_filter", "shadows.filter", "pcf"},
                                           KnobStep{"a_wider_kernel", "shadows.kernel", "12"},
                                           KnobStep{"visibilities_of_four_bits", "shadows.visibility_bits", "4"},
                                           KnobStep{"without_mips", "shadows.mips", "off"}),
                         [](const auto& instance) { return instance.param.test; });

TEST_P(ShadowsOverKnobSteps, the_old_pipelines_draw_until_the_new_ones_are_made) {
  static_cast<void>(call_for("lights"));
  gate_->open();
  frames();
  frames_until_there_are_passes_of("shadows");
  frames_until_shadowed();
  frames_until_nothing_is_pending();
  frames(2);  // the second one at rest keeps light
  const std::vector<std::string> before = last_commands();
  gate_->close();
  ASSERT_TRUE(renderer_->knobs().set(GetParam().knob, GetParam().value).ok());
  for (int i = 0; i < 5; ++i) {
    frames();
    EXPECT_EQ(work_of(last_commands()), work_of(before)) << i;
  }
  EXPECT_GT(renderer_->report().pipelines_pending, 0u);
  gate_->open();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (renderer_->report().pipelines_pending > 0 && std::chrono::steady_clock::now() < deadline) {
    frames();
    EXPECT_TRUE(shadowed());
  }
  frames(2);
  EXPECT_TRUE(shadowed());
  EXPECT_NE(work_of(last_commands()), work_of(before));
  EXPECT_EQ(gate_->asked_here("shadows"), 0u);
}

class BackgroundPipelines : public ::testing::Test {
 protected:
  /// Descriptions with different first letters differ in a constant.
  [[nodiscard]] static gpu::ComputePipelineDesc desc(const std::string& name, std::string module = "test") {
    return {name, std::move(module), {}, {{"kNumber", static_cast<std::uint32_t>(name.front())}}};
  }
  [[nodiscard]] static PipelineList list(const std::vector<std::string>& names) {
    PipelineList list;
    for (const std::string& name : names) list.push_back(desc(name));
    return list;
  }
  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  test::GatedDevice gate_{*device_};
  test::LineLog log_;
};

TEST_F(BackgroundPipelines, are_ready_when_all_are_made_and_begun_once) {
  gate_.close();
  Pipelines pipelines(gate_);
  EXPECT_TRUE(pipelines.request({}, log_));
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(pipelines.request(list({"a", "b", "c"}), log_));
  ASSERT_TRUE(gate_.wait_for_one_at_the_gate());
  gate_.let(2);
  ASSERT_TRUE(gate_.wait_for_one_at_the_gate());
  EXPECT_TRUE(pipelines.request(list({"b", "a"}), log_));
  EXPECT_FALSE(pipelines.request(list({"a", "b", "c"}), log_));
  EXPECT_FALSE(pipelines.find(desc("c")));
  gate_.open();
  while (!pipelines.request(list({"a", "b", "c"}), log_)) std::this_thread::yield();
  EXPECT_TRUE(pipelines.find(desc("c")));
  EXPECT_EQ(gate_.asked_elsewhere("test"), 3u);
  EXPECT_EQ(gate_.asked_here("test"), 0u);
}

TEST_F(BackgroundPipelines, that_are_released_before_their_turn_are_not_made) {
  gate_.close();
  Pipelines pipelines(gate_);
  EXPECT_FALSE(pipelines.request(list({"a", "b", "c"}), log_));
  ASSERT_TRUE(gate_.wait_for_one_at_the_gate());
  pipelines.release("test");
  EXPECT_FALSE(pipelines.request({desc("z", "other")}, log_));
  gate_.open();
  while (!pipelines.find(desc("z", "other"))) std::this_thread::yield();
  EXPECT_FALSE(pipelines.find(desc("b")));
  EXPECT_FALSE(pipelines.find(desc("c")));
  EXPECT_EQ(gate_.asked_elsewhere("test"), 1u);
  EXPECT_FALSE(pipelines.request(list({"b"}), log_)) << "they can be asked for again";
  while (!pipelines.request(list({"b"}), log_)) std::this_thread::yield();
}

TEST_F(BackgroundPipelines, are_also_had_at_once_by_who_cannot_wait) {
  gate_.close();
  {
    Pipelines pipelines(gate_);
    EXPECT_FALSE(pipelines.request(list({"a"}), log_));
    ASSERT_TRUE(gate_.wait_for_one_at_the_gate());
    const auto mine = pipelines.get(desc("a"));
    ASSERT_TRUE(mine.ok());
    EXPECT_TRUE(pipelines.request(list({"a"}), log_));
    gate_.open();
    EXPECT_EQ(*pipelines.get(desc("a")), *mine);
  }
  EXPECT_EQ(device_->pipeline_count("test"), 0u);
  EXPECT_THAT(device_->faults(), IsEmpty());
}

}  // namespace
}  // namespace gloam
