// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/shader_pass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/render/renderer.h"
#include "shaders/gpu_test/shaders.h"
#include "shaders/lights/shaders.h"
#include "shaders/render/shaders.h"
#include "tests/support/expect_assert.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace code = shaders::gpu_test;

/// Adds passes by a function, in PassPhase::lists.
class PassingModule final : public Module {
 public:
  explicit PassingModule(std::function<void(FrameBuilder&)> add) : add_(std::move(add)) {}
  [[nodiscard]] std::string_view name() const override { return "passing"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::lists) add_(frame);
  }

 private:
  std::function<void(FrameBuilder&)> add_;
};

class DeclaredPass : public ::testing::Test {
 protected:
  /// Draws one frame on the recording device with the passes that `add` declares.
  Status render(std::function<void(FrameBuilder&)> add) {
    RendererOptions options;
    options.device = device_.get();
    options.executor = executor_.get();
    options.modules.push_back(std::make_unique<PassingModule>(std::move(add)));
    const auto renderer = Renderer::create(std::move(options)).value();
    World world;
    renderer->prepare_world(world);
    ViewRequest view;
    view.settings = test::look_at(dvec3(0.0, 0.0, 5.0), dvec3(0.0), 48, 27);
    return renderer->render(world, {&view, 1});
  }
  /// The texts of the commands of one kind between the label of the pass "tested" and its end.
  [[nodiscard]] std::vector<std::string> commands(std::string_view name) const {
    std::vector<std::string> texts;
    bool inside = false;
    for (const gpu::RecordedCommand& command : device_->commands()) {
      if (command.name == "begin_label") inside = command.text.find("tested") != std::string::npos;
      if (command.name == "end_label") inside = false;
      if (inside && command.name == name) texts.push_back(command.text);
    }
    return texts;
  }
  void expect_no_faults() const { EXPECT_THAT(device_->faults(), IsEmpty()); }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  std::unique_ptr<JobExecutor> executor_ = make_serial_executor();
};

BufferRef buffer_of(FrameBuilder& frame, const char* name, std::uint64_t bytes) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = "passing";
  desc.size = bytes;
  return frame.graph().create_buffer(desc);
}

/// A buffer that a pass has filled.
BufferRef filled_buffer(FrameBuilder& frame) {
  PassBuilder pass = frame.graph().add_pass("fill", frame.module());
  const BufferRef filled = pass.write(buffer_of(frame, "filled", 1024), gpu::Access::transfer_write);
  pass.execute([filled](PassContext& context) { context.commands().fill_buffer(context.buffer(filled), 0, 1024, 0); });
  return filled;
}

/// A whole declaration of double_numbers.comp, which the tests below spoil.
void declare_doubling(FrameBuilder& frame, const std::function<void(ComputePass&)>& spoil = {}) {
  const BufferRef source = filled_buffer(frame);
  ComputePass pass(frame, "tested", code::double_numbers_comp);
  pass.keep();
  pass.read("source", source);
  pass.uniform("uniforms", std::uint32_t{3});
  pass.push(std::uint32_t{100});
  static_cast<void>(pass.write("target", buffer_of(frame, "doubled", 1024)));
  if (spoil) spoil(pass);
  pass.dispatch_over(100);
}

TEST_F(DeclaredPass, binds_resources_at_the_numbers_of_the_shader) {
  ASSERT_TRUE(render([](FrameBuilder& frame) { declare_doubling(frame); }).ok());
  expect_no_faults();
  ASSERT_EQ(commands("bind").size(), 1u);
  EXPECT_THAT(commands("bind")[0], HasSubstr("0='filled'"));
  EXPECT_THAT(commands("bind")[0], HasSubstr("1='doubled'"));
  EXPECT_THAT(commands("bind")[0], HasSubstr("2="));
}

TEST_F(DeclaredPass, dispatches_as_many_workgroups_as_the_items_need) {
  ASSERT_TRUE(render([](FrameBuilder& frame) {
                declare_doubling(frame, [](ComputePass& pass) {
                  for (const std::uint32_t items : {0u, 1u, 64u, 65u, 0xFFFFFFFFu}) pass.dispatch_over(items);
                });
              }).ok());
  EXPECT_THAT(commands("dispatch"), ElementsAre("dispatch 0 1 1", "dispatch 1 1 1", "dispatch 1 1 1", "dispatch 2 1 1",
                                                "dispatch 67108864 1 1", "dispatch 2 1 1"));
}

TEST_F(DeclaredPass, workgroup_sizes_follow_specialisation_constants) {
  ASSERT_TRUE(render([](FrameBuilder& frame) {
                ComputePass pass(frame, "tested", {shaders::lights::find_lights_accurate_comp, {{"local_size_y", 4u}}});
                pass.keep();
                for (const char* name : {"depth_image", "light_texels", "depth_bounds"}) pass.read(name, ImageRef{});
                for (const char* name : {"lights", "grid", "group_masks"}) pass.read(name, BufferRef{});
                const auto made = create_view_image(frame, "lists", gpu::Format::rg32_uint);
                static_cast<void>(pass.write("tile_lists", made));
                for (const char* name : {"early_lists", "counters"})
                  static_cast<void>(pass.write(name, buffer_of(frame, name, 4096)));
                pass.dispatch_over(uvec2(8, 9));
              }).ok());
  EXPECT_THAT(commands("dispatch"), ElementsAre("dispatch 1 3 1"));
}

TEST_F(DeclaredPass, a_binding_stays_until_its_name_is_bound_again) {
  ASSERT_TRUE(render([](FrameBuilder& frame) {
                BufferRef target = buffer_of(frame, "halves", 1024);
                declare_doubling(frame, [&](ComputePass& pass) {
                  pass.dispatch(1);
                  target = pass.write_part("target", target, 256, 512);
                  pass.dispatch(1);
                });
              }).ok());
  expect_no_faults();
  const std::vector<std::string> binds = commands("bind");
  ASSERT_EQ(binds.size(), 3u);
  EXPECT_THAT(binds[0], HasSubstr("1='doubled'"));
  EXPECT_THAT(binds[1], HasSubstr("1='halves'+256:512"));
  for (const std::string& bind : binds) EXPECT_THAT(bind, HasSubstr("0='filled'"));
}

TEST_F(DeclaredPass, a_barrier_covers_what_the_pass_has_written) {
  ASSERT_TRUE(render([](FrameBuilder& frame) {
                declare_doubling(frame, [](ComputePass& pass) {
                  pass.dispatch(1);
                  pass.barrier();
                });
              }).ok());
  expect_no_faults();
  const std::vector<std::string> barriers = commands("barrier");
  ASSERT_FALSE(barriers.empty());
  EXPECT_THAT(barriers.back(), HasSubstr("doubled"));
  EXPECT_THAT(barriers.back(), ::testing::Not(HasSubstr("filled")));
}

TEST_F(DeclaredPass, a_missing_resource_becomes_a_placeholder) {
  ASSERT_TRUE(render([](FrameBuilder& frame) {
                declare_doubling(frame, [](ComputePass& pass) {
                  pass.read("source", BufferRef{});
                  pass.read("uniforms", gpu::Binding::BufferRange{});
                });
              }).ok());
  expect_no_faults();
  EXPECT_THAT(commands("bind")[0], HasSubstr("0='placeholder'"));
  EXPECT_THAT(commands("bind")[0], HasSubstr("2='placeholder'"));
}

TEST_F(DeclaredPass, a_missing_image_becomes_a_placeholder_of_the_shape_that_the_shader_declares) {
  ASSERT_TRUE(render([](FrameBuilder& frame) {
                ComputePass pass(frame, "tested", code::look_comp);
                pass.keep();
                pass.push(vec3(0.0f));
                for (const char* name : {"plane", "layers", "cube", "cubes"}) pass.read(name, ImageRef{});
                static_cast<void>(pass.write("seen", buffer_of(frame, "seen", 64)));
                pass.dispatch(1);
              }).ok());
  expect_no_faults();
  EXPECT_EQ(commands("dispatch").size(), 1u);
}

TEST_F(DeclaredPass, a_missing_volume_becomes_a_placeholder_of_three_dimensions) {
  ASSERT_TRUE(render([](FrameBuilder& frame) {
                ComputePass pass(frame, "tested", code::look_into_volume_comp);
                pass.keep();
                pass.read("volume", ImageRef{});
                pass.read("positions", BufferRef{});
                static_cast<void>(pass.write("seen", buffer_of(frame, "seen", 64)));
                pass.dispatch(1);
              }).ok());
  expect_no_faults();
  EXPECT_EQ(commands("dispatch").size(), 1u);
}

struct Misuse {
  const char* sentence;
  std::function<void(FrameBuilder&, ComputePass&)> spoil;
};

// Hard case: passes.wrong_binding
TEST_F(DeclaredPass, misuse_asserts_with_pass_shader_and_binding) {
  const Misuse misuses[] = {
      {"pass 'tested', shader 'gpu_test/double_numbers.comp', binding 'sauce': the shader declares no binding",
       [](FrameBuilder&, ComputePass& pass) { pass.read("sauce", BufferRef{}); }},
      {"binding 'source': the shader declares it readonly",
       [](FrameBuilder& frame, ComputePass& pass) {
         static_cast<void>(pass.write("source", buffer_of(frame, "b", 64)));
       }},
      {"binding 'uniforms': is a uniform buffer and cannot be written",
       [](FrameBuilder& frame, ComputePass& pass) {
         static_cast<void>(pass.write("uniforms", buffer_of(frame, "b", 64)));
       }},
      {"binding 'source': is a storage buffer, not an image",
       [](FrameBuilder&, ComputePass& pass) { pass.read("source", ImageRef{}); }},
      {"declares 4 bytes of push constants, and 0 were given",
       [](FrameBuilder&, ComputePass& pass) { pass.push_bytes({}); }},
      {"pass 'tested', shader 'gpu_test/double_numbers.comp', constant 'kStale': the program has no specialisation "
       "constant of this name",
       [](FrameBuilder&, ComputePass& pass) {
         pass.use({code::double_numbers_comp, {{"kStale", 1u}}});
       }},
      {"constant 'kScale': the shader declares it as uint, and the value is of type int",
       [](FrameBuilder&, ComputePass& pass) {
         pass.use({code::double_numbers_comp, {{"kScale", 1}}});
       }},
      {"shader 'gpu_test/look.comp', binding 'plane': nothing was bound to it", [](FrameBuilder&, ComputePass& pass) {
         pass.push(vec3(0.0f));
         pass.use({code::look_comp});
       }}};
  for (const Misuse& misuse : misuses) {
    device_ = gpu::make_recording_device();  // a failed assertion leaves a frame begun
    EXPECT_ASSERT((void)render([&](FrameBuilder& frame) {
                    declare_doubling(frame, [&](ComputePass& pass) { misuse.spoil(frame, pass); });
                  }),
                  misuse.sentence);
  }
}

TEST_F(DeclaredPass, a_constant_of_a_draw_must_be_in_one_of_its_shaders) {
  const auto declare = [](FrameBuilder& frame, const gpu::SpecConstants& constants) {
    DrawPass pass(frame, "tested", {.fragment = shaders::render::debug_view_frag, .constants = constants});
  };
  EXPECT_ASSERT((void)render([&](FrameBuilder& frame) {
                  declare(frame, {{"kEncoding", 1u}});
                }),
                "pass 'tested', shader 'render/debug_view.frag', constant 'kEncoding': the program has no");
  device_ = gpu::make_recording_device();  // a failed assertion leaves a frame begun
  gpu::SpecConstants shared = {{"kEncode", 1u}};
  shared.set_if_present("kEncoding", 1u);
  EXPECT_TRUE(render([&](FrameBuilder& frame) { declare(frame, shared); }).ok());
}

TEST_F(DeclaredPass, an_image_that_the_shader_may_write_cannot_be_bound_for_reading) {
  EXPECT_ASSERT((void)render([&](FrameBuilder& frame) {
                  ComputePass pass(frame, "tested", code::halve_comp);
                  pass.read("below", create_view_image(frame, "image", gpu::Format::r32_float));
                }),
                "binding 'below': the shader may write this image");
}

TEST_F(DeclaredPass, a_draw_needs_targets_first) {
  EXPECT_ASSERT((void)render([&](FrameBuilder& frame) {
                  DrawPass pass(frame, "tested", {shaders::render::debug_view_frag});
                  read_geometry(pass, frame.get<GeometryOutputs>());
                  pass.draw_triangle();
                }),
                "targets must be declared before the first draw");
}

TEST_F(DeclaredPass, a_program_that_writes_depth_needs_a_depth_target) {
  EXPECT_ASSERT((void)render([&](FrameBuilder& frame) {
                  DrawPass pass(frame, "tested", {.fragment = shaders::render::debug_view_frag, .depth_write = true});
                  static_cast<void>(pass.target(create_view_image(frame, "shown", gpu::Format::rgba8_unorm)));
                  pass.test_depth(frame.get<GeometryOutputs>().depth);
                  read_geometry(pass, frame.get<GeometryOutputs>());
                  pass.draw_triangle();
                }),
                "a program that writes depth needs a depth target");
}

TEST_F(DeclaredPass, binds_the_view_constants_by_itself) {
  ASSERT_TRUE(render([&](FrameBuilder& frame) {
                DrawPass pass(frame, "tested", {shaders::render::debug_view_frag});
                static_cast<void>(pass.target(create_view_image(frame, "shown", gpu::Format::rgba8_unorm)));
                pass.keep();
                read_geometry(pass, frame.get<GeometryOutputs>());
                pass.draw_triangle();
              }).ok());
  expect_no_faults();
  EXPECT_THAT(commands("bind")[0], HasSubstr("0="));
  EXPECT_THAT(commands("draw"), ElementsAre(HasSubstr("3")));
}

TEST_F(DeclaredPass, a_pipeline_that_cannot_be_made_gives_the_frame_up_with_its_sentence) {
  const Status status = render([&](FrameBuilder& frame) {
    device_->fail_next_creation({ErrorKind::failed, "no memory for pipelines"});
    BufferRef doubled;
    {
      const BufferRef source = filled_buffer(frame);
      ComputePass pass(frame, "tested", code::double_numbers_comp);
      pass.read("source", source);
      doubled = pass.write("target", buffer_of(frame, "doubled", 1024));
      pass.uniform("uniforms", std::uint32_t{3});
      pass.push(std::uint32_t{100});
      pass.dispatch_over(100);
    }
    // A later pass that reads the result declares as always.
    ComputePass later(frame, "later", code::double_numbers_comp);
    later.read("source", doubled);
  });
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "no memory for pipelines");
}

TEST_F(DeclaredPass, the_first_error_of_a_frame_counts) {
  const Status status = render([&](FrameBuilder& frame) {
    frame.fail({ErrorKind::failed, "first"});
    frame.fail({ErrorKind::input, "second"});
  });
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "first");
}

}  // namespace
}  // namespace gloam
