// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/visualizer_pass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/recording_device.h"
#include "engine/render/renderer.h"
#include "shaders/render/shaders.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Draws one visualizer, called "heat", with a push constant or without.
class HeatModule final : public Module {
 public:
  explicit HeatModule(bool constants) : constants_(constants) {}
  [[nodiscard]] std::string_view name() const override { return "heat"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  [[nodiscard]] Status add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::post) return {};
    const TargetOutput& target = frame.get<TargetOutput>();
    gpu::GraphicsPipelineDesc desc =
        fullscreen_pipeline("heat_view", "heat", shaders::render::debug_view_frag, target.format);
    desc.color_formats.push_back(gpu::Format::r32_float);
    auto pipeline = frame.services().pipelines.get(desc);
    if (!pipeline.ok()) return pipeline.error();
    PassBuilder pass = frame.graph().add_pass("heat_view", "heat");
    const ImageRef before = target.color;
    const VisualizerTargets targets = write_visualizer_targets(frame, pass, "heat", "heat", gpu::Format::r32_float);
    EXPECT_EQ(target.color.resource, before.resource);
    EXPECT_EQ(frame.graph().desc(targets.values).width, frame.view().width);
    EXPECT_EQ(frame.graph().desc(targets.values).height, frame.view().height);
    pass.execute([&frame, targets, push = constants_, pipeline = *pipeline](PassContext& context) {
      const std::uint32_t count = 7;
      const gpu::Binding bindings[] = {frame.view_binding()};
      record_visualizer(context, frame.view(), targets, pipeline, bindings,
                        push ? std::as_bytes(std::span(&count, 1)) : std::span<const std::byte>());
    });
    return {};
  }

 private:
  bool constants_;
};

/// The commands of the pass "heat_view" of one frame: from begin_rendering to end_rendering.
std::vector<gpu::RecordedCommand> heat_commands(bool constants) {
  const auto device = gpu::make_recording_device();
  const auto executor = make_serial_executor();
  std::vector<gpu::RecordedCommand> found;
  {
    RendererOptions options;
    options.device = device.get();
    options.executor = executor.get();
    options.modules.push_back(std::make_unique<HeatModule>(constants));
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
      if (inside) found.push_back(command);
      if (command.name == "end_rendering") inside = false;
    }
  }
  EXPECT_THAT(device->faults(), ::testing::IsEmpty());
  return found;
}

std::vector<std::string> names_of(const std::vector<gpu::RecordedCommand>& commands) {
  std::vector<std::string> names;
  for (const gpu::RecordedCommand& command : commands) names.push_back(command.name);
  return names;
}

TEST(VisualizerPass, draws_one_triangle_over_all_of_the_picture_and_its_values) {
  const auto commands = heat_commands(true);
  ASSERT_THAT(names_of(commands), ElementsAre("begin_rendering", "set_viewport", "set_scissor", "bind_pipeline", "bind",
                                              "push_constants", "draw", "end_rendering"));
  EXPECT_THAT(commands[0].text, HasSubstr("48"));
  EXPECT_THAT(commands[0].text, HasSubstr("27"));
  EXPECT_THAT(commands[0].text, ::testing::ContainsRegex("color 'picture' color 'heat'"));
  EXPECT_THAT(commands[5].text, HasSubstr("4 bytes"));
  EXPECT_THAT(commands[6].text, HasSubstr("3"));
}

TEST(VisualizerPass, pushes_nothing_without_constants) {
  EXPECT_THAT(names_of(heat_commands(false)), ElementsAre("begin_rendering", "set_viewport", "set_scissor",
                                                          "bind_pipeline", "bind", "draw", "end_rendering"));
}

}  // namespace
}  // namespace gloam
