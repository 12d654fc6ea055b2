// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <random>

#include "engine/scene/gltf/import.h"
#include "modules/accuracy/module.h"
#include "modules/accuracy/tracing/scene_triangles.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

/// A world, and segments traced through it.
class Tracing : public testing::Test {
 protected:
  Tracing() { prepare_scene_world(world_); }

  void trace_with(JobExecutor& executor, const std::optional<dvec3>& origin = dvec3(0.0)) {
    auto tracer = make_scene_tracer(world_, executor, origin);
    ASSERT_TRUE(tracer.ok());
    tracer_ = std::move(tracer).value();
  }
  void trace() { trace_with(*serial_); }

  /// Whether anything lies between two world positions.
  [[nodiscard]] bool blocked(const dvec3& from, const dvec3& to) const {
    const ShadowRay ray{.origin = vec3(from - tracer_->origin()), .direction = vec3(to - from)};
    std::uint8_t answer = 2;
    tracer_->occluded({&ray, 1}, {&answer, 1});
    return answer == 1;
  }

  World world_;
  test::SceneMaker maker_{world_};
  std::unique_ptr<JobExecutor> serial_ = make_serial_executor();
  std::unique_ptr<SceneTracer> tracer_;
};

TEST_F(Tracing, an_empty_world_blocks_nothing) {
  trace();
  EXPECT_EQ(tracer_->triangles(), 0u);
  EXPECT_FALSE(blocked({0, 0, 0}, {0, 0, 100}));
}

TEST_F(Tracing, a_box_blocks_what_crosses_it_and_nothing_else) {
  maker_.draw(maker_.mesh(test::box({0.5f, 1.0f, 2.0f})), glm::translate(dmat4(1.0), dvec3(3.0, 0.0, 0.0)));
  trace();
  EXPECT_EQ(tracer_->triangles(), 12u);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-6.0, 6.0);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const dvec3 from(place(random), place(random), place(random)), to(place(random), place(random), place(random));
    // Slab test: the interval in which the segment is inside all three slabs. Both ends are outside the box.
    const dvec3 low(2.5, -1.0, -2.0), high(3.5, 1.0, 2.0);
    const auto within = [&](const dvec3& p) {
      return glm::all(glm::greaterThan(p, low - 1e-3)) && glm::all(glm::lessThan(p, high + 1e-3));
    };
    if (within(from) || within(to)) continue;
    double enter = 0.0, leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (low[axis] - from[axis]) / (to[axis] - from[axis]);
      const double b = (high[axis] - from[axis]) / (to[axis] - from[axis]);
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (std::abs(leave - enter) < 1e-4) continue;  // grazes an edge
    EXPECT_EQ(blocked(from, to), enter < leave);
    inside += enter < leave ? 1 : 0;
  }
  EXPECT_GT(inside, 20);
}

TEST_F(Tracing, both_sides_of_a_sheet_block) {
  maker_.draw(maker_.mesh(test::quad(1.0f)));
  trace();
  EXPECT_TRUE(blocked({0.2, 0.3, 1.0}, {0.2, 0.3, -1.0}));
  EXPECT_TRUE(blocked({0.2, 0.3, -1.0}, {0.2, 0.3, 1.0}));
  EXPECT_FALSE(blocked({1.2, 0.3, 1.0}, {1.2, 0.3, -1.0}));
  EXPECT_FALSE(blocked({0.2, 0.3, 1.0}, {0.2, 0.3, 0.01}));
}

TEST_F(Tracing, segments_end_where_they_say) {
  maker_.draw(maker_.mesh(test::quad(1.0f)));
  trace();
  const auto share = [&](float from, float to) {
    const ShadowRay ray{.origin = {0, 0, 1}, .direction = {0, 0, -2}, .from = from, .to = to};
    std::uint8_t answer = 2;
    tracer_->occluded({&ray, 1}, {&answer, 1});
    return answer;
  };
  EXPECT_EQ(share(0.0f, 1.0f), 1);
  EXPECT_EQ(share(0.0f, 0.49f), 0);
  EXPECT_EQ(share(0.51f, 1.0f), 0);
  EXPECT_EQ(share(0.0f, std::numeric_limits<float>::infinity()), 1);
  EXPECT_EQ(share(0.9f, 0.1f), 0) << "an empty segment";
}

TEST_F(Tracing, no_ray_slips_through_the_seams_of_a_fine_mesh) {
  Primitive grid;
  constexpr int kTexels = 64;
  for (int y = 0; y <= kTexels; ++y)
    for (int x = 0; x <= kTexels; ++x)
      grid.positions.push_back(
          {static_cast<float>(x) / 7.0f, static_cast<float>(y) / 7.0f, std::sin(static_cast<float>(x * y))});
  for (std::uint32_t y = 0; y < kTexels; ++y)
    for (std::uint32_t x = 0; x < kTexels; ++x) {
      const std::uint32_t a = y * (kTexels + 1) + x, b = a + kTexels + 1;
      grid.indices.insert(grid.indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  maker_.draw(maker_.mesh(test::finished(std::move(grid))));
  trace();
  // Rays through every vertex and along the edges: a tracer that is not watertight fails here.
  for (int y = 1; y < kTexels; ++y)
    for (int x = 1; x < kTexels; ++x)
      for (const double shift : {0.0, 0.5}) {
        const dvec3 at((x + shift) / 7.0, y / 7.0, 0.0);
        ASSERT_TRUE(blocked(at + dvec3(0, 0, 5), at - dvec3(0, 0, 5))) << x << " " << y;
      }
}

TEST_F(Tracing, rays_pass_through_holes_of_cut_out_surfaces) {
  // The left half is a hole, the right half is solid.
  const std::uint32_t texture = maker_.texture(2, 1, {255, 255, 255, 0, 255, 255, 255, 255}, true);
  Material material;
  material.alpha_mode = AlphaMode::mask;
  material.base_color_texture.texture = texture;
  maker_.draw(maker_.mesh(test::quad(1.0f, maker_.material(material))));
  trace();
  for (const double y : {-0.9, 0.1, 0.8}) {
    EXPECT_FALSE(blocked({-0.02, y, 1.0}, {-0.02, y, -1.0}));
    EXPECT_FALSE(blocked({-0.95, y, -1.0}, {-0.95, y, 1.0}));
    EXPECT_TRUE(blocked({0.02, y, 1.0}, {0.02, y, -1.0}));
    EXPECT_TRUE(blocked({0.95, y, -1.0}, {0.95, y, 1.0}));
  }
}

TEST_F(Tracing, a_surface_behind_a_hole_still_blocks) {
  const std::uint32_t texture = maker_.texture(1, 1, {255, 255, 255, 0}, true);
  Material material;
  material.alpha_mode = AlphaMode::mask;
  material.base_color_texture.texture = texture;
  maker_.draw(maker_.mesh(test::quad(1.0f, maker_.material(material))));
  maker_.draw(maker_.mesh(test::quad(0.5f)), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -1.0)));
  trace();
  EXPECT_TRUE(blocked({0.2, 0.2, 1.0}, {0.2, 0.2, -2.0}));
  EXPECT_FALSE(blocked({0.7, 0.2, 1.0}, {0.7, 0.2, -2.0}));
}

TEST_F(Tracing, blended_surfaces_cast_nothing) {
  Material material;
  material.alpha_mode = AlphaMode::blend;
  maker_.draw(maker_.mesh(test::quad(1.0f, maker_.material(material))));
  trace();
  EXPECT_EQ(tracer_->triangles(), 0u);
}

TEST_F(Tracing, mirrored_and_sheared_instances_block_where_they_are_drawn) {
  dmat4 matrix(1.0);
  matrix[0] = dvec4(-2.0, 0.0, 0.0, 0.0);  // mirrored, twice as wide
  matrix[1] = dvec4(0.5, 1.0, 0.0, 0.0);   // sheared
  matrix[3] = dvec4(10.0, 0.0, 0.0, 1.0);
  maker_.draw(maker_.mesh(test::quad(1.0f)), matrix);
  trace();
  // Corner (1, 1) is at 10 − 2 + 0.5, corner (−1, 1) at 10 + 2 + 0.5.
  EXPECT_TRUE(blocked({8.6, 0.95, 1.0}, {8.6, 0.95, -1.0}));
  EXPECT_FALSE(blocked({8.3, 0.95, 1.0}, {8.3, 0.95, -1.0}));
  EXPECT_TRUE(blocked({12.4, 0.95, -1.0}, {12.4, 0.95, 1.0}));
}

TEST_F(Tracing, far_from_the_origin_of_the_world_nothing_is_lost) {
  const dvec3 far(100e3, -3e3, 250e3);
  maker_.draw(maker_.mesh(test::quad(1.0f)), glm::translate(dmat4(1.0), far));
  trace_with(*serial_, std::nullopt);
  EXPECT_LT(glm::length(tracer_->origin() - far), 10.0) << "the middle of what is there";
  EXPECT_TRUE(blocked(far + dvec3(0.999, 0.0, 0.001), far + dvec3(0.999, 0.0, -0.001)));
  EXPECT_FALSE(blocked(far + dvec3(1.001, 0.0, 0.001), far + dvec3(1.001, 0.0, -0.001)));
}

TEST_F(Tracing, skinned_instances_block_in_their_pose) {
  Primitive sheet = test::quad(1.0f);
  sheet.joints.assign(4, {0, 1, 0, 0});
  sheet.weights.assign(4, vec4(0.25f, 0.75f, 0.0f, 0.0f));
  const Entity entity = world_.create(WorldTransform{glm::translate(dmat4(1.0), dvec3(500.0))},
                                      MeshInstance{maker_.mesh(std::move(sheet)), 0});
  JointMatrices& joints = world_.resource<JointMatrices>();
  joints.matrices = {mat4(1.0f), glm::translate(mat4(1.0f), vec3(4.0f, 0.0f, 0.0f))};
  joints.ranges = {{.instance = entity, .first = 0, .count = 2, .origin = dvec3(20.0, 0.0, 0.0)}};
  trace();
  // The node's own transform is ignored; the pose is 0.75 · 4 m to the right of the skin's origin.
  EXPECT_TRUE(blocked({22.1, 0.5, 1.0}, {22.1, 0.5, -1.0}));
  EXPECT_TRUE(blocked({23.9, 0.5, 1.0}, {23.9, 0.5, -1.0}));
  EXPECT_FALSE(blocked({21.9, 0.5, 1.0}, {21.9, 0.5, -1.0}));
  EXPECT_FALSE(blocked({24.1, 0.5, 1.0}, {24.1, 0.5, -1.0}));
}

TEST_F(Tracing, morphed_instances_block_as_their_weights_say) {
  Primitive sheet = test::quad(1.0f);
  sheet.morph_targets.push_back({std::vector<vec3>(4, vec3(0.0f, 0.0f, -2.0f)), {}});
  const std::uint32_t mesh = maker_.mesh(std::move(sheet));
  world_.create(WorldTransform{}, MeshInstance{mesh}, MorphInstance{0, 1});
  world_.resource<MorphWeights>().values = {0.5f};
  trace();
  EXPECT_FALSE(blocked({0, 0, 1}, {0, 0, -0.9}));
  EXPECT_TRUE(blocked({0, 0, -0.9}, {0, 0, -1.1}));
}

TEST_F(Tracing, positions_that_are_not_finite_are_left_out) {
  Primitive broken = test::quad(1.0f);
  broken.positions[0].x = std::numeric_limits<float>::quiet_NaN();
  maker_.draw(maker_.mesh(std::move(broken)));
  trace();
  EXPECT_FALSE(blocked({0.5, -0.5, 1.0}, {0.5, -0.5, -1.0}));
  dmat4 matrix(1.0);
  matrix[3].x = std::numeric_limits<double>::infinity();
  maker_.draw(maker_.mesh(test::quad(1.0f)), matrix);
  maker_.draw(maker_.mesh(test::quad(1.0f)), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -3.0)));
  trace_with(*serial_, std::nullopt);
  EXPECT_TRUE(blocked({0.0, 0.0, -2.0}, {0.0, 0.0, -4.0}));
}

TEST_F(Tracing, answers_do_not_depend_on_executor_or_company) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  const std::uint32_t mesh = maker_.mesh(test::box({0.2f, 0.3f, 0.1f}));
  for (int i = 0; i < 300; ++i)
    maker_.draw(mesh, glm::translate(dmat4(1.0), dvec3(place(random), place(random), place(random))));
  std::vector<ShadowRay> rays;
  for (int i = 0; i < 5000; ++i)
    rays.push_back({.origin = vec3(place(random), place(random), place(random)),
                    .direction = vec3(place(random), place(random), place(random))});
  trace();
  std::vector<std::uint8_t> expected(rays.size());
  tracer_->occluded(rays, expected);
  const std::uint64_t version = tracer_->version();
  for (const auto& executor : {make_pool_executor(2), make_shuffled_executor(5)}) {
    trace_with(*executor);
    EXPECT_EQ(tracer_->version(), version);
    std::vector<std::uint8_t> answers(rays.size());
    executor->parallel_for(rays.size(), 333, [&](JobRange range) {
      const std::size_t count = range.end - range.begin;
      tracer_->occluded(std::span(rays).subspan(range.begin, count), std::span(answers).subspan(range.begin, count));
    });
    EXPECT_EQ(answers, expected);
  }
}

TEST_F(Tracing, building_does_not_touch_who_else_uses_tbb) {
  using tbb::global_control;
  const std::size_t before = global_control::active_value(global_control::max_allowed_parallelism);
  maker_.draw(maker_.mesh(test::box(vec3(1.0f))));
  trace();
  EXPECT_EQ(global_control::active_value(global_control::max_allowed_parallelism), before);
}

TEST_F(Tracing, version_tells_worlds_apart) {
  const Entity entity = maker_.draw(maker_.mesh(test::box(vec3(1.0f))));
  trace();
  const std::uint64_t version = tracer_->version();
  trace();
  EXPECT_EQ(tracer_->version(), version);
  world_.get<WorldTransform>(entity).matrix[3].x = 1e-3;
  trace();
  EXPECT_NE(tracer_->version(), version);
}

/// Two texels, with alpha 0 and 1.
CutOut two_texels(bool nearest, WrapMode wrap) {
  CutOut cut_out;
  cut_out.width = 2;
  cut_out.height = 1;
  cut_out.texels = {0, 255};
  cut_out.nearest = nearest;
  cut_out.wrap_u = cut_out.wrap_v = wrap;
  return cut_out;
}

TEST(CutOuts, bilinear_alpha_crosses_the_cutoff_between_texel_centres) {
  CutOut cut_out = two_texels(false, WrapMode::clamp_to_edge);
  EXPECT_TRUE(cut_out.is_hole({0.49f, 0.5f}, 1.0f));
  EXPECT_FALSE(cut_out.is_hole({0.51f, 0.5f}, 1.0f));
  cut_out.cutoff = 0.25f;  // reached at a quarter of the way between the texel centres 0.25 and 0.75
  EXPECT_TRUE(cut_out.is_hole({0.37f, 0.5f}, 1.0f));
  EXPECT_FALSE(cut_out.is_hole({0.38f, 0.5f}, 1.0f));
}

TEST(CutOuts, textures_wrap_as_their_sampler_says) {
  const auto hole = [](WrapMode mode, float u) { return two_texels(true, mode).is_hole({u, 0.3f}, 1.0f); };
  EXPECT_TRUE(hole(WrapMode::repeat, 1.2f));
  EXPECT_FALSE(hole(WrapMode::repeat, -0.2f));
  EXPECT_FALSE(hole(WrapMode::mirrored_repeat, 1.2f));
  EXPECT_TRUE(hole(WrapMode::mirrored_repeat, -0.2f));
  EXPECT_FALSE(hole(WrapMode::clamp_to_edge, 1.2f));
  EXPECT_TRUE(hole(WrapMode::clamp_to_edge, -0.2f));
  EXPECT_TRUE(hole(WrapMode::repeat, std::numeric_limits<float>::quiet_NaN()));
}

TEST(CutOuts, material_and_vertex_alpha_count) {
  CutOut cut_out;
  cut_out.alpha = 0.8f;
  EXPECT_FALSE(cut_out.is_hole({0, 0}, 1.0f));
  EXPECT_TRUE(cut_out.is_hole({0, 0}, 0.5f));
  cut_out.cutoff = 0.0f;
  EXPECT_FALSE(cut_out.is_hole({0, 0}, 0.0f));
}

}  // namespace
}  // namespace gloam
