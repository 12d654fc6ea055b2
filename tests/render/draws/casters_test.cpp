// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/draws/casters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/draws/draw_lists.h"
#include "engine/scene/gltf/import.h"
#include "tests/jobs/executors.h"
#include "tests/render/draws/one_view.h"
#include "tests/render/draws/small_scene.h"

namespace gloam {
namespace {

dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }
dmat4 scaled_by(const dvec3& scale) { return glm::scale(dmat4(1.0), scale); }

bool is_known(const Caster& caster) { return glm::all(glm::lessThanEqual(caster.bounds_min, caster.bounds_max)); }

void expect_near(const dvec3& value, const dvec3& expected, double bound) {
  EXPECT_LT(glm::length(value - expected), bound) << value.x << " " << value.y << " " << value.z;
}

/// A world, its scene on a recording device, and a camera at the origin that looks along −Z.
class Casters : public ::testing::Test {
 protected:
  Casters() { prepare_scene_world(world_); }
  void TearDown() override { EXPECT_TRUE(device_->faults().empty()) << device_->faults().front(); }

  [[nodiscard]] FrameDraws lists(bool with_casters = true) {
    const Status status = scene_.sync(maker_.assets(), *serial_);
    EXPECT_TRUE(status.ok());
    return test::frame_draws(world_, view_, scene_, *serial_, with_casters);
  }
  [[nodiscard]] Caster only_caster() {
    const FrameDraws made = lists();
    EXPECT_EQ(made.casters.casters.size(), 1u);
    return made.casters.casters.empty() ? Caster{} : made.casters.casters[0];
  }
  /// Draws a bar of 4 m that follows two joints with these matrices, which are relative to `origin`.
  Entity draw_bar(const dvec3& origin, const mat4& lower, const mat4& upper, std::uint32_t material = kNone) {
    const Entity entity = world_.create(WorldTransform{}, MeshInstance{maker_.mesh(test::skinned_bar(material)), 0});
    auto& joints = world_.resource<JointMatrices>();
    joints.ranges.push_back({entity, static_cast<std::uint32_t>(joints.matrices.size()), 2, origin, false});
    joints.matrices.insert(joints.matrices.end(), {lower, upper});
    return entity;
  }
  [[nodiscard]] std::uint32_t glass() {
    Material blended;
    blended.alpha_mode = AlphaMode::blend;
    return maker_.material(blended);
  }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  std::unique_ptr<JobExecutor> serial_ = make_serial_executor();
  Pipelines pipelines_{*device_};
  GpuScene scene_{*device_, pipelines_};
  World world_;
  test::SceneMaker maker_{world_};
  RenderView view_ = make_view(test::look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 64, 64), 0);
};

TEST_F(Casters, are_listed_wherever_the_camera_looks) {
  const std::uint32_t mesh = maker_.mesh(test::box(vec3(1.0f, 2.0f, 3.0f)));
  const Entity behind = maker_.draw(mesh, at(5.0, 6.0, 50.0));
  const FrameDraws made = lists();
  EXPECT_TRUE(made.views[0].solid.empty()) << "the camera does not see it";
  EXPECT_EQ(made.views[0].culled_instances, 1u);
  ASSERT_EQ(made.casters.casters.size(), 1u);
  const Caster& caster = made.casters.casters[0];
  EXPECT_EQ(caster.entity, behind);
  EXPECT_EQ(caster.primitive, &scene_.meshes()[mesh][0]);
  EXPECT_EQ(caster.deform, kNone);
  EXPECT_FALSE(caster.moving);
  expect_near(caster.bounds_min, dvec3(4.0, 4.0, 47.0), 1e-9);
  expect_near(caster.bounds_max, dvec3(6.0, 8.0, 53.0), 1e-9);
}

TEST_F(Casters, are_not_listed_when_nobody_asks) {
  maker_.draw(maker_.mesh(test::box(vec3(1.0f))), at(0.0, 0.0, -5.0));
  draw_bar(dvec3(0.0, 0.0, 50.0), mat4(1.0f), mat4(1.0f));
  const FrameDraws made = lists(false);
  EXPECT_TRUE(made.casters.casters.empty());
  EXPECT_EQ(made.views[0].solid.size(), 1u);
  EXPECT_TRUE(made.deforms.empty()) << "what nobody sees is not deformed";
}

TEST_F(Casters, do_not_change_what_is_drawn) {
  test::fill_small_scene(world_);
  const FrameDraws without = lists(false);
  const FrameDraws with = lists();
  ASSERT_EQ(with.views[0].solid.size(), without.views[0].solid.size());
  ASSERT_EQ(with.views[0].blended.size(), without.views[0].blended.size());
  EXPECT_EQ(with.views[0].culled_instances, without.views[0].culled_instances);
  for (std::size_t i = 0; i < with.views[0].solid.size(); ++i) {
    EXPECT_EQ(with.views[0].solid[i].primitive, without.views[0].solid[i].primitive);
    EXPECT_EQ(with.views[0].solid[i].index_count, without.views[0].solid[i].index_count);
  }
}

TEST_F(Casters, leave_blended_surfaces_out_and_know_cut_outs_and_subsurface) {
  Material leaf;
  leaf.alpha_mode = AlphaMode::mask;
  leaf.double_sided = true;
  leaf.subsurface = true;
  const std::uint32_t leaf_mesh = maker_.mesh(test::quad(1.0f, maker_.material(leaf)));
  const std::uint32_t glass_material = glass();
  maker_.draw(maker_.mesh(test::quad(1.0f, glass_material)), at(0.0, 0.0, -5.0));
  draw_bar(dvec3(0.0, 0.0, 50.0), mat4(1.0f), mat4(1.0f), glass_material);
  maker_.draw(leaf_mesh, at(0.0, 0.0, -6.0));
  const FrameDraws made = lists();
  EXPECT_EQ(made.views[0].blended.size(), 1u);
  EXPECT_TRUE(made.deforms.empty()) << "glass out of sight is not deformed";
  ASSERT_EQ(made.casters.casters.size(), 1u);
  EXPECT_TRUE(made.casters.casters[0].subsurface);
  EXPECT_NE(made.casters.casters[0].variant.features & GLOAM_SURFACE_MASK, 0u);
  EXPECT_EQ(made.casters.casters[0].variant.cull, gpu::CullMode::none);
}

TEST_F(Casters, mirrored_flat_and_sheared_nodes_have_their_bounds_and_winding) {
  const std::uint32_t mesh = maker_.mesh(test::box(vec3(1.0f, 2.0f, 3.0f)));
  const Entity box = maker_.draw(mesh);
  const auto with = [&](const dmat4& m) {
    world_.get<WorldTransform>(box).matrix = m;
    return only_caster();
  };
  const Caster mirrored = with(at(10.0, 0.0, 0.0) * scaled_by(dvec3(-2.0, 1.0, 1.0)));
  EXPECT_EQ(mirrored.variant.cull, gpu::CullMode::front);
  expect_near(mirrored.bounds_min, dvec3(8.0, -2.0, -3.0), 1e-9);
  expect_near(mirrored.bounds_max, dvec3(12.0, 2.0, 3.0), 1e-9);

  const Caster flat = with(at(0.0, 7.0, 0.0) * scaled_by(dvec3(1.0, 0.0, 1.0)));
  EXPECT_TRUE(is_known(flat));
  EXPECT_EQ(flat.variant.cull, gpu::CullMode::back);
  expect_near(flat.bounds_min, dvec3(-1.0, 7.0, -3.0), 1e-9);
  expect_near(flat.bounds_max, dvec3(1.0, 7.0, 3.0), 1e-9);

  dmat4 shear(1.0);
  shear[1][0] = 0.5;  // x += y / 2
  const Caster sheared = with(shear);
  expect_near(sheared.bounds_min, dvec3(-2.0, -2.0, -3.0), 1e-9);
  expect_near(sheared.bounds_max, dvec3(2.0, 2.0, 3.0), 1e-9);

  dmat4 broken(1.0);
  broken[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_known(with(broken)));
}

TEST_F(Casters, a_posed_bar_is_bounded_where_its_joints_put_it) {
  // The upper half is turned to lie along −X.
  const mat4 upper = glm::translate(mat4(1.0f), vec3(0.0f, 2.0f, 0.0f)) *
                     glm::rotate(mat4(1.0f), 1.5707964f, vec3(0.0f, 0.0f, 1.0f)) *
                     glm::translate(mat4(1.0f), vec3(0.0f, -2.0f, 0.0f));
  draw_bar(dvec3(0.0, 0.0, 1e5), mat4(1.0f), upper);
  const FrameDraws made = lists();
  EXPECT_TRUE(made.views[0].solid.empty());
  ASSERT_EQ(made.deforms.size(), 1u) << "it casts: it is deformed though nobody sees it";
  EXPECT_EQ(made.deformed_vertices, 64u);
  ASSERT_EQ(made.casters.casters.size(), 1u);
  const Caster& bar = made.casters.casters[0];
  EXPECT_TRUE(bar.moving);
  EXPECT_EQ(bar.deform, 0u);
  EXPECT_EQ(dvec3(bar.world_from_mesh[3]), dvec3(0.0, 0.0, 1e5));
  // Ring 2 follows both joints, so that each joint's box holds it.
  expect_near(bar.bounds_min, dvec3(-2.0, 0.0, 1e5 - 0.5), 1e-5);
  expect_near(bar.bounds_max, dvec3(0.5, 2.5, 1e5 + 0.5), 1e-5);
}

TEST_F(Casters, a_morphed_mesh_is_bounded_by_its_weights) {
  Primitive flag = test::quad(1.0f);
  flag.morph_targets.push_back({std::vector<vec3>(4, vec3(0.0f, 0.0f, 8.0f)), {}});
  flag.morph_targets.push_back({{vec3(1.0f), vec3(0.0f), vec3(0.0f), vec3(0.0f)}, {}});
  const Entity entity = maker_.draw(maker_.mesh(flag), at(0.0, 0.0, 100.0));
  world_.add<MorphInstance>(entity, {1, 2});
  EXPECT_FALSE(is_known(only_caster())) << "its weights are not there";
  world_.resource<MorphWeights>().values = {9.0f, 0.5f, -2.0f};
  const Caster moved = only_caster();
  EXPECT_TRUE(moved.moving);
  expect_near(moved.bounds_min, dvec3(-3.0, -3.0, 102.0), 1e-5);
  expect_near(moved.bounds_max, dvec3(1.0, 1.0, 104.0), 1e-5);
}

TEST_F(Casters, deformed_draws_and_casters_share_one_job) {
  draw_bar(dvec3(0.0, -2.0, -20.0), mat4(1.0f), mat4(1.0f));
  draw_bar(dvec3(0.0, -2.0, 20.0), mat4(1.0f), mat4(1.0f));
  const FrameDraws made = lists();
  ASSERT_EQ(made.deforms.size(), 2u);
  ASSERT_EQ(made.views[0].solid.size(), 1u);
  ASSERT_EQ(made.casters.casters.size(), 2u);
  EXPECT_EQ(made.views[0].solid[0].deform, made.casters.casters[0].deform);
  EXPECT_NE(made.casters.casters[0].deform, made.casters.casters[1].deform);
  for (const Caster& caster : made.casters.casters) EXPECT_EQ(made.deforms[caster.deform].primitive, caster.primitive);
}

TEST_F(Casters, come_by_entity_and_primitive_whatever_the_executor) {
  std::mt19937 random(5);
  const std::uint32_t box = maker_.mesh(test::box(vec3(1.0f)));
  maker_.assets().meshes[box].primitives.push_back(test::quad(1.0f));
  const std::uint32_t bar = maker_.mesh(test::skinned_bar());
  auto& joints = world_.resource<JointMatrices>();
  joints.matrices.assign(2, mat4(1.0f));
  for (int i = 0; i < 700; ++i) {
    const double z = std::uniform_real_distribution<double>(-50.0, 50.0)(random);
    if (i % 3 != 0) {
      // Two archetypes, so that the world's order differs from the order of entities.
      const Entity entity = maker_.draw(box, at(0.0, 0.0, z));
      if (i % 3 == 1) world_.add<SourceNode>(entity, {0});
      continue;
    }
    const Entity entity = world_.create(WorldTransform{}, MeshInstance{bar, 0});
    joints.ranges.push_back({entity, 0, 2, dvec3(0.0, 0.0, z), false});
  }
  const FrameDraws first = lists();
  const auto key = [](const Caster& c) { return std::pair(c.entity.index, c.primitive); };
  EXPECT_EQ(first.casters.casters.size(), 234u + 2u * 466u);
  EXPECT_TRUE(std::ranges::is_sorted(first.casters.casters, {}, key));
  for (const test::ExecutorCase& executor : test::all_executors()) {
    const FrameDraws again = test::frame_draws(world_, view_, scene_, *executor.make(), true);
    const auto same = [](const Caster& a, const Caster& b) {
      return a.entity == b.entity && a.primitive == b.primitive && a.deform == b.deform &&
             a.bounds_min == b.bounds_min && a.bounds_max == b.bounds_max && a.world_from_mesh == b.world_from_mesh;
    };
    EXPECT_TRUE(std::ranges::equal(again.casters.casters, first.casters.casters, same)) << executor.name;
    EXPECT_EQ(again.deforms.size(), first.deforms.size()) << executor.name;
  }
}

TEST_F(Casters, constants_are_relative_to_any_origin_without_losing_digits) {
  const dmat4 turn = glm::rotate(dmat4(1.0), 0.7, glm::normalize(dvec3(1.0, 2.0, 3.0)));
  const dvec3 far(1e5 + 0.123456789, -2e5 + 0.333333333, 1e5 - 0.777777777);
  maker_.draw(maker_.mesh(test::box(vec3(1.0f))), at(far.x, far.y, far.z) * turn * scaled_by(dvec3(-1.0, 2.0, 1.0)));
  const Caster caster = only_caster();
  const dvec3 origin = far + dvec3(0.25, -3.0, 1.5);
  const shaders::DrawConstants constants = caster_constants(caster, origin);
  EXPECT_EQ(constants.flags, GLOAM_DRAW_MIRRORED);
  const vec4 rows[] = {constants.row0, constants.row1, constants.row2};
  for (int row = 0; row < 3; ++row) {
    const dvec4 exact(caster.world_from_mesh[0][row], caster.world_from_mesh[1][row], caster.world_from_mesh[2][row],
                      caster.world_from_mesh[3][row] - origin[row]);
    EXPECT_EQ(rows[row], vec4(exact));
  }
  EXPECT_NEAR(constants.row0.w, -0.25, 1e-7);
}

}  // namespace
}  // namespace gloam
