// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/draws/draw_lists.h"
#include "engine/scene/gltf/import.h"
#include "tests/render/draws/one_view.h"
#include "tests/render/draws/small_scene.h"
#include "tests/render/draws/visible_points.h"
#include "tests/support/render_scene.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

dmat4 at(const dvec3& place) { return glm::translate(dmat4(1.0), place); }

/// Draw lists of views of a world with one skinned or morphed instance.
class DeformedCulling : public ::testing::Test {
 protected:
  DeformedCulling() { prepare_scene_world(world_); }
  void TearDown() override { EXPECT_TRUE(device_->faults().empty()) << device_->faults().front(); }

  [[nodiscard]] double in(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  [[nodiscard]] dvec3 point(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }

  void sync() { ASSERT_TRUE(scene_.sync(maker_.assets(), *serial_).ok()); }
  /// Replaces the only instance of the world.
  Entity draw(std::uint32_t mesh, const dmat4& matrix, std::uint32_t skin = kNone) {
    if (drawn_ != kNoEntity) world_.destroy(drawn_);
    drawn_ = world_.create(WorldTransform{matrix}, MeshInstance{mesh, skin});
    return drawn_;
  }
  void set_weights(Entity entity, std::vector<float> weights) {
    world_.add<MorphInstance>(entity, {0, static_cast<std::uint32_t>(weights.size())});
    world_.resource<MorphWeights>().values = std::move(weights);
  }
  void set_joints(Entity entity, const dvec3& origin, std::vector<mat4> matrices) {
    auto& joints = world_.resource<JointMatrices>();
    joints.ranges = {{entity, 0, static_cast<std::uint32_t>(matrices.size()), origin, false}};
    joints.matrices = std::move(matrices);
  }
  [[nodiscard]] FrameDraws lists_of(const RenderView& view) {
    return test::frame_draws(world_, view, scene_, *serial_);
  }

  std::mt19937 random_{41};
  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  std::unique_ptr<JobExecutor> serial_ = make_serial_executor();
  Pipelines pipelines_{*device_};
  GpuScene scene_{*device_, pipelines_};
  World world_;
  test::SceneMaker maker_{world_};
  Entity drawn_ = kNoEntity;
  RenderView ahead_ = make_view(test::look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 64, 64), 0);  ///< sees −Z
};

/// A quad with morph targets that move it along ±Z.
Primitive pushed_quad(std::size_t targets) {
  Primitive quad = test::quad(1.0f);
  for (std::size_t t = 0; t < targets; ++t) {
    const float z = t % 2 == 0 ? 10.0f : -10.0f;
    quad.morph_targets.push_back({std::vector<vec3>(4, vec3(0.0f, 0.0f, z)), {}});
  }
  return quad;
}

TEST_F(DeformedCulling, morphed_meshes_are_culled_where_their_weights_move_them) {
  const std::uint32_t mesh = maker_.mesh(pushed_quad(2));
  sync();
  const Entity quad = draw(mesh, at({0.0, 0.0, 5.0}));  // behind the camera
  set_weights(quad, {0.0f, 0.0f});
  EXPECT_EQ(lists_of(ahead_).views[0].culled_instances, 1u);
  EXPECT_TRUE(lists_of(ahead_).views[0].solid.empty());
  EXPECT_TRUE(lists_of(ahead_).deforms.empty()) << "what nobody sees is not deformed";
  world_.resource<MorphWeights>().values = {0.0f, 1.0f};  // 5 m before the camera
  EXPECT_EQ(lists_of(ahead_).views[0].culled_instances, 0u);
  ASSERT_EQ(lists_of(ahead_).views[0].solid.size(), 1u);
  EXPECT_NEAR(lists_of(ahead_).views[0].solid[0].depth_m, 5.0f, 1e-4f);
  world_.resource<MorphWeights>().values = {-1.0f, 0.0f};  // the same by a negative weight
  EXPECT_EQ(lists_of(ahead_).views[0].solid.size(), 1u);
  world_.resource<MorphWeights>().values = {1.0f, 1.0f};  // moved back to its place
  EXPECT_EQ(lists_of(ahead_).views[0].culled_instances, 1u);
}

TEST_F(DeformedCulling, no_visible_morphed_or_posed_vertex_is_ever_culled) {
  constexpr std::size_t kTargets = 3;
  Primitive morphed = test::box(vec3(0.5f, 1.0f, 0.25f));
  for (std::size_t t = 0; t < kTargets; ++t) {
    Primitive::MorphTarget& target = morphed.morph_targets.emplace_back();
    for (std::size_t v = 0; v < morphed.positions.size(); ++v) target.positions.push_back(vec3(point(2.0)));
  }
  Primitive both = morphed;
  both.joints.assign(both.positions.size(), {0, 1, 0, 0});
  both.weights.assign(
      both.positions.size(),
      vec4(0.5f, 0.5f, 0.0f, 0.0f));  // 32767.5 of 65535 each: rounded, so the checks below need a tolerance
  const std::uint32_t meshes[] = {maker_.mesh(morphed), maker_.mesh(both)};
  sync();
  std::uint64_t visible = 0, culled = 0;
  for (int round = 0; round < test::scaled(1000); ++round) {
    const bool skinned = round % 2 == 0;
    const dvec3 origin = point(round % 3 == 0 ? 1e5 : 10.0);
    const dmat4 matrix = at(origin) * glm::rotate(dmat4(1.0), in(0.0, 6.0), glm::normalize(point(1.0)));
    const Entity entity = draw(meshes[skinned ? 1 : 0], matrix, skinned ? 0 : kNone);
    std::vector<float> weights;
    for (std::size_t t = 0; t < kTargets; ++t) weights.push_back(static_cast<float>(in(-2.0, 2.0)));
    set_weights(entity, weights);
    const std::vector<mat4> joints = {mat4(at(point(4.0))), mat4(at(point(4.0)))};
    set_joints(entity, origin, joints);
    const dvec3 eye = origin + point(12.0);
    const RenderView view = make_view(test::look_at(eye, eye + glm::normalize(point(1.0)), 64, 48), 0);
    const FrameDraws lists = lists_of(view);
    culled += lists.views[0].culled_instances;
    ASSERT_EQ(lists.views[0].solid.size() + lists.views[0].culled_instances, 1u);
    for (std::size_t v = 0; v < morphed.positions.size(); ++v) {
      dvec3 vertex(morphed.positions[v]);
      for (std::size_t t = 0; t < kTargets; ++t)
        vertex += static_cast<double>(weights[t]) * dvec3(morphed.morph_targets[t].positions[v]);
      const dvec4 moved =
          skinned ? 0.5 * (dmat4(joints[0]) + dmat4(joints[1])) * dvec4(vertex, 1.0) : matrix * dvec4(vertex, 1.0);
      const dvec3 relative = dvec3(moved) + (skinned ? origin : dvec3(0.0)) - view.position;
      if (!test::surely_visible(view, relative)) continue;
      ++visible;
      ASSERT_EQ(lists.views[0].solid.size(), 1u) << "a vertex is visible, round " << round << " vertex " << v;
      ASSERT_LE(lists.views[0].solid[0].depth_m, test::view_depth(view, relative) + 1e-3);
    }
  }
  EXPECT_GT(visible, 0u) << "the scenes show nothing";
  EXPECT_GT(culled, 0u) << "nothing was culled at all";
}

TEST_F(DeformedCulling, a_mesh_with_joints_that_have_no_matrix_is_never_culled) {
  const std::uint32_t mesh = maker_.mesh(test::skinned_bar());  // follows joints 0 and 1
  sync();
  const Entity bar = draw(mesh, dmat4(1.0), 0);
  const dvec3 behind(0.0, 0.0, 20.0);
  set_joints(bar, behind, {mat4(1.0f), mat4(1.0f)});
  EXPECT_EQ(lists_of(ahead_).views[0].culled_instances, 1u) << "all of it is behind the camera";
  set_joints(bar, behind, {mat4(1.0f)});
  EXPECT_EQ(lists_of(ahead_).views[0].culled_instances, 0u) << "where joint 1 is, is not known";
  EXPECT_EQ(lists_of(ahead_).views[0].solid.size(), 1u);
}

TEST_F(DeformedCulling, a_mesh_with_unknown_or_infinite_weights_is_never_culled) {
  const std::uint32_t mesh = maker_.mesh(pushed_quad(1));
  sync();
  const Entity quad = draw(mesh, at({0.0, 0.0, 5.0}));
  for (const float weight : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    set_weights(quad, {weight});
    EXPECT_EQ(lists_of(ahead_).views[0].solid.size(), 1u) << weight;
  }
  world_.resource<MorphWeights>().values.clear();  // the morph system has not run
  EXPECT_EQ(lists_of(ahead_).views[0].solid.size(), 1u);
}

}  // namespace
}  // namespace gloam
