// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "tests/render/passes/projected_motion.h"

// GeometryOutputs::motion against positions projected in double precision.

namespace gloam {
namespace {

using test::MovingTriangles;

dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }
dmat4 turned(double angle, const dvec3& axis) { return glm::rotate(dmat4(1.0), angle, glm::normalize(axis)); }

/// Whether the reading module asks for motion, and which view does not demand the module.
struct Wish {
  bool wanted = true;
  std::optional<std::uint32_t> left_out = {};
};

/// Asks for motion and does nothing with it. `wish` must outlive it.
class MotionReader final : public Module {
 public:
  explicit MotionReader(const Wish& wish) : wish_(wish) {}
  [[nodiscard]] std::string_view name() const override { return "motion_reader"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView* view) const override {
    return {view == nullptr || wish_.left_out != view->id.value, "reads motion"};
  }
  [[nodiscard]] bool needs_motion(const World&, const KnobRegistry&) const override { return wish_.wanted; }

 private:
  const Wish& wish_;
};

class Motion : public test::DrawingTest {
 protected:
  void SetUp() override {
    test::DrawingTest::SetUp();
    if (IsSkipped()) return;
    stage = std::make_unique<test::Stage>(std::make_unique<MotionReader>(wish));
    stage->settings = camera(dvec3(2.0, 3.0, 9.0));
  }
  [[nodiscard]] static ViewSettings camera(const dvec3& eye, const dvec3& target = dvec3(0.0)) {
    return test::look_at(eye, target, 128, 72);
  }
  ViewRequest request(const ViewSettings& settings, std::uint32_t id = 0) {
    ViewRequest made;
    made.settings = settings;
    made.settings.id = ViewId{id};
    return made;
  }
  /// Draws view 0 with a camera.
  void draw(const ViewSettings& settings) { stage->render({request(settings)}); }

  /// Compares a view's last frame and prints the largest error.
  test::Compared expect_motion(const MovingTriangles& triangles, const ViewSettings& now, const ViewSettings& before,
                               std::uint32_t view = 0) {
    const test::Compared compared = test::compare_motion(test::read_motion(*stage, view), triangles, now, before);
    std::printf("  %d surface and %d sky pixels, motion up to %.1f pixels, largest error %.5f pixels\n",
                compared.surface, compared.sky, compared.longest, compared.worst);
    EXPECT_GT(compared.surface, 100);
    EXPECT_LE(compared.worst, test::kMotionBar);
    return compared;
  }
  void move(Entity entity, const dmat4& matrix) { stage->world.get<WorldTransform>(entity).matrix = matrix; }

  Wish wish;
};

TEST_F(Motion, of_a_static_scene_is_that_of_the_camera_far_from_the_origin_too) {
  const Primitive box = test::box(vec3(1.0f, 0.7f, 0.5f)), floor = test::box(vec3(6.0f, 0.1f, 6.0f));
  for (const double far : {0.0, 1e5}) {
    stage = std::make_unique<test::Stage>(std::make_unique<MotionReader>(wish));
    const dvec3 offset(far, -far, far);
    MovingTriangles triangles;
    for (const auto& [mesh, pose] : {std::pair(box, at(0, 0, 0) * turned(0.5, dvec3(1, 2, 0))),
                                     std::pair(floor, at(0, -1.5, 0)), std::pair(box, at(-2, 0, 2))}) {
      const dmat4 matrix = glm::translate(dmat4(1.0), offset) * pose;
      stage->scene.draw(stage->scene.mesh(mesh), matrix);
      triangles.add(mesh, matrix, matrix);
    }
    const ViewSettings before = camera(offset + dvec3(2.0, 3.0, 9.0), offset);
    const ViewSettings now = camera(offset + dvec3(2.4, 2.8, 8.5), offset + dvec3(0.2, 0.1, 0.0));
    draw(before);
    draw(now);
    const test::Compared compared = expect_motion(triangles, now, before);
    EXPECT_GT(compared.longest, 3.0);
    EXPECT_GT(compared.sky, 100);
    draw(now);
    for (const vec2& motion : test::read_motion(*stage).motion) ASSERT_EQ(motion, vec2(0.0f)) << "nothing moves";
  }
}

TEST_F(Motion, keeps_its_accuracy_where_it_is_longer_than_64_pixels) {
  const Primitive floor = test::box(vec3(6.0f, 0.1f, 6.0f));
  stage->scene.draw(stage->scene.mesh(floor), at(0, -1.5, 0));
  MovingTriangles triangles;
  triangles.add(floor, at(0, -1.5, 0), at(0, -1.5, 0));
  ViewSettings before = camera(dvec3(2.0, 1.0, 5.0)), now = camera(dvec3(2.6, 0.9, 4.5), dvec3(2.0, -0.5, 0.0));
  for (ViewSettings* settings : {&before, &now}) {
    settings->width = 640;
    settings->height = 120;
    settings->camera.fov_y = 0.3f;
  }
  draw(before);
  draw(now);
  EXPECT_GT(expect_motion(triangles, now, before).longest, 100.0);
}

TEST_F(Motion, of_objects_includes_their_turning_mirrored_ones_too) {
  const Primitive box = test::box(vec3(1.0f, 0.7f, 0.5f));
  const std::uint32_t mesh = stage->scene.mesh(box);
  const dmat4 mirror = glm::scale(dmat4(1.0), dvec3(-1.0, 1.2, 1.0));
  const dmat4 before[] = {at(-1.5, 0, 0), at(1.5, 0, 0) * mirror};
  const dmat4 now[] = {at(-1.3, 0.1, 0.4) * turned(0.3, dvec3(1, 1, 0)),
                       at(1.7, -0.2, 0) * turned(-0.2, dvec3(0, 1, 1)) * mirror};
  const Entity boxes[] = {stage->scene.draw(mesh, before[0]), stage->scene.draw(mesh, before[1])};
  MovingTriangles triangles;
  draw(stage->settings);
  for (int i = 0; i < 2; ++i) {
    move(boxes[i], now[i]);
    triangles.add(box, now[i], before[i]);
  }
  draw(stage->settings);
  expect_motion(triangles, stage->settings, stage->settings);
}

/// The world triangles of test::skinned_bar for joint matrices, with the weights that the GPU has.
std::vector<dvec3> posed_bar(const dmat4& lower, const dmat4& upper) {
  const Primitive bar = test::skinned_bar();
  const dmat4 joints[] = {lower, upper * at(0, -2, 0)};
  std::vector<dvec3> corners;
  for (const std::uint32_t i : bar.indices) {
    const dvec4 rest(dvec3(bar.positions[i]), 1.0);
    const double w = std::round(static_cast<double>(bar.weights[i].y) * 65535.0) / 65535.0;
    corners.push_back(dvec3((1.0 - w) * (joints[0] * rest) + w * (joints[1] * rest)));
  }
  return corners;
}

class SkinnedMotion : public Motion {
 protected:
  void SetUp() override {
    Motion::SetUp();
    if (IsSkipped()) return;
    skin_ = test::two_joint_skin(stage->world, 0, lower_before, upper_before);
    bar_ = stage->world.create(WorldTransform{}, MeshInstance{stage->scene.mesh(test::skinned_bar()), skin_});
  }
  void pose(const dmat4& lower, const dmat4& upper) {
    stage->world.view<const SourceNode, WorldTransform>().each(
        [&](const SourceNode& node, WorldTransform& transform) { transform.matrix = node.index == 0 ? lower : upper; });
  }
  const dmat4 lower_before = at(0, -2, 0), upper_before = at(0, 0, 0) * turned(0.5, dvec3(0, 0, 1));
  const dmat4 lower_now = at(0.3, -1.9, 0.2) * turned(0.2, dvec3(0, 1, 0));
  const dmat4 upper_now = at(0.3, 0.1, 0.2) * turned(-0.4, dvec3(0, 1, 1));
  std::uint32_t skin_ = 0;
  Entity bar_;
};

// Hard case: passes.motion_skinned
TEST_F(SkinnedMotion, follows_the_joints_of_both_frames) {
  draw(stage->settings);
  pose(lower_now, upper_now);
  const ViewSettings now = camera(dvec3(2.2, 3.1, 8.7));
  draw(now);
  expect_motion({posed_bar(lower_now, upper_now), posed_bar(lower_before, upper_before), true}, now, stage->settings);
}

TEST_F(SkinnedMotion, is_known_of_vertices_that_the_previous_frame_culled) {
  const ViewSettings before = camera(dvec3(0.0, 1.0, 8.0), dvec3(9.0, 1.0, 0.0));
  draw(before);
  pose(lower_now, upper_now);
  draw(stage->settings);
  expect_motion({posed_bar(lower_now, upper_now), posed_bar(lower_before, upper_before), true}, stage->settings,
                before);
}

// Hard case: passes.motion_new
TEST_F(SkinnedMotion, of_a_bar_that_appears_is_that_of_the_camera) {
  draw(stage->settings);
  pose(lower_now, upper_now);
  const Entity late = stage->world.create(WorldTransform{}, MeshInstance{stage->world.get<MeshInstance>(bar_)});
  stage->world.destroy(bar_);
  const ViewSettings now = camera(dvec3(2.2, 3.1, 8.7));
  draw(now);
  const std::vector<dvec3> posed = posed_bar(lower_now, upper_now);
  expect_motion({posed, posed, true}, now, stage->settings);
  static_cast<void>(late);
}

TEST_F(Motion, of_a_morphed_surface_follows_its_weights) {
  Primitive flag = test::quad(2.0f);
  flag.morph_targets = {{{vec3(0, 0, 2), vec3(0.5f, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)}, {}}};
  const std::uint32_t mesh = stage->scene.mesh(flag);
  stage->scene.assets().meshes[mesh].morph_weights = {0.25f};
  stage->world.create(WorldTransform{at(0, 0, 0)}, MeshInstance{mesh}, MorphInstance{});
  const auto corners = [&](double weight) {
    std::vector<dvec3> all;
    for (const std::uint32_t i : flag.indices)
      all.push_back(dvec3(flag.positions[i]) + weight * dvec3(flag.morph_targets[0].positions[i]));
    return all;
  };
  draw(stage->settings);
  stage->world.resource<MorphWeights>().values.at(0) = 0.75f;
  draw(stage->settings);
  expect_motion({corners(0.75), corners(0.25)}, stage->settings, stage->settings);
}

// Hard case: passes.motion_new
TEST_F(Motion, of_an_object_begins_in_its_second_frame) {
  const Primitive box = test::box(vec3(1.5f));
  const std::uint32_t mesh = stage->scene.mesh(box);
  stage->scene.draw(mesh, at(-3, 0, 0));
  const ViewSettings cameras[] = {camera(dvec3(2.0, 3.0, 9.0)), camera(dvec3(2.3, 3.1, 8.8)),
                                  camera(dvec3(2.5, 3.3, 8.7))};
  draw(cameras[0]);
  const Entity late = stage->scene.draw(mesh, at(2, 0, 0));
  draw(cameras[1]);
  MovingTriangles triangles;
  triangles.add(box, at(-3, 0, 0), at(-3, 0, 0));
  triangles.add(box, at(2, 0, 0), at(2, 0, 0));
  expect_motion(triangles, cameras[1], cameras[0]);

  move(late, at(2.2, 0.1, 0));
  draw(cameras[2]);
  triangles = {};
  triangles.add(box, at(-3, 0, 0), at(-3, 0, 0));
  triangles.add(box, at(2.2, 0.1, 0), at(2, 0, 0));
  expect_motion(triangles, cameras[2], cameras[1]);
}

TEST_F(Motion, of_teleported_objects_and_their_descendants_is_that_of_the_camera_for_one_frame) {
  const Primitive box = test::box(vec3(0.8f));
  const std::uint32_t mesh = stage->scene.mesh(box);
  const Entity root = stage->world.create(WorldTransform{}, LocalMatrix{at(-2, 0, 0)}, MeshInstance{mesh});
  stage->world.create(WorldTransform{}, LocalMatrix{at(0, 1.7, 0)}, Parent{root, 1}, MeshInstance{mesh});
  const Entity other = stage->scene.draw(mesh, at(2, 0, 0));
  const auto step = [&](double x, double before_x, double other_x, double other_before_x) {
    stage->world.get<LocalMatrix>(root).matrix = at(x, 0, 0);
    stage->world.mark_changed<LocalMatrix>(root);
    move(other, at(other_x, 0, 0));
    draw(stage->settings);
    MovingTriangles triangles;
    triangles.add(box, at(x, 0, 0), at(before_x, 0, 0));
    triangles.add(box, at(x, 1.7, 0), at(before_x, 1.7, 0));
    triangles.add(box, at(other_x, 0, 0), at(other_before_x, 0, 0));
    expect_motion(triangles, stage->settings, stage->settings);
  };
  step(-2, -2, 2, 2);
  stage->world.resource<Teleports>().entities = {root};
  step(0, 0, 2.1, 2);
  EXPECT_TRUE(stage->world.resource<Teleports>().entities.empty());
  step(0.1, 0, 2.2, 2.1);
}

TEST_F(Motion, of_each_view_is_to_its_own_previous_camera) {
  const Primitive box = test::box(vec3(1.5f));
  const Entity entity = stage->scene.draw(stage->scene.mesh(box), at(0, 0, 0));
  const auto eye = [](int view, int frame) {
    return camera(view == 0 ? dvec3(2.0 + 0.2 * frame, 3.0, 9.0) : dvec3(-6.0, 2.0 + 0.3 * frame, 5.0));
  };
  const auto box_at = [](int frame) { return at(0.1 * frame, 0, 0); };
  const auto step = [&](int frame, const std::vector<int>& views, const std::map<int, int>& previous_cameras) {
    move(entity, box_at(frame));
    std::vector<ViewRequest> requests;
    for (const int view : views) requests.push_back(request(eye(view, frame), static_cast<std::uint32_t>(view)));
    stage->render(requests);
    MovingTriangles triangles;
    triangles.add(box, box_at(frame), box_at(std::max(frame - 1, 0)));
    for (const int view : views)
      expect_motion(triangles, eye(view, frame), eye(view, previous_cameras.at(view)),
                    static_cast<std::uint32_t>(view));
  };
  step(0, {0, 1}, {{0, 0}, {1, 1 - 1}});
  step(1, {0, 1}, {{0, 0}, {1, 0}});
  step(2, {0}, {{0, 1}});
  step(3, {1, 0}, {{0, 2}, {1, 3}});  // frame 2 did not draw view 1
}

TEST_F(Motion, after_a_camera_cut_is_that_of_objects_alone) {
  const Primitive box = test::box(vec3(1.5f));
  const Entity entity = stage->scene.draw(stage->scene.mesh(box), at(0, 0, 0));
  draw(stage->settings);
  move(entity, at(0.2, 0.1, 0));
  ViewSettings cut = camera(dvec3(-6.0, 2.0, 5.0));
  cut.camera_cut = true;
  draw(cut);
  MovingTriangles triangles;
  triangles.add(box, at(0.2, 0.1, 0), at(0, 0, 0));
  expect_motion(triangles, cut, cut);
}

TEST_F(Motion, goes_on_from_the_last_drawn_frame_after_one_that_was_given_up) {
  const Primitive box = test::box(vec3(1.5f));
  const Entity entity = stage->scene.draw(stage->scene.mesh(box), at(0, 0, 0));
  draw(stage->settings);
  move(entity, at(5, 0, 0));
  ViewRequest broken = request(camera(dvec3(-6.0, 2.0, 5.0)));
  broken.target.acquire = []() -> Result<gpu::ImageHandle> { return Error{ErrorKind::failed, "the window is gone"}; };
  ASSERT_FALSE(stage->renderer->render(stage->world, {&broken, 1}).ok());
  move(entity, at(0.2, 0.1, 0));
  const ViewSettings now = camera(dvec3(2.2, 3.1, 8.7));
  draw(now);
  MovingTriangles triangles;
  triangles.add(box, at(0.2, 0.1, 0), at(0, 0, 0));
  expect_motion(triangles, now, stage->settings);
  expect_motion(triangles, now, stage->settings);  // reading draws the frame again; its previous frame stays
}

TEST_F(Motion, of_orthographic_cameras_moves_surfaces_and_leaves_the_sky) {
  const Primitive box = test::box(vec3(1.5f));
  stage->scene.draw(stage->scene.mesh(box), at(0, 0, 0));
  MovingTriangles triangles;
  triangles.add(box, at(0, 0, 0), at(0, 0, 0));
  ViewSettings before = camera(dvec3(2.0, 3.0, 9.0)), now = camera(dvec3(2.6, 2.9, 8.5), dvec3(0.2, 0.0, 0.0));
  for (ViewSettings* settings : {&before, &now}) {
    settings->camera.orthographic = true;
    settings->camera.half_height_m = 4.0f;
    settings->camera.far_m = 30.0f;
  }
  draw(before);
  draw(now);
  EXPECT_GT(expect_motion(triangles, now, before).sky, 100);
}

TEST_F(Motion, of_points_that_were_behind_the_camera_is_outside_of_any_picture) {
  const Primitive box = test::box(vec3(1.5f));
  stage->scene.draw(stage->scene.mesh(box), at(0, 0, 0));
  MovingTriangles triangles;
  triangles.add(box, at(0, 0, 0), at(0, 0, 0));
  const ViewSettings before = camera(dvec3(2.0, 3.0, 9.0), dvec3(4.0, 6.0, 18.0));
  draw(before);
  draw(stage->settings);
  expect_motion(triangles, stage->settings, before);
}

TEST_F(Motion, is_not_made_for_views_that_do_not_demand_its_reader) {
  wish.left_out = 1;
  stage->render({request(stage->settings, 0), request(stage->settings, 1)});
  EXPECT_TRUE(stage->renderer->read_image(stage->world, ViewId{0}, "motion").ok());
  stage->render({request(stage->settings, 0), request(stage->settings, 1)});
  EXPECT_FALSE(stage->renderer->read_image(stage->world, ViewId{1}, "motion").ok());
}

/// Bytes and pipelines of the engine, and pass names of the last frame. The device counts all renderers together.
std::string belongings(test::Stage& stage) {
  EXPECT_TRUE(stage.renderer->wait().ok());
  stage.renderer->free_idle_memory();
  const FrameReport report = stage.renderer->report();
  std::string text = std::to_string(report.modules.front().gpu_bytes) + " bytes, " +
                     std::to_string(report.modules.front().pipelines) + " pipelines:";
  for (const PassTime& pass : report.passes) text += " " + pass.name;
  return text;
}

TEST_F(Motion, costs_nothing_and_changes_nothing_until_it_is_asked_for) {
  const auto fill_and_draw = [&](test::Stage& own) {
    test::fill_small_scene(own.world);
    static_cast<void>(test::add_lights(own.world));
    own.settings = camera(dvec3(2.0, 3.0, 9.0));
    for (int i = 0; i < 4; ++i) own.render();
  };
  stage = std::make_unique<test::Stage>();  // no module asks
  fill_and_draw(*stage);
  const std::string belongs_without = belongings(*stage);
  const Picture without = stage->picture();
  stage.reset();
  wish.wanted = false;
  stage = std::make_unique<test::Stage>(std::make_unique<MotionReader>(wish));
  fill_and_draw(*stage);
  EXPECT_EQ(belongings(*stage), belongs_without);
  EXPECT_TRUE(stage->picture().rgba == without.rgba);
  EXPECT_FALSE(stage->renderer->read_image(stage->world, ViewId{0}, "motion").ok());

  static constexpr std::string_view kNames[] = {"base_color", "normals", "material", "depth"};
  const std::vector<ImageBytes> plain = test::value_of(stage->renderer->read_images(stage->world, ViewId{0}, kNames));
  wish.wanted = true;
  stage->render();
  EXPECT_TRUE(stage->picture().rgba == without.rgba);
  EXPECT_TRUE(stage->renderer->read_image(stage->world, ViewId{0}, "motion").ok());
  const std::vector<ImageBytes> asked = test::value_of(stage->renderer->read_images(stage->world, ViewId{0}, kNames));
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_TRUE(asked[i].bytes == plain[i].bytes) << kNames[i];
  EXPECT_NE(belongings(*stage), belongs_without);
  wish.wanted = false;
  for (int i = 0; i < 4; ++i) stage->render();
  EXPECT_TRUE(stage->picture().rgba == without.rgba);
}

}  // namespace
}  // namespace gloam
