// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/draws/draw_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/posing/animation.h"
#include "tests/jobs/executors.h"
#include "tests/render/draws/draw_lists_fixture.h"
#include "tests/render/draws/one_view.h"
#include "tests/render/draws/visible_points.h"
#include "tests/support/render_scene.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

using test::DrawListsTest;
using test::drawn_order;
using test::grid;
using test::placed;
using test::surely_visible;
using test::view_depth;

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  [[nodiscard]] double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  [[nodiscard]] dvec3 point(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  [[nodiscard]] dvec3 direction() { return glm::normalize(point(1.0) + dvec3(1e-3, 0.0, 0.0)); }
  [[nodiscard]] std::uint32_t below(std::uint32_t end) {
    return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(engine_);
  }

 private:
  std::mt19937 engine_;
};

/// Random triangles: each is around a point within `reach`.
Primitive soup(Random& random, std::uint32_t triangles, double reach, double size) {
  Primitive p;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const dvec3 at = random.point(reach);
    for (int corner = 0; corner < 3; ++corner) p.positions.push_back(vec3(at + random.point(size)));
  }
  p.normals.assign(p.positions.size(), vec3(0.0f, 1.0f, 0.0f));
  return test::finished(std::move(p));
}

Primitive skinned(Primitive p, Random& random, std::uint32_t joints) {
  for (std::size_t v = 0; v < p.positions.size(); ++v) {
    std::array<std::uint16_t, 4> own{};
    for (std::uint16_t& joint : own) joint = static_cast<std::uint16_t>(random.below(joints));
    vec4 weights(random.in(0, 1), random.in(0, 1), random.in(0, 1), random.in(0, 1));
    if (v % 4 == 1) weights = vec4(1.0f, 0.0f, 0.0f, 0.0f);
    if (v % 16 == 2) weights = vec4(0.0f);  // degenerate: the first joint gets all the weight
    const float sum = weights.x + weights.y + weights.z + weights.w;
    p.joints.push_back(own);
    p.weights.push_back(sum > 0.0f ? weights / sum : weights);
  }
  return p;
}

RenderView random_view(Random& random, const dvec3& around) {
  const dvec3 eye = around + random.point(30.0);
  ViewSettings settings = test::look_at(eye, eye + random.direction(), 1 + random.below(1000), 1 + random.below(1000));
  settings.camera.fov_y = static_cast<float>(random.in(0.05, 2.5));
  settings.camera.near_m = static_cast<float>(random.in(0.01, 2.0));
  settings.camera.orthographic = random.below(4) == 0;
  settings.camera.half_height_m = static_cast<float>(random.in(0.5, 30.0));
  settings.camera.far_m = static_cast<float>(random.in(5.0, 60.0));
  return make_view(settings, 0);
}

using Constants = std::array<float, 12>;

Constants expected_rows(const dmat4& world_from_mesh, const RenderView& view) {
  Constants rows{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      const double value = world_from_mesh[column][row] - (column == 3 ? view.position[row] : 0.0);
      rows[static_cast<std::size_t>(4 * row + column)] = static_cast<float>(value);
    }
  return rows;
}
Constants rows_of(const Draw& draw) {
  Constants rows{};
  std::memcpy(rows.data(), &draw.constants, sizeof(rows));
  return rows;
}

std::vector<const Draw*> draws_of(const FrameDraws& lists, const GpuPrimitive& primitive, const Constants& rows) {
  std::vector<const Draw*> found;
  for (const std::vector<Draw>* list : {&lists.views[0].solid, &lists.views[0].blended})
    for (const Draw& draw : *list)
      if (draw.primitive == &primitive && rows_of(draw) == rows) found.push_back(&draw);
  return found;
}

bool covers(const std::vector<const Draw*>& draws, std::uint32_t index) {
  return std::any_of(draws.begin(), draws.end(),
                     [&](const Draw* d) { return d->first_index <= index && index < d->first_index + d->index_count; });
}

/// Checks the draws of one instance: each is a run of whole clusters, and a culled cluster lies between any two runs.
void expect_maximal_cluster_runs(std::vector<const Draw*> draws, const GpuPrimitive& primitive) {
  std::ranges::sort(draws, {}, [](const Draw* d) { return d->first_index; });
  std::set<std::uint32_t> borders = {primitive.first_index + primitive.index_count};
  for (const Cluster& cluster : primitive.clusters) borders.insert(primitive.first_index + cluster.first_index);
  for (std::size_t i = 0; i < draws.size(); ++i) {
    ASSERT_TRUE(borders.contains(draws[i]->first_index));
    ASSERT_TRUE(borders.contains(draws[i]->first_index + draws[i]->index_count));
    if (i == 0) continue;
    ASSERT_GT(draws[i]->first_index, draws[i - 1]->first_index + draws[i - 1]->index_count) << "one run, not two";
  }
}

class RandomScenes : public DrawListsTest {
 protected:
  RandomScenes() : random_(11) {
    Material blended;
    blended.alpha_mode = AlphaMode::blend;
    const std::uint32_t glass = maker_.material(blended);
    meshes_ = {maker_.mesh(test::box(vec3(1.0f, 0.5f, 2.0f))), maker_.mesh(grid(20)),
               maker_.mesh(soup(random_, 700, 8.0, 0.5)), maker_.mesh(soup(random_, 3, 0.5, 0.2)),
               maker_.mesh(test::quad(0.7f, glass))};
    for (const std::uint32_t mesh : meshes_) orders_.push_back(drawn_order(maker_.assets().meshes[mesh].primitives[0]));
    sync();
  }

  void check_instance(const FrameDraws& lists, const RenderView& view, std::uint32_t mesh, const dmat4& matrix) {
    const GpuPrimitive& primitive = scene_.meshes()[mesh][0];
    const auto draws = draws_of(lists, primitive, expected_rows(matrix, view));
    const Primitive& source = maker_.assets().meshes[mesh].primitives[0];
    expect_maximal_cluster_runs(draws, primitive);
    const std::vector<std::uint32_t>& order = orders_[mesh];
    for (std::size_t i = 0; i < order.size(); i += 3) {
      dvec3 corner[3];
      for (std::size_t k = 0; k < 3; ++k)
        corner[k] = dvec3(matrix * dvec4(dvec3(source.positions[order[i + k]]), 1.0)) - view.position;
      const dvec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0;
      for (const dvec3& point : {corner[0], corner[1], corner[2], middle, (corner[0] + corner[1]) * 0.5}) {
        if (!surely_visible(view, point)) continue;
        ++visible_points_;
        ASSERT_TRUE(covers(draws, primitive.first_index + static_cast<std::uint32_t>(i)))
            << "a visible triangle is culled";
        for (const Draw* draw : draws) ASSERT_LE(draw->depth_m, view_depth(view, point) * (1.0 + 1e-5) + 1e-4);
      }
    }
  }

  Random random_;
  std::vector<std::uint32_t> meshes_;
  std::vector<std::vector<std::uint32_t>> orders_;
  std::uint64_t visible_points_ = 0;
};

TEST_F(RandomScenes, nothing_visible_is_ever_culled) {
  std::uint64_t culled = 0;
  for (int round = 0; round < test::scaled(2000); ++round) {
    clear();
    const dvec3 around = round % 3 == 0 ? random_.point(1e6) : dvec3(0.0);
    std::vector<std::pair<std::uint32_t, dmat4>> instances;
    const std::uint32_t count = 1 + random_.below(6);
    for (std::uint32_t i = 0; i < count; ++i) {
      dvec3 scale(random_.in(0.1, 3.0), random_.in(0.1, 3.0), random_.in(0.1, 3.0));
      if (random_.below(3) == 0) scale.x = -scale.x;
      const dmat4 matrix = placed(around + random_.point(40.0), random_.direction(), random_.in(0.0, 6.0), scale);
      instances.emplace_back(meshes_[random_.below(5)], matrix);
      draw(instances.back().first, matrix);
    }
    const RenderView view = random_view(random_, around);
    const FrameDraws lists = lists_of(view);
    culled += lists.views[0].culled_instances;
    for (const auto& [mesh, matrix] : instances) {
      check_instance(lists, view, mesh, matrix);
      if (HasFatalFailure()) FAIL() << "in scene " << round;
    }
  }
  EXPECT_GT(visible_points_, 0u) << "the scenes show nothing";
  EXPECT_GT(culled, 0u) << "nothing was culled at all";
}

TEST_F(RandomScenes, lists_are_ordered_by_pipeline_and_depth_whatever_the_executor) {
  for (int i = 0; i < 1500; ++i) {
    const dvec3 scale(i % 3 == 0 ? -1.0 : 1.0, 1.0, 1.0);
    draw(meshes_[random_.below(5)], placed(random_.point(40.0), random_.direction(), random_.in(0.0, 6.0), scale));
  }
  ViewSettings settings = test::look_at(dvec3(0.0, 5.0, 70.0), dvec3(0.0), 640, 360);
  const RenderView view = make_view(settings, 0);
  const FrameDraws first = lists_of(view);
  EXPECT_GT(first.views[0].solid.size(), 500u);
  EXPECT_GT(first.views[0].blended.size(), 50u);
  EXPECT_TRUE(std::ranges::is_sorted(first.views[0].solid, [](const Draw& a, const Draw& b) {
    return std::tie(a.variant, a.depth_m) < std::tie(b.variant, b.depth_m);
  }));
  EXPECT_TRUE(std::ranges::is_sorted(first.views[0].blended,
                                     [](const Draw& a, const Draw& b) { return a.depth_m > b.depth_m; }));
  const auto same = [](const Draw& a, const Draw& b) {
    return a.primitive == b.primitive && a.variant == b.variant &&
           std::memcmp(&a.constants, &b.constants, sizeof(a.constants)) == 0 && a.first_index == b.first_index &&
           a.index_count == b.index_count && a.deform == b.deform && a.depth_m == b.depth_m;
  };
  for (const test::ExecutorCase& executor : test::all_executors()) {
    const FrameDraws lists = test::frame_draws(world_, view, scene_, *executor.make());
    EXPECT_TRUE(std::ranges::equal(lists.views[0].solid, first.views[0].solid, same)) << executor.name;
    EXPECT_TRUE(std::ranges::equal(lists.views[0].blended, first.views[0].blended, same)) << executor.name;
    EXPECT_EQ(lists.views[0].culled_instances, first.views[0].culled_instances) << executor.name;
  }
}

TEST_F(DrawListsTest, mirrored_instances_cull_the_other_faces_and_two_sided_ones_none) {
  Material open;
  open.double_sided = true;
  const std::uint32_t closed_mesh = maker_.mesh(test::box(vec3(1.0f)));
  const std::uint32_t open_mesh = maker_.mesh(test::box(vec3(1.0f), maker_.material(open)));
  sync();
  const RenderView view = make_view(test::look_at(dvec3(0.0, 0.0, 20.0), dvec3(0.0), 64, 64), 0);
  const auto only = [&](std::uint32_t mesh, const dvec3& scale) {
    clear();
    draw(mesh, placed(dvec3(0.0), dvec3(0, 1, 0), 0.5, scale));
    const FrameDraws lists = lists_of(view);
    EXPECT_EQ(lists.views[0].solid.size(), 1u);
    return lists.views[0].solid.empty() ? Draw{} : lists.views[0].solid[0];
  };
  EXPECT_EQ(only(closed_mesh, dvec3(1.0)).variant.cull, gpu::CullMode::back);
  EXPECT_EQ(only(closed_mesh, dvec3(1.0)).constants.flags, 0u);
  EXPECT_EQ(only(closed_mesh, dvec3(1.0, -1.0, 1.0)).variant.cull, gpu::CullMode::front);
  EXPECT_EQ(only(closed_mesh, dvec3(1.0, -1.0, 1.0)).constants.flags, GLOAM_DRAW_MIRRORED);
  EXPECT_EQ(only(closed_mesh, dvec3(-1.0, -1.0, 1.0)).variant.cull, gpu::CullMode::back) << "two mirrors turn";
  EXPECT_EQ(only(closed_mesh, dvec3(-2.0)).variant.cull, gpu::CullMode::front);
  for (const double side : {1.0, -1.0}) {
    const Draw two_sided = only(open_mesh, dvec3(side, 1.0, 1.0));
    EXPECT_EQ(two_sided.variant.cull, gpu::CullMode::none);
    const std::uint32_t flipped = side < 0.0 ? GLOAM_SURFACE_FLIPPED : 0u;
    EXPECT_EQ(two_sided.variant.features, GLOAM_SURFACE_DOUBLE_SIDED | flipped);
  }
}

TEST_F(DrawListsTest, skinned_meshes_are_culled_where_they_are_posed) {
  Random random(12);
  constexpr std::uint32_t kJoints = 5;
  const std::uint32_t mesh = maker_.mesh(skinned(soup(random, 40, 1.0, 0.3), random, kJoints));
  sync();
  const Primitive& source = maker_.assets().meshes[mesh].primitives[0];
  const auto influences = pack_influences(source);
  std::uint64_t visible = 0;
  std::uint64_t culled = 0;
  for (int round = 0; round < test::scaled(500); ++round) {
    clear();
    const dvec3 origin = random.point(round % 2 == 0 ? 20.0 : 1e6);
    std::vector<mat4> matrices;
    for (std::uint32_t j = 0; j < kJoints; ++j)
      matrices.push_back(
          mat4(placed(random.point(6.0), random.direction(), random.in(0.0, 6.0), dvec3(random.in(0.2, 2.0)))));
    draw_skinned(mesh, origin, matrices, round % 5 == 0);
    const RenderView view = random_view(random, origin);
    const FrameDraws lists = lists_of(view);
    culled += lists.views[0].culled_instances;
    ASSERT_EQ(lists.views[0].solid.size() + lists.views[0].culled_instances, 1u);
    ASSERT_EQ(lists.deforms.size(), lists.views[0].solid.size());
    for (std::size_t v = 0; v < source.positions.size(); ++v) {
      const PackedInfluence& p = influences[v];
      const std::uint32_t joints[] = {p.joints01 & 0xFFFFu, p.joints01 >> 16, p.joints23 & 0xFFFFu, p.joints23 >> 16};
      const std::uint32_t weights[] = {p.weights01 & 0xFFFFu, p.weights01 >> 16, p.weights23 & 0xFFFFu,
                                       p.weights23 >> 16};
      dvec3 posed(0.0);
      for (std::size_t k = 0; k < 4; ++k)
        posed += weights[k] / 65535.0 * dvec3(dmat4(matrices[joints[k]]) * dvec4(dvec3(source.positions[v]), 1.0));
      const dvec3 relative = origin + posed - view.position;
      if (!surely_visible(view, relative)) continue;
      ++visible;
      ASSERT_EQ(lists.views[0].solid.size(), 1u) << "a posed vertex is visible, round " << round << " vertex " << v;
      ASSERT_LE(lists.views[0].solid[0].depth_m, view_depth(view, relative) * (1.0 + 1e-5) + 1e-4);
    }
    if (!lists.views[0].solid.empty()) {
      ASSERT_EQ(lists.views[0].solid[0].variant.cull, round % 5 == 0 ? gpu::CullMode::front : gpu::CullMode::back);
      ASSERT_EQ(lists.views[0].solid[0].constants.flags, 0u) << "the kernel has turned normals already";
      ASSERT_EQ(rows_of(lists.views[0].solid[0]), expected_rows(glm::translate(dmat4(1.0), origin), view));
    }
  }
  EXPECT_GT(visible, 0u) << "the scenes show nothing";
  EXPECT_GT(culled, 0u) << "nothing was culled at all";
}

TEST_F(DrawListsTest, deform_jobs_have_vertex_ranges_of_their_own) {
  Random random(13);
  const std::uint32_t bar = maker_.mesh(skinned(test::box(vec3(1.0f)), random, 2));
  Primitive flag = test::quad(1.0f);
  for (int t = 0; t < 2; ++t) {
    flag.morph_targets.push_back({std::vector<vec3>(4, vec3(0.0f, 0.0f, 5.0f)), {}});
    if (t == 1) flag.morph_targets[1].normals.assign(4, vec3(0.0f));
  }
  const std::uint32_t flag_mesh = maker_.mesh(flag);
  sync();
  for (int i = 0; i < 150; ++i) {
    draw_skinned(bar, dvec3(0.0, 0.0, -30.0 - i), {mat4(1.0f), mat4(1.0f)});
    const Entity cloth = draw(flag_mesh, placed(dvec3(0.0, 0.0, -20.0), dvec3(0, 1, 0), 0.1, dvec3(1.0)));
    world_.add<MorphInstance>(cloth, {static_cast<std::uint32_t>(2 * i), 2});
  }
  const FrameDraws lists = lists_of(make_view(test::look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 64, 64), 0));
  ASSERT_EQ(lists.deforms.size(), 300u);
  ASSERT_EQ(lists.views[0].solid.size(), 300u);
  std::set<std::uint32_t> deforms, weights, joints;
  std::uint32_t next = 0;
  for (const DeformJob& job : lists.deforms) {
    EXPECT_EQ(job.first_vertex, next);
    EXPECT_EQ(job.first_vertex % 64, 0u);
    next += (job.primitive->vertex_count + 63) / 64 * 64;
    EXPECT_EQ(job.constants.vertex_count, job.primitive->vertex_count);
    EXPECT_EQ(job.constants.skinned, job.primitive->skinned ? 1u : 0u);
    if (job.constants.skinned != 0) {
      EXPECT_EQ(job.constants.morph_targets, 0u);
      joints.insert(job.constants.first_joint);
    } else {
      EXPECT_EQ(job.constants.morph_targets, 2u);
      EXPECT_EQ(job.constants.morph_has_normals, 0u);
      weights.insert(job.constants.first_weight);
    }
  }
  EXPECT_EQ(lists.deformed_vertices, next);
  EXPECT_EQ(joints.size(), 150u);
  EXPECT_EQ(weights.size(), 150u);
  for (const Draw& d : lists.views[0].solid) {
    ASSERT_LT(d.deform, lists.deforms.size());
    EXPECT_EQ(lists.deforms[d.deform].primitive, d.primitive);
    EXPECT_TRUE(deforms.insert(d.deform).second);
  }
}

TEST_F(DrawListsTest, a_morphed_mesh_is_drawn_even_where_its_rest_bounds_are_out_of_sight) {
  Primitive flag = test::quad(1.0f);
  flag.morph_targets.push_back({std::vector<vec3>(4, vec3(0.0f, 0.0f, -50.0f)), {}});
  const std::uint32_t mesh = maker_.mesh(flag);
  sync();
  const Entity cloth = draw(mesh, placed(dvec3(0.0, 0.0, 20.0), dvec3(0, 1, 0), 0.0, dvec3(1.0)));
  world_.add<MorphInstance>(cloth, {0, 1});
  const RenderView view = make_view(test::look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 64, 64), 0);
  EXPECT_EQ(lists_of(view).views[0].solid.size(), 1u);
  world_.get<MorphInstance>(cloth).count = 0;  // no weights: its rest pose is drawn
  EXPECT_EQ(lists_of(view).views[0].solid.size(), 0u);
}

TEST_F(DrawListsTest, a_static_view_leaves_out_what_moves) {
  Random random(5);
  const std::uint32_t rigid = maker_.mesh(test::box(vec3(0.5f)));
  const std::uint32_t bar = maker_.mesh(skinned(test::box(vec3(0.5f)), random, 1));
  Primitive morphing = test::quad(0.5f);
  morphing.morph_targets = {{std::vector<vec3>(4, vec3(0, 1, 0)), {}}};
  const std::uint32_t flag = maker_.mesh(morphing);
  sync();
  const dmat4 at = glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -5.0));
  const Entity still = draw(rigid, at), turning = draw(rigid, at), carried = draw(rigid, at);
  world_.add(carried, Parent{turning, 1});
  draw_skinned(bar, dvec3(0.0, 0.0, -5.0), {mat4(1.0f)});
  const Entity waving = draw(flag, at);
  world_.add(waving, MorphInstance{0, 1});
  world_.resource<MorphWeights>().values = {0.5f};
  world_.resource<AnimationBindings>().poses = {{turning, 0, 0}};

  RenderView all = make_view(ViewSettings{}, 0), fixed = all;
  fixed.static_only = true;
  const RenderView* const mixed[] = {&all, &fixed};
  const FrameDraws both = build_frame_draws(world_, mixed, scene_, *serial_, {.casters = true});
  EXPECT_EQ(both.views[0].solid.size(), 5u);
  ASSERT_EQ(both.views[1].solid.size(), 1u);
  EXPECT_EQ(both.views[1].solid[0].entity, still);
  EXPECT_EQ(both.casters.casters.size(), 5u) << "the first view shows the shadows of what moves";

  const FrameDraws alone = build_frame_draws(world_, std::span(mixed).subspan(1), scene_, *serial_, {.casters = true});
  EXPECT_EQ(alone.views[0].solid.size(), 1u);
  EXPECT_EQ(alone.casters.casters.size(), 1u);
  EXPECT_TRUE(alone.deforms.empty());
}

TEST_F(DrawListsTest, what_cannot_be_drawn_is_left_out) {
  Random random(14);
  const std::uint32_t empty = maker_.mesh(Primitive{});
  const std::uint32_t bar = maker_.mesh(skinned(test::box(vec3(1.0f)), random, 2));
  sync();
  const dmat4 ahead = placed(dvec3(0.0, 0.0, -10.0), dvec3(0, 1, 0), 0.0, dvec3(1.0));
  draw(empty, ahead);
  draw(77, ahead);  // no such mesh
  const RenderView view = make_view(test::look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 64, 64), 0);
  EXPECT_TRUE(lists_of(view).views[0].solid.empty());
  draw(bar, ahead, 0);  // skinned, but without joint matrices: its rest pose is drawn
  const FrameDraws lists = lists_of(view);
  ASSERT_EQ(lists.views[0].solid.size(), 1u);
  EXPECT_EQ(lists.views[0].solid[0].deform, kNone);
}

TEST_F(DrawListsTest, vertex_colours_are_a_feature_of_the_draw) {
  Primitive colored = test::quad(1.0f);
  colored.colors.assign(4, vec4(0.5f));
  const std::uint32_t mesh = maker_.mesh(colored);
  sync();
  draw(mesh, placed(dvec3(0.0, 0.0, -10.0), dvec3(0, 1, 0), 0.0, dvec3(1.0)));
  const FrameDraws lists = lists_of(make_view(test::look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 64, 64), 0));
  ASSERT_EQ(lists.views[0].solid.size(), 1u);
  EXPECT_EQ(lists.views[0].solid[0].variant.features, GLOAM_SURFACE_VERTEX_COLOR);
}

}  // namespace
}  // namespace gloam
