// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/simplified_casters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/scene/gpu_scene.h"
#include "engine/scene/gltf/import.h"
#include "tests/jobs/executors.h"
#include "tests/render/draws/small_scene.h"

namespace gloam {
namespace {

constexpr float kPi = 3.14159265f;

/// A ball of flat-shaded squares: no two of them share a vertex.
Primitive ball(float radius, std::uint32_t rings, std::uint32_t material = kNone) {
  Primitive p;
  p.material = material;
  const std::uint32_t sectors = 2 * rings;
  const auto at = [&](std::uint32_t ring, std::uint32_t sector) {
    const float a = kPi * static_cast<float>(ring) / static_cast<float>(rings);
    const float b = 2.0f * kPi * static_cast<float>(sector % sectors) / static_cast<float>(sectors);
    if (ring == 0 || ring == rings) return vec3(0.0f, ring == 0 ? radius : -radius, 0.0f);
    return radius * vec3(std::sin(a) * std::cos(b), std::cos(a), -std::sin(a) * std::sin(b));
  };
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const auto first = static_cast<std::uint32_t>(p.positions.size());
      for (const vec3& corner : {at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1)}) p.positions.push_back(corner);
      if (r + 1 < rings) p.indices.insert(p.indices.end(), {first, first + 1, first + 2});
      if (r > 0) p.indices.insert(p.indices.end(), {first, first + 2, first + 3});
    }
  }
  p.normals.assign(p.positions.size(), vec3(0.0f, 1.0f, 0.0f));
  return test::finished(std::move(p));
}

/// A terrain of height `height(x, z)` over side × side cells of 1 m.
template <class Height>
Primitive terrain(std::uint32_t side, Height height) {
  Primitive p;
  for (std::uint32_t z = 0; z <= side; ++z)
    for (std::uint32_t x = 0; x <= side; ++x)
      p.positions.push_back(
          {static_cast<float>(x), height(static_cast<float>(x), static_cast<float>(z)), static_cast<float>(z)});
  p.normals.assign(p.positions.size(), vec3(0.0f, 1.0f, 0.0f));
  for (std::uint32_t z = 0; z < side; ++z) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t i = z * (side + 1) + x;
      for (const std::uint32_t v : {i, i + side + 1, i + 1, i + 1, i + side + 1, i + side + 2}) p.indices.push_back(v);
    }
  }
  return test::finished(std::move(p));
}

float flat(float, float) { return 0.0f; }

using Place = std::tuple<float, float, float>;
Place place_of(const vec3& v) { return {v.x, v.y, v.z}; }

/// Open edges by the positions that they join. An edge counts up in one direction and down in the other, so closed
/// edges cancel.
std::map<std::pair<Place, Place>, int> open_edges(const std::vector<vec3>& positions,
                                                  const std::vector<std::uint32_t>& indices) {
  std::map<std::pair<Place, Place>, int> edges;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Place a = place_of(positions[indices[i + k]]), b = place_of(positions[indices[i + (k + 1) % 3]]);
      a < b ? ++edges[{a, b}] : --edges[{b, a}];
    }
  }
  std::erase_if(edges, [](const auto& edge) { return edge.second == 0; });
  return edges;
}

TEST(SimplifiedCasters, a_fine_ball_loses_most_triangles_and_stays_round_and_closed) {
  for (const float radius : {0.01f, 1.0f, 300.0f}) {
    const Primitive source = ball(radius, 48);
    const std::vector<std::uint32_t> fewer = simplified_indices(source.positions, source.indices);
    ASSERT_FALSE(fewer.empty());
    EXPECT_LT(fewer.size(), source.indices.size() / 4);
    EXPECT_TRUE(open_edges(source.positions, fewer).empty()) << "light must not leak in";
    const float error = 2.0f * std::max(kSimplifiedShare * 2.0f * radius, kSimplifiedError_m);
    for (std::size_t i = 0; i < fewer.size(); i += 3) {
      const vec3 a = source.positions[fewer[i]], b = source.positions[fewer[i + 1]], c = source.positions[fewer[i + 2]];
      ASSERT_GT(glm::length((a + b + c) / 3.0f), radius - error);
      ASSERT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0.0f) << "faces still look outwards";
    }
  }
}

TEST(SimplifiedCasters, a_flat_sheet_keeps_its_border_and_its_area) {
  const Primitive source = terrain(40, flat);
  const std::vector<std::uint32_t> fewer = simplified_indices(source.positions, source.indices);
  ASSERT_FALSE(fewer.empty());
  EXPECT_LT(fewer.size(), source.indices.size() / 8);
  EXPECT_EQ(open_edges(source.positions, fewer), open_edges(source.positions, source.indices));
  double area = 0.0;
  for (std::size_t i = 0; i < fewer.size(); i += 3) {
    const vec3 a = source.positions[fewer[i]], b = source.positions[fewer[i + 1]], c = source.positions[fewer[i + 2]];
    area += 0.5 * static_cast<double>(glm::length(glm::cross(b - a, c - a)));
  }
  EXPECT_NEAR(area, 1600.0, 1e-3);
}

TEST(SimplifiedCasters, what_is_rough_or_small_or_degenerate_stays_as_it_is) {
  const Primitive rough =
      terrain(20, [](float x, float z) { return 4.0f * std::sin(2711.0f * std::sin(12.9f * x + 78.2f * z)); });
  EXPECT_TRUE(simplified_indices(rough.positions, rough.indices).empty());
  const Primitive box = test::box(vec3(1.0f));
  EXPECT_TRUE(simplified_indices(box.positions, box.indices).empty());
  Primitive point = terrain(20, flat);
  point.positions.assign(point.positions.size(), vec3(1.0f));
  EXPECT_TRUE(simplified_indices(point.positions, point.indices).empty());
  EXPECT_TRUE(simplified_indices({}, {}).empty());
}

class SimplifiedScene : public ::testing::Test {
 protected:
  SimplifiedScene() { prepare_scene_world(world_); }
  void TearDown() override { EXPECT_TRUE(device_->faults().empty()) << device_->faults().front(); }
  void sync() { ASSERT_TRUE(scene_.sync(maker_.assets(), *serial_).ok()); }
  /// Simplifies in a frame. Returns whether the frame has copied anything.
  bool simplify(GpuScene& scene, JobExecutor& executor) {
    EXPECT_TRUE(scene.simplify_casters(maker_.assets(), executor).ok());
    device_->forget_commands();
    gpu::CommandList& commands = *device_->begin_frame().value();
    graph_.begin();
    EXPECT_TRUE(scene.stage(maker_.assets()).ok());
    scene.add_pass(graph_);
    EXPECT_TRUE(graph_.compile().ok());
    graph_.execute(commands);
    EXPECT_TRUE(device_->submit_frame().ok());
    scene.commit_frame();
    return std::ranges::count(device_->commands(), "copy_buffer", &gpu::RecordedCommand::name) > 0;
  }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  std::unique_ptr<JobExecutor> serial_ = make_serial_executor();
  Pipelines pipelines_{*device_};
  FrameGraph graph_{*device_};
  GpuScene scene_{*device_, pipelines_};
  World world_;
  test::SceneMaker maker_{world_};
};

TEST_F(SimplifiedScene, nothing_is_made_until_it_is_asked_for_and_then_once) {
  const std::uint32_t mesh = maker_.mesh(ball(1.0f, 32));
  sync();
  const GpuPrimitive& primitive = scene_.meshes()[mesh][0];
  const gpu::BufferHandle before = scene_.indices();
  const std::uint64_t bytes = device_->desc(before).size;
  EXPECT_EQ(primitive.simplified_index_count, 0u);
  EXPECT_TRUE(simplify(scene_, *serial_));
  EXPECT_GT(primitive.simplified_index_count, 0u);
  EXPECT_LT(primitive.simplified_index_count, primitive.index_count);
  EXPECT_GE(primitive.simplified_first_index, bytes / 4) << "behind what was there";
  const gpu::BufferHandle after = scene_.indices();
  EXPECT_NE(after, before);
  EXPECT_EQ(device_->desc(after).size, bytes + 4 * ((primitive.simplified_index_count + 63) / 64 * 64));
  EXPECT_FALSE(simplify(scene_, *serial_)) << "the second time costs nothing";
  sync();
  EXPECT_EQ(scene_.indices(), after);
  maker_.mesh(test::quad(1.0f));
  sync();
  EXPECT_EQ(scene_.meshes()[mesh][0].simplified_index_count, 0u) << "other assets begin anew";
}

TEST_F(SimplifiedScene, cut_outs_blended_and_deformed_primitives_keep_theirs) {
  Material leaf, glass;
  leaf.alpha_mode = AlphaMode::mask;
  glass.alpha_mode = AlphaMode::blend;
  maker_.mesh(ball(1.0f, 32, maker_.material(leaf)));
  maker_.mesh(ball(1.0f, 32, maker_.material(glass)));
  Primitive morphed = ball(1.0f, 32);
  morphed.morph_targets.push_back({std::vector<vec3>(morphed.positions.size(), vec3(1.0f)), {}});
  maker_.mesh(morphed);
  Primitive skinned = ball(1.0f, 32);
  skinned.joints.assign(skinned.positions.size(), {0, 0, 0, 0});
  skinned.weights.assign(skinned.positions.size(), vec4(1.0f, 0.0f, 0.0f, 0.0f));
  maker_.mesh(skinned);
  sync();
  const gpu::BufferHandle before = scene_.indices();
  EXPECT_FALSE(simplify(scene_, *serial_));
  for (const auto& primitives : scene_.meshes()) EXPECT_EQ(primitives[0].simplified_index_count, 0u);
  EXPECT_EQ(scene_.indices(), before);
}

TEST_F(SimplifiedScene, the_result_does_not_depend_on_the_executor) {
  for (int i = 0; i < 6; ++i) maker_.mesh(ball(1.0f, static_cast<std::uint32_t>(10 + 4 * i)));
  sync();
  EXPECT_TRUE(simplify(scene_, *serial_));
  for (const test::ExecutorCase& executor : test::all_executors()) {
    GpuScene other(*device_, pipelines_);
    ASSERT_TRUE(other.sync(maker_.assets(), *serial_).ok());
    EXPECT_TRUE(simplify(other, *executor.make()));
    for (std::size_t m = 0; m < scene_.meshes().size(); ++m) {
      EXPECT_EQ(other.meshes()[m][0].simplified_first_index, scene_.meshes()[m][0].simplified_first_index)
          << executor.name;
      EXPECT_EQ(other.meshes()[m][0].simplified_index_count, scene_.meshes()[m][0].simplified_index_count)
          << executor.name;
    }
  }
}

}  // namespace
}  // namespace gloam
