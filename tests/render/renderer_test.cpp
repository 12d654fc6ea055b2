// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/gpu/recording/device.h"
#include "engine/render/frame_builder.h"
#include "engine/scene/gltf/import.h"
#include "modules/module_list/module_list.h"
#include "tests/render/draws/small_scene.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;

constexpr std::uint32_t kFramesForRelease =
    125;  // more than the 120 frames for which a module without demand keeps its memory

/// A renderer with all modules on a recording device. Any fault that the device finds fails the test.
class RendererTest : public ::testing::Test {
 protected:
  RendererTest() {
    RendererOptions options;
    options.device = device_.get();
    options.executor = executor_.get();
    options.modules = make_all_modules();
    renderer_ = Renderer::create(std::move(options)).value();
    renderer_->prepare_world(world_);
  }
  void TearDown() override {
    renderer_.reset();
    EXPECT_THAT(device_->faults(), ::testing::IsEmpty());
  }

  [[nodiscard]] static ViewRequest request(std::uint32_t id = 0, std::uint32_t width = 64, std::uint32_t height = 40) {
    ViewRequest request;
    request.settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), width, height);
    request.settings.id = ViewId{id};
    return request;
  }
  [[nodiscard]] Status render(const std::vector<ViewRequest>& requests) { return renderer_->render(world_, requests); }
  void render_frames(const std::vector<ViewRequest>& requests, std::uint32_t count = 1) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const Status status = render(requests);
      ASSERT_TRUE(status.ok()) << status.error().message;
    }
  }
  [[nodiscard]] ModuleState state_of(std::string_view name) {
    for (const ModuleState& state : renderer_->report().modules)
      if (state.name == name) return state;
    ADD_FAILURE() << "there is no module " << name;
    return {};
  }
  [[nodiscard]] std::set<std::string> modules_with_passes() {
    std::set<std::string> modules;
    for (const PassTime& pass : renderer_->report().passes) modules.insert(pass.module);
    return modules;
  }
  [[nodiscard]] std::uint32_t commands(std::string_view name) {
    std::uint32_t count = 0;
    for (const gpu::RecordedCommand& command : device_->commands()) count += command.name == name ? 1 : 0;
    return count;
  }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  std::unique_ptr<JobExecutor> executor_ = make_shuffled_executor(3);
  std::unique_ptr<Renderer> renderer_;
  World world_;
};

TEST_F(RendererTest, five_frames_of_a_small_scene_break_no_rule) {
  test::fill_small_scene(world_);
  const std::vector<Entity> lights = test::add_lights(world_);
  for (int frame = 0; frame < 5; ++frame) {
    world_.get<WorldTransform>(lights[0]).matrix[3].x += 0.5;
    render_frames({request()});
  }
  ASSERT_TRUE(renderer_->wait().ok());
  const FrameReport report = renderer_->report();
  EXPECT_GE(report.counters.at("engine.draws"), 8.0);
  EXPECT_EQ(report.counters.at("lights.visible"), 2.0);
  std::set<std::string> passes;
  for (const PassTime& pass : report.passes) passes.insert(pass.name);
  for (const char* name : {"deform", "geometry", "depth_bounds", "find_lights_approx", "find_lights_accurate",
                           "deferred", "forward", "tone_map"})
    EXPECT_TRUE(passes.contains(name)) << name;
}

/// Puts another image into LitOutput or TargetOutput.
class ReplacingModule final : public Module {
 public:
  explicit ReplacingModule(bool lit, gpu::Format format, std::uint32_t divisor)
      : lit_(lit), format_(format), divisor_(divisor) {}
  [[nodiscard]] std::string_view name() const override { return "replacing"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::post) return;
    PassBuilder pass = frame.graph().add_pass("replace", "replacing");
    const ImageRef other = pass.write(create_view_image(frame, "other", format_, divisor_), gpu::Access::color_target);
    pass.execute([](PassContext&) {});
    (lit_ ? frame.get<LitOutput>().color : frame.get<TargetOutput>().color) = other;
  }

 private:
  bool lit_;
  gpu::Format format_;
  std::uint32_t divisor_;
};

/// A renderer with one module, on a recording device.
struct OneModule {
  explicit OneModule(std::unique_ptr<Module> module) {
    RendererOptions options;
    options.device = device.get();
    options.executor = executor.get();
    options.modules.push_back(std::move(module));
    renderer = Renderer::create(std::move(options)).value();
    renderer->prepare_world(world);
  }
  [[nodiscard]] Status render() {
    ViewRequest view;
    view.settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 64, 40);
    return renderer->render(world, {&view, 1});
  }

  std::unique_ptr<gpu::RecordingDevice> device = gpu::make_recording_device();
  std::unique_ptr<JobExecutor> executor = make_shuffled_executor(3);
  std::unique_ptr<Renderer> renderer;
  World world;
};

TEST(RendererOutputs, light_may_move_to_an_image_of_the_same_size_and_format) {
  OneModule moved(std::make_unique<ReplacingModule>(true, gpu::Format::rgba16_float, 1));
  ASSERT_TRUE(moved.render().ok());
  EXPECT_TRUE(moved.renderer->read_linear(ViewId{0}).ok());
  EXPECT_THAT(moved.device->faults(), ::testing::IsEmpty());
  OneModule smaller(std::make_unique<ReplacingModule>(true, gpu::Format::rgba16_float, 2));
  EXPECT_ASSERT((void)smaller.render(), "of the same size and format");
  OneModule wider(std::make_unique<ReplacingModule>(true, gpu::Format::rgba32_float, 1));
  EXPECT_ASSERT((void)wider.render(), "of the same size and format");
}

TEST(RendererOutputs, the_picture_is_written_in_place_and_never_replaced) {
  OneModule replaced(std::make_unique<ReplacingModule>(false, gpu::Format::rgba8_srgb, 1));
  EXPECT_ASSERT((void)replaced.render(), "TargetOutput is written in place");
}

TEST_F(RendererTest, an_empty_world_and_no_view_at_all_are_frames_too) {
  render_frames({});
  render_frames({request()}, 3);
  render_frames({});
  EXPECT_EQ(commands("draw_indexed"), 0u);
}

TEST_F(RendererTest, modules_nobody_demands_have_no_passes_pipelines_or_bytes) {
  test::fill_small_scene(world_);
  render_frames({request()}, 3);
  ASSERT_TRUE(renderer_->wait().ok());
  std::uint32_t idle = 0;
  for (const ModuleState& state : renderer_->report().modules) {
    if (state.demanded) continue;
    ++idle;
    EXPECT_EQ(state.pipelines, 0u) << state.name;
    EXPECT_EQ(state.gpu_bytes, 0u) << state.name;
    EXPECT_FALSE(modules_with_passes().contains(state.name)) << state.name;
    EXPECT_FALSE(state.reason.empty()) << state.name << " does not say why";
  }
  EXPECT_GE(idle, 1u);
  EXPECT_FALSE(state_of("lights").demanded);
  EXPECT_TRUE(state_of("lighting").demanded);
  EXPECT_TRUE(state_of("engine").demanded);
}

TEST_F(RendererTest, a_module_comes_with_its_demand_and_goes_after_it) {
  test::fill_small_scene(world_);
  const std::vector<Entity> lights = test::add_lights(world_);
  render_frames({request()}, 2);
  EXPECT_TRUE(state_of("lights").demanded);
  EXPECT_GT(state_of("lights").pipelines, 0u);
  for (const Entity light : lights) world_.destroy(light);
  render_frames({request()}, kFramesForRelease);
  EXPECT_FALSE(state_of("lights").demanded);
  EXPECT_EQ(state_of("lights").pipelines, 0u);
  EXPECT_EQ(state_of("lights").gpu_bytes, 0u);
  EXPECT_FALSE(modules_with_passes().contains("lights"));
  test::add_lights(world_);
  render_frames({request()}, 2);
  EXPECT_GT(state_of("lights").pipelines, 0u);
}

TEST_F(RendererTest, frames_alike_make_nothing_anew) {
  test::fill_small_scene(world_);
  test::add_lights(world_);
  render_frames({request()}, 4);
  const auto bytes = [&] {
    std::uint64_t sum = 0;
    for (const gpu::ModuleMemory& m : device_->memory()) sum += m.bytes;
    return sum;
  };
  const std::uint64_t before = bytes();
  const std::uint32_t pipelines = state_of("engine").pipelines;
  device_->forget_commands();
  render_frames({request()}, 4);
  EXPECT_EQ(bytes(), before);
  EXPECT_EQ(state_of("engine").pipelines, pipelines);
  EXPECT_EQ(commands("copy_buffer_to_image"), 4u)
      << "textures are uploaded once; a frame says how its lights cast shadows";
  EXPECT_EQ(commands("copy_buffer"), 12u)
      << "meshes are uploaded once; a frame copies what its lights, their shadows and its kept light counted";
}

TEST_F(RendererTest, changed_assets_are_uploaded_again) {
  test::fill_small_scene(world_);
  render_frames({request()}, 2);
  test::SceneMaker scene(world_);
  scene.draw(scene.mesh(test::box(vec3(0.3f))));
  device_->forget_commands();
  const double before = renderer_->report().counters.at("engine.draws");
  render_frames({request()}, 2);
  EXPECT_GT(commands("copy_buffer"), 0u);
  EXPECT_EQ(renderer_->report().counters.at("engine.draws"), before + 1.0);
}

TEST_F(RendererTest, two_views_have_pictures_of_their_own) {
  test::fill_small_scene(world_);
  test::add_lights(world_);
  ViewRequest away = request(7, 33, 21);
  away.settings = test::look_at(dvec3(0.0, 0.0, 50.0), dvec3(0.0, 0.0, 90.0), 33, 21);
  away.settings.id = ViewId{7};
  render_frames({request(), away}, 3);
  EXPECT_EQ(renderer_->report().counters.at("engine.draws"), 0.0) << "counters are of the last view, which looks away";
  const auto first = renderer_->read_picture(ViewId{0});
  const auto second = renderer_->read_picture(ViewId{7});
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first->rgba.size(), 64u * 40u * 4u);
  EXPECT_EQ(second->width, 33u);
  EXPECT_EQ(second->height, 21u);
  const auto linear = renderer_->read_linear(ViewId{7});
  ASSERT_TRUE(linear.ok());
  EXPECT_EQ(linear->rgba.size(), 33u * 21u * 4u);
  render_frames({request()}, 2);
}

TEST_F(RendererTest, a_view_may_change_its_size_every_frame) {
  test::fill_small_scene(world_);
  test::add_lights(world_);
  for (const auto& [width, height] : {std::pair{64u, 40u}, {65u, 39u}, {1u, 1u}, {7u, 300u}, {64u, 40u}}) {
    render_frames({request(0, width, height)}, 2);
    const auto picture = renderer_->read_picture(ViewId{0});
    ASSERT_TRUE(picture.ok());
    EXPECT_EQ(picture->width, width);
    EXPECT_EQ(picture->height, height);
    EXPECT_EQ(picture->rgba.size(), std::size_t{4} * width * height);
  }
}

TEST_F(RendererTest, every_view_of_the_engine_can_be_shown) {
  test::fill_small_scene(world_);
  for (const char* name : {"albedo", "normal", "depth", "none", "albedo"}) {
    ViewRequest shown = request();
    shown.settings.visualizer = name;
    ASSERT_TRUE(renderer_->check_visualizer(world_, name).ok()) << name;
    render_frames({shown}, 2);
    EXPECT_TRUE(renderer_->read_picture(ViewId{0}).ok());
  }
}

TEST_F(RendererTest, unknown_views_are_refused_with_a_list) {
  const auto fault = [&](std::string_view name) {
    const Status status = renderer_->check_visualizer(world_, name);
    return status.ok() ? std::string("(no error)") : status.error().message;
  };
  EXPECT_THAT(fault("albino"),
              HasSubstr("unknown view albino; did you mean albedo? there are none, albedo, normal, depth"));
  EXPECT_THAT(fault("dept:lamp"), HasSubstr("unknown view dept:lamp; did you mean depth? there are none, albedo"));
  EXPECT_THAT(fault("heat"), HasSubstr("unknown view heat; there are none, albedo"));
  EXPECT_EQ(fault("albedo:3"), "view albedo takes no argument");
  EXPECT_EQ(fault("none"), "(no error)");
}

TEST_F(RendererTest, a_picture_of_the_caller_is_left_as_asked) {
  test::fill_small_scene(world_);
  gpu::ImageDesc desc{
      .name = "host picture", .module = "host", .format = gpu::Format::bgra8_unorm, .width = 64, .height = 40};
  desc.usage = gpu::ImageUsage::color_target | gpu::ImageUsage::transfer_source;
  const auto image = device_->create_image(desc);
  ASSERT_TRUE(image.ok());
  for (const char* visualizer : {"none", "albedo"}) {
    ViewRequest shown = request();
    shown.settings.visualizer = visualizer;
    shown.target.image = *image;
    shown.target.after = gpu::Access::transfer_read;
    render_frames({shown}, 3);
  }
  std::string last;
  for (const gpu::RecordedCommand& command : device_->commands())
    if (command.name == "barrier" && command.text.find("host picture") != std::string::npos) last = command.text;
  EXPECT_THAT(last, HasSubstr("'host picture' color_target>transfer_read"));
}

TEST_F(RendererTest, a_followed_camera_is_where_the_frames_systems_put_it) {
  Camera lens;
  lens.near_m = 0.5f;
  const Entity camera = world_.create(LocalTransform{.translation = dvec3(1e6, 2.0, 3.0)}, WorldTransform{}, lens);
  ViewRequest followed;
  followed.settings.camera_entity = camera;
  followed.settings.width = followed.settings.height = 8;
  render_frames({followed});
  EXPECT_EQ(world_.view_resource<RenderView>(ViewId{0}).position, dvec3(1e6, 2.0, 3.0));
  EXPECT_EQ(world_.view_resource<RenderView>(ViewId{0}).near_m, 0.5f);
  world_.get<LocalTransform>(camera).translation = dvec3(5.0, 6.0, 7.0);
  render_frames({followed});
  EXPECT_EQ(world_.view_resource<RenderView>(ViewId{0}).position, dvec3(5.0, 6.0, 7.0));
  EXPECT_EQ(world_.view_resource<RenderView>(ViewId{0}).frame, 1u);
}

TEST_F(RendererTest, two_worlds_share_a_renderer) {
  World other;
  renderer_->prepare_world(other);
  test::fill_small_scene(world_);
  test::SceneMaker scene(other);
  scene.draw(scene.mesh(test::box(vec3(0.5f))));
  for (int i = 0; i < 2; ++i) {
    render_frames({request()});
    const double many = renderer_->report().counters.at("engine.draws");
    const std::vector<ViewRequest> one = {request()};
    ASSERT_TRUE(renderer_->render(other, one).ok());
    EXPECT_EQ(renderer_->report().counters.at("engine.draws"), 1.0);
    EXPECT_GT(many, 1.0);
  }
}

/// Checks the bytes of images and buffers that the engine keeps between frames.
class ReleasedViews : public RendererTest {
 protected:
  ReleasedViews() {
    test::fill_small_scene(world_);
    world_.resource<SceneEnvironment>().has_exposure = true;  // a metered one is read back, into memory of its own
  }
  [[nodiscard]] std::uint64_t kept_bytes() {
    renderer_->free_idle_memory();
    return state_of("engine").gpu_bytes;
  }
  /// Per pixel 8 bytes of linear light and 4 bytes of picture.
  static std::uint64_t image_bytes(std::uint32_t width, std::uint32_t height) {
    return std::uint64_t{12} * width * height;
  }
};

TEST_F(ReleasedViews, views_that_are_drawn_no_more_lose_their_images_after_a_while) {
  render_frames({request()}, 3);
  const std::uint64_t one_view = kept_bytes();
  for (std::uint32_t id = 1; id <= 5; ++id) render_frames({request(), request(id, 128, 128)});
  render_frames({request()}, 3);
  EXPECT_GE(kept_bytes(), one_view + 5 * image_bytes(128, 128)) << "a view may miss a few frames";
  EXPECT_TRUE(renderer_->read_picture(ViewId{5}).ok());
  render_frames({request()}, kFramesForRelease);
  EXPECT_EQ(kept_bytes(), one_view);
  EXPECT_TRUE(renderer_->read_picture(ViewId{0}).ok());
  EXPECT_EQ(renderer_->read_picture(ViewId{5}).error().kind, ErrorKind::usage);
  render_frames({request(5, 128, 128)});
  EXPECT_TRUE(renderer_->read_picture(ViewId{5}).ok()) << "and get others when they are drawn again";
}

TEST_F(ReleasedViews, a_released_view_loses_its_images_at_once) {
  render_frames({request()}, 3);
  const std::uint64_t one_view = kept_bytes();
  render_frames({request(), request(4, 200, 100)});
  renderer_->release_view(ViewId{4});
  renderer_->release_view(ViewId{4});
  renderer_->release_view(ViewId{77});
  render_frames({request()}, 3);
  EXPECT_EQ(kept_bytes(), one_view);
  EXPECT_EQ(renderer_->read_linear(ViewId{4}).error().kind, ErrorKind::usage);
  render_frames({request(), request(4, 200, 100)});
  EXPECT_EQ(renderer_->read_picture(ViewId{4})->width, 200u);
  renderer_->release_view(ViewId{4});
  EXPECT_EQ(renderer_->pick(world_, ViewId{4}, 0, 0).error().kind, ErrorKind::usage);
}

TEST_F(ReleasedViews, the_views_of_a_released_world_lose_their_images) {
  render_frames({request()}, 3);
  const std::uint64_t one_world = kept_bytes();
  {
    World other;
    renderer_->prepare_world(other);
    test::SceneMaker scene(other);
    scene.draw(scene.mesh(test::box(vec3(0.5f))));
    const std::vector<ViewRequest> views = {request(2, 128, 128), request(3, 64, 64)};
    ASSERT_TRUE(renderer_->render(other, views).ok());
    renderer_->release_world(other);
  }
  render_frames({request()}, 3);
  EXPECT_EQ(kept_bytes(), one_world);
}

TEST_F(ReleasedViews, a_view_that_got_a_target_loses_its_own_picture) {
  gpu::ImageDesc desc{.name = "host", .module = "host", .format = gpu::Format::rgba8_srgb, .width = 64, .height = 40};
  desc.usage = gpu::ImageUsage::color_target;
  const auto image = device_->create_image(desc);
  ASSERT_TRUE(image.ok());
  ViewRequest shown = request();
  shown.target.image = *image;
  render_frames({shown}, 3);
  const std::uint64_t with_target = kept_bytes();
  render_frames({request()}, 3);
  EXPECT_EQ(kept_bytes(), with_target + std::uint64_t{4} * 64 * 40);
  render_frames({shown}, 3);
  EXPECT_EQ(kept_bytes(), with_target);
}

TEST_F(RendererTest, a_refused_upload_reaches_the_caller_and_is_tried_again) {
  test::fill_small_scene(world_);
  device_->fail_next_creation({ErrorKind::failed, "out of memory for the test"});
  const Status refused = render({request()});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "out of memory for the test");
  render_frames({request()}, 2);
  EXPECT_GE(renderer_->report().counters.at("engine.draws"), 8.0);
}

TEST_F(RendererTest, a_refusal_in_mid_frame_reaches_the_caller_and_the_next_frame_works) {
  test::fill_small_scene(world_);
  render_frames({request()}, 2);
  for (const std::uint32_t width : {80u, 96u}) {
    device_->fail_next_creation({ErrorKind::failed, "no memory for an image"});
    const Status refused = render({request(0, width, 50)});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().message, "no memory for an image");
    render_frames({request(0, width, 50)});
  }
}

TEST_F(RendererTest, a_world_that_was_not_prepared_asserts) {
  World bare;
  prepare_scene_world(bare);
  for (const auto& module : renderer_->modules()) module->register_components(bare);
  const std::vector<ViewRequest> one = {request()};
  EXPECT_ASSERT((void)renderer_->render(bare, one), "must be prepared by the renderer");
  EXPECT_FALSE(renderer_->read_picture(ViewId{9}).ok());
}

TEST_F(RendererTest, picking_tells_of_the_view_it_was_asked_for) {
  test::fill_small_scene(world_);
  render_frames({request(0, 64, 40), request(3, 16, 8)});
  const auto lines = renderer_->pick(world_, ViewId{3}, 15, 7);
  ASSERT_TRUE(lines.ok()) << lines.error().message;
  EXPECT_THAT(lines->front(), HasSubstr("pixel 15,7 of tile 1,0"));
  EXPECT_TRUE(renderer_->pick(world_, ViewId{0}, 63, 39).ok()) << "the other view is still there";
  EXPECT_FALSE(renderer_->pick(world_, ViewId{3}, 16, 7).ok());
}

TEST_F(RendererTest, a_picture_that_is_there_for_one_frame_only_is_not_asked_for_by_picking) {
  test::fill_small_scene(world_);
  gpu::ImageDesc desc{.name = "window", .module = "host", .format = gpu::Format::bgra8_srgb, .width = 48, .height = 24};
  desc.usage = gpu::ImageUsage::color_target;
  const auto window = device_->create_image(desc);
  ASSERT_TRUE(window.ok());
  int asked = 0;
  ViewRequest shown = request();
  shown.target.acquire = [&]() -> Result<gpu::ImageHandle> {
    ++asked;
    return *window;
  };
  render_frames({shown}, 2);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(world_.view_resource<RenderView>(ViewId{0}).width, 48u) << "the view takes the picture's size";
  EXPECT_TRUE(renderer_->pick(world_, ViewId{0}, 47, 23).ok());
  EXPECT_FALSE(renderer_->pick(world_, ViewId{0}, 48, 0).ok());
  EXPECT_EQ(asked, 2);
}

TEST_F(RendererTest, picking_outside_the_picture_is_a_usage_error) {
  render_frames({request(0, 16, 8)});
  for (const auto& [x, y] : {std::pair{16u, 0u}, {0u, 8u}, {~0u, ~0u}}) {
    const auto lines = renderer_->pick(world_, ViewId{0}, x, y);
    ASSERT_FALSE(lines.ok());
    EXPECT_EQ(lines.error().kind, ErrorKind::usage);
  }
}

}  // namespace
}  // namespace gloam
