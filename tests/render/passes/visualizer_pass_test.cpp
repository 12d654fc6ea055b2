// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/visualizer_pass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/renderer.h"
#include "shaders/render/shaders.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Draws one visualizer, whose values are called "heat".
class HeatModule final : public Module {
 public:
  explicit HeatModule(std::vector<std::string>& exposed) : exposed_(exposed) {}
  [[nodiscard]] std::string_view name() const override { return "heat"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::post) return;
    DrawPass pass(frame, "heat_view", {shaders::render::debug_view_frag});
    read_geometry(pass, frame.get<GeometryOutputs>());
    const ImageRef before = frame.get<TargetOutput>().color;
    add_visualizer_targets(frame, pass, "heat", gpu::Format::r32_float);
    const ImageRef after = frame.get<TargetOutput>().color;
    EXPECT_EQ(after.resource, before.resource);
    EXPECT_GT(after.version, before.version);
    pass.draw_triangle();
    exposed_.clear();
    for (const FrameBuilder::Exposed& image : frame.exposed()) {
      exposed_.push_back(image.name);
      if (image.name != "heat") continue;
      const gpu::ImageDesc& desc = frame.graph().desc(image.image);
      EXPECT_EQ(desc.width, frame.view().width);
      EXPECT_EQ(desc.height, frame.view().height);
      EXPECT_EQ(desc.format, gpu::Format::r32_float);
    }
  }

 private:
  std::vector<std::string>& exposed_;
};

/// One frame with the visualizer.
struct HeatFrame {
  std::vector<gpu::RecordedCommand> commands;  ///< of the pass "heat_view": from begin_rendering to end_rendering
  std::vector<std::string> exposed;            ///< names of the images that the frame exposes
};

HeatFrame draw_heat() {
  const auto device = gpu::make_recording_device();
  const auto executor = make_serial_executor();
  HeatFrame frame;
  {
    RendererOptions options;
    options.device = device.get();
    options.executor = executor.get();
    options.modules.push_back(std::make_unique<HeatModule>(frame.exposed));
    const auto renderer = Renderer::create(std::move(options)).value();
    World world;
    renderer->prepare_world(world);
    ViewRequest view;
    view.settings = test::look_at(dvec3(0.0, 0.0, 5.0), dvec3(0.0), 48, 27);
    const Status status = renderer->render(world, {&view, 1});
    EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
    bool inside = false;
    for (const gpu::RecordedCommand& command : device->commands()) {
      if (command.name == "begin_rendering" && command.text.find("'heat'") != std::string::npos) inside = true;
      if (inside) frame.commands.push_back(command);
      if (command.name == "end_rendering") inside = false;
    }
  }
  EXPECT_THAT(device->faults(), ::testing::IsEmpty());
  return frame;
}

TEST(VisualizerPass, draws_one_triangle_over_all_of_the_picture_and_its_values) {
  const auto commands = draw_heat().commands;
  std::vector<std::string> names;
  for (const gpu::RecordedCommand& command : commands) names.push_back(command.name);
  ASSERT_THAT(names, ElementsAre("begin_rendering", "set_viewport", "set_scissor", "bind_pipeline", "bind", "draw",
                                 "end_rendering"));
  EXPECT_THAT(commands[0].text, HasSubstr("48"));
  EXPECT_THAT(commands[0].text, HasSubstr("27"));
  EXPECT_THAT(commands[0].text, ::testing::ContainsRegex("color 'picture' color 'heat'"));
  EXPECT_THAT(commands[5].text, HasSubstr("3"));
}

/// "0@0.00 6@0.20 …": the ticks and their places.
std::string ticks_text(const HeatScale& scale, float range) {
  std::string text;
  for (const HeatTick& tick : heat_ticks(scale, range)) {
    char place[16];
    std::snprintf(place, sizeof(place), "@%.2f ", tick.share);
    text += tick.text + place;
  }
  return text;
}

TEST(HeatTicks, of_measures_are_at_the_stops_of_the_colours) {
  EXPECT_EQ(ticks_text({.most = 1.0}, 1.0f), "0@0.00 0.2@0.20 0.4@0.40 0.6@0.60 0.8@0.80 1@1.00 ");
  EXPECT_EQ(ticks_text({.most = 5.0, .unit = "cd"}, 0.5f), "0@0.00 0.5@0.20 1@0.40 1.5@0.60 2@0.80 2.5 cd@1.00 ");
}

TEST(HeatTicks, of_counts_are_whole_numbers_where_the_colours_have_them) {
  EXPECT_EQ(ticks_text({.most = 30.0, .counts = true}, 1.0f), "0@0.00 6@0.20 12@0.40 18@0.60 24@0.80 30@1.00 ");
  EXPECT_EQ(ticks_text({.most = 31.0, .counts = true}, 1.0f), "0@0.00 7@0.23 14@0.45 21@0.68 28@0.90 ");
  EXPECT_EQ(ticks_text({.most = 31.0, .unit = "lights", .counts = true}, 5.0f / 31.0f),
            "0@0.00 1@0.20 2@0.40 3@0.60 4@0.80 5 lights@1.00 ");
  EXPECT_EQ(ticks_text({.most = 31.0, .counts = true}, 1.0f / 16.0f), "0@0.00 1@0.52 ") << "of an end at 1.9";
  EXPECT_EQ(ticks_text({.most = 5.0, .counts = true}, 1.0f / 16.0f), "0@0.00 ") << "of an end at 0.3";
}

// The range is a float: a step must not become the next whole number, or the last tick be lost, by its rounding.
TEST(HeatTicks, of_counts_have_the_end_for_every_multiple_of_5) {
  for (const double most : {5.0, 10.0, 31.0, 63.0})
    for (int end = 5; end <= 100'000; end += end < 1000 ? 5 : 5000) {
      const auto ticks = heat_ticks({.most = most, .counts = true}, static_cast<float>(end / most));
      ASSERT_EQ(ticks.size(), 6u) << end << " of " << most;
      EXPECT_EQ(ticks.back().text, std::to_string(end));
      EXPECT_NEAR(ticks.back().share, 1.0, 1e-5);
    }
}

TEST(VisualizerPass, exposes_its_values) { EXPECT_THAT(draw_heat().exposed, ::testing::Contains("heat")); }

}  // namespace
}  // namespace gloam
