// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/visualizer_pass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(VisualizerPass, exposes_its_values) { EXPECT_THAT(draw_heat().exposed, ::testing::Contains("heat")); }

}  // namespace
}  // namespace gloam
