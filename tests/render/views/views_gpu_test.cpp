// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Views: captures into a cube, mirrored views, views of one frame beside each other, and what a released view leaves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/render/frame_builder.h"
#include "modules/fog/components.h"
#include "modules/shadows/components.h"
#include "tests/render/draws/drawn_scene.h"
#include "tests/support/cube_capture.h"

namespace gloam {
namespace {

/// The small scene with lamps, a sun, shadows and, on demand, fog.
void fill(World& world, bool fog) {
  test::fill_small_scene(world);
  static_cast<void>(test::add_lights(world));
  if (fog) world.create(WorldTransform{}, Fog{.density = 0.05f, .color = vec3(2.0f, 3.0f, 4.0f)});
}

class Views : public test::DrawingTest {};

// Hard case: passes.cube_capture
TEST_F(Views, a_cube_capture_equals_six_renders_to_the_bit_and_has_no_fog) {
  fill(stage->world, true);
  const std::array<ViewSettings, 6> faces = test::cube_faces(dvec3(0.3, 0.9, 0.2));
  const gpu::ImageHandle cube = test::make_cube(*test::drawing_device(), 1);
  stage->render(test::captures_of(faces, cube));
  std::array<std::vector<std::uint16_t>, 6> captured;
  for (std::uint32_t i = 0; i < 6; ++i) captured[i] = test::layer_of(*test::drawing_device(), cube, i);

  test::Stage clear;
  fill(clear.world, false);
  bool lit = false;
  for (std::uint32_t i = 0; i < 6; ++i) {
    ViewRequest request;
    request.settings = faces[i];
    clear.render({request});
    const LinearPicture rendered = clear.linear(faces[i].id.value);
    ASSERT_EQ(rendered.rgba.size(), captured[i].size());
    std::size_t different = 0;
    for (std::size_t t = 0; t < rendered.rgba.size(); ++t) {
      different += test::float_of(captured[i][t]) != rendered.rgba[t] ? 1 : 0;
      lit = lit || (t % 4 == 0 && rendered.rgba[t] > 0.1f);
    }
    EXPECT_EQ(different, 0u) << "face " << i;
  }
  EXPECT_TRUE(lit);
  test::drawing_device()->destroy(cube);
}

TEST_F(Views, a_capture_keeps_the_layers_that_it_does_not_draw) {
  fill(stage->world, false);
  const std::array<ViewSettings, 6> faces = test::cube_faces(dvec3(0.3, 0.9, 0.2));
  const gpu::ImageHandle cube = test::make_cube(*test::drawing_device(), 1);
  const std::vector<ViewRequest> all = test::captures_of(faces, cube);
  stage->render(all);
  const std::vector<std::uint16_t> first = test::layer_of(*test::drawing_device(), cube, 1);
  ViewRequest other = all[0];
  other.settings.world_from_camera[3].y += 0.5;
  other.target.light->before = gpu::Access::transfer_read;
  const std::vector<std::uint16_t> changed = test::layer_of(*test::drawing_device(), cube, 0);
  stage->render({other});
  EXPECT_EQ(test::layer_of(*test::drawing_device(), cube, 1), first);
  EXPECT_NE(test::layer_of(*test::drawing_device(), cube, 0), changed);
  test::drawing_device()->destroy(cube);
}

/// Mirrors the whole world at a plane.
void mirror_world(World& world, const dmat4& reflection) {
  world.view<WorldTransform>().each(
      [&](WorldTransform& transform) { transform.matrix = reflection * transform.matrix; });
}

dmat4 reflection_at(const MirrorPlane& mirror) {
  const dvec3 n = mirror.normal;
  dmat4 matrix(glm::dmat3(1.0) - 2.0 * glm::outerProduct(n, n));
  matrix[3] = dvec4(2.0 * mirror.offset * n, 1.0);
  return matrix;
}

// Hard case: passes.mirrored_view
TEST_F(Views, a_mirrored_view_equals_the_mirrored_scene) {
  const MirrorPlane planes[] = {{dvec3(0.0, 1.0, 0.0), -3.0}, {glm::normalize(dvec3(0.3, 1.0, -0.2)), -4.0}};
  for (const MirrorPlane& plane : planes) {
    test::Stage real, mirrored;
    for (test::Stage* made : {&real, &mirrored}) {
      fill(made->world, true);
      made->settings = test::look_at(dvec3(3.0, 2.0, 7.0), dvec3(0.0, -4.0, 0.0), 96, 64);
      // Shadow maps of the mirrored world have their texels in other places.
      ASSERT_TRUE(made->renderer->knobs().set("shadows.mode", "off").ok());
      made->world.resource<SceneEnvironment>().sky_zenith = vec3(0.0f);
      made->world.resource<SceneEnvironment>().sky_horizon = vec3(0.0f);
      made->world.resource<SceneEnvironment>().sky_ground = vec3(0.0f);
    }
    mirror_world(mirrored.world, reflection_at(plane));
    real.settings.mirror = plane;
    const Picture a = real.drawn(), b = mirrored.drawn();
    int worst = 0;
    std::size_t bright = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
      worst = std::max(worst, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
      bright += i % 4 != 3 && a.rgba[i] > 40 ? 1 : 0;
    }
    EXPECT_LE(worst, 1);
    EXPECT_GT(bright, 500u);
  }
}

// Hard case: passes.mirrored_view
TEST_F(Views, a_mirror_shows_only_its_visible_side) {
  test::SceneMaker scene(stage->world);
  Material glowing;
  glowing.emissive = vec3(1.0f);
  glowing.double_sided = true;
  scene.draw(scene.mesh(test::box(vec3(1.0f), scene.material(glowing))));
  stage->settings = test::look_at(dvec3(0.0, 6.0, 0.01), dvec3(0.0), 33, 33);
  // The box reaches from -1 to 1; a mirror at 0 cuts it, and shows its upper half from below.
  stage->settings.mirror = MirrorPlane{dvec3(0.0, 1.0, 0.0), 0.0};
  stage->render();
  const auto picked = stage->pick(16, 16);
  ASSERT_FALSE(picked.sky);
  EXPECT_NEAR(picked.depth_m, 7.0, 0.01) << "the inside of the top, seen through the cut";
  stage->settings.mirror = MirrorPlane{dvec3(0.0, 1.0, 0.0), 2.0};
  stage->render();
  EXPECT_TRUE(stage->pick(16, 16).sky) << "the box lies behind the mirror";
}

TEST_F(Views, two_views_of_a_world_in_a_frame_equal_each_alone) {
  fill(stage->world, true);
  ViewRequest one = stage->request(1), two = stage->request(2);
  one.settings = test::look_at(dvec3(3.0, 2.0, 7.0), dvec3(0.0), 64, 48);
  one.settings.id = ViewId{1};
  two.settings = test::look_at(dvec3(-4.0, 1.0, 3.0), dvec3(0.0), 48, 64);
  two.settings.id = ViewId{2};
  stage->render({one, two});
  const Picture both_one = stage->picture(1), both_two = stage->picture(2);
  for (const auto& [request, both] : {std::pair(one, both_one), std::pair(two, both_two)}) {
    test::Stage alone;
    fill(alone.world, true);
    alone.render({request});
    EXPECT_EQ(alone.picture(request.settings.id.value).rgba, both.rgba);
  }
}

TEST_F(Views, knobs_and_modules_of_one_view_leave_the_others_alone) {
  fill(stage->world, true);
  stage->settings = test::look_at(dvec3(3.0, 2.0, 7.0), dvec3(0.0), 64, 48);
  ViewRequest plain = stage->request(1), own = stage->request(2), bare = stage->request(3);
  own.settings.knobs = {{"lighting.tone_map", "linear"}};
  bare.settings.without = {"fog"};
  stage->render({plain, own, bare});
  const Picture pictures[] = {stage->picture(1), stage->picture(2), stage->picture(3)};
  EXPECT_NE(pictures[1].rgba, pictures[0].rgba);
  EXPECT_NE(pictures[2].rgba, pictures[0].rgba);

  test::Stage linear, clear;
  fill(linear.world, true);
  fill(clear.world, false);
  ASSERT_TRUE(linear.renderer->knobs().set("lighting.tone_map", "linear").ok());
  linear.settings = clear.settings = stage->settings;
  EXPECT_EQ(linear.drawn().rgba, pictures[1].rgba);
  EXPECT_EQ(clear.drawn().rgba, pictures[2].rgba);
}

TEST_F(Views, an_unknown_knob_of_a_view_is_a_usage_error) {
  fill(stage->world, false);
  ViewRequest request = stage->request();
  request.settings.knobs = {{"lighting.tone_mapp", "linear"}};
  const Status status = stage->renderer->render(stage->world, std::span(&request, 1));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::usage);
  EXPECT_THAT(status.error().message, ::testing::HasSubstr("lighting.tone_map"));
  stage->render();
}

std::map<std::string, std::uint64_t> memory() {
  std::map<std::string, std::uint64_t> bytes;
  for (const gpu::ModuleMemory& m : test::drawing_device()->memory()) bytes[m.module] = m.bytes;
  return bytes;
}

// Hard case: passes.release_view
TEST_F(Views, released_views_leave_no_memory_behind) {
  fill(stage->world, false);
  stage->settings = test::look_at(dvec3(3.0, 2.0, 7.0), dvec3(0.0), 64, 48);
  for (int i = 0; i < 4; ++i) stage->render();
  const auto settle = [&] {
    ASSERT_TRUE(stage->renderer->wait().ok());
    for (int i = 0; i < 3; ++i) stage->render();
    stage->renderer->free_idle_memory();
    for (int i = 0; i < 3; ++i) stage->render();
    ASSERT_TRUE(stage->renderer->wait().ok());
  };
  settle();
  const auto before = memory();
  const gpu::ImageHandle cube = test::make_cube(*test::drawing_device(), 1);
  std::vector<ViewRequest> requests = test::captures_of(test::cube_faces(dvec3(0.3, 0.9, 0.2)), cube);
  requests.push_back(stage->request());
  for (int i = 0; i < 3; ++i) stage->render(requests);
  for (std::uint32_t i = 0; i < 6; ++i) stage->renderer->release_view(stage->world, ViewId{100 + i});
  test::drawing_device()->destroy(cube);
  settle();
  for (const auto& [module, bytes] : before) EXPECT_EQ(memory()[module], bytes) << module;
}

TEST_F(Views, captures_share_the_maps_of_local_lights_and_have_cascades_of_their_own) {
  fill(stage->world, false);
  const gpu::ImageHandle cube = test::make_cube(*test::drawing_device(), 1);
  const std::vector<ViewRequest> requests = test::captures_of(test::cube_faces(dvec3(0.3, 0.9, 0.2)), cube);
  const auto sum = [&](const char* name) {
    double all = 0.0;
    for (const ViewCounters& view : stage->renderer->report().views) all += view.counters.at(name);
    return all;
  };
  stage->render(requests);
  const auto faces = [&] {
    return sum("shadows.faces_drawn") + sum("shadows.faces_skipped") + sum("shadows.faces_cached");
  };
  const double all = faces();
  EXPECT_GT(sum("shadows.faces_cached"), 0.0) << "maps that an earlier view of the frame draws are not drawn again";
  EXPECT_GT(sum("shadows.faces_drawn"), 0.0);
  stage->render(requests);
  EXPECT_EQ(faces(), all);
  // One atlas for six views.
  EXPECT_LT(memory()["shadows"], std::uint64_t{200} << 20);
  test::drawing_device()->destroy(cube);
}

TEST_F(Views, captures_keep_their_maps_over_a_frame_that_is_given_up) {
  fill(stage->world, false);
  const gpu::ImageHandle cube = test::make_cube(*test::drawing_device(), 1);
  const std::vector<ViewRequest> requests = test::captures_of(test::cube_faces(dvec3(0.3, 0.9, 0.2)), cube);
  std::vector<ViewRequest> lost = requests;
  lost.push_back(stage->request());
  lost.back().target.overlay = [](FrameGraph&, ImageRef&) -> Status { return Error{ErrorKind::failed, "given up"}; };
  const auto drawn = [](const test::Stage& of) {
    double faces = 0.0;
    for (const ViewCounters& view : of.renderer->report().views)
      faces += view.counters.at("shadows.faces_drawn") + view.counters.at("shadows.faces_skipped");
    return faces;
  };
  stage->render(requests);
  const double all = drawn(*stage);
  EXPECT_GT(all, 0.0);
  EXPECT_FALSE(stage->renderer->render(stage->world, lost).ok());
  stage->render(requests);
  EXPECT_EQ(drawn(*stage), 0.0);
  test::Stage first_is_lost;
  fill(first_is_lost.world, false);
  EXPECT_FALSE(first_is_lost.renderer->render(first_is_lost.world, lost).ok());
  first_is_lost.render(requests);
  EXPECT_EQ(drawn(first_is_lost), all);
  test::drawing_device()->destroy(cube);
}

/// Leaves a value for the later views of a frame.
struct SeenViews {
  std::vector<std::uint32_t> ids;
};

class SeeingModule final : public Module {
 public:
  explicit SeeingModule(std::vector<std::size_t>& earlier) : earlier_(earlier) {}
  [[nodiscard]] std::string_view name() const override { return "seeing"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::lists) return;
    SeenViews* seen = frame.shared().find<SeenViews>();
    if (seen == nullptr) seen = &frame.shared().put(SeenViews{});
    earlier_.push_back(seen->ids.size());
    seen->ids.push_back(frame.view().id.value);
  }

 private:
  std::vector<std::size_t>& earlier_;
};

TEST_F(Views, later_views_of_a_frame_see_what_earlier_ones_have_left) {
  std::vector<std::size_t> earlier;
  test::Stage own(std::make_unique<SeeingModule>(earlier));
  for (int frame = 0; frame < 2; ++frame) own.render({own.request(1), own.request(2), own.request(3)});
  EXPECT_THAT(earlier, ::testing::ElementsAre(0u, 1u, 2u, 0u, 1u, 2u));
}

TEST_F(Views, a_frame_deforms_vertices_once_for_all_views) {
  fill(stage->world, false);
  stage->render({stage->request(1), stage->request(2), stage->request(3)});
  ASSERT_TRUE(stage->renderer->wait().ok());
  std::size_t deforms = 0;
  for (const PassTime& pass : stage->renderer->report().passes) deforms += pass.name == "deform" ? 1 : 0;
  EXPECT_EQ(deforms, 1u);
  for (const std::uint32_t view : {1u, 2u, 3u}) {
    const auto is_own = [&](const PassTime& pass) { return pass.name == "geometry" && pass.view == view; };
    EXPECT_EQ(std::ranges::count_if(stage->renderer->report().passes, is_own), 1) << "times name the view";
  }
  EXPECT_EQ(stage->renderer->report().views.size(), 3u);
}

}  // namespace
}  // namespace gloam
