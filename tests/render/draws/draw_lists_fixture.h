// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/draws/draw_lists.h"
#include "engine/scene/posing/animation.h"
#include "tests/jobs/executors.h"
#include "tests/render/draws/one_view.h"
#include "tests/support/render_scene.h"

namespace gloam::test {

inline dmat4 placed(const dvec3& at, const dvec3& axis, double angle, const dvec3& scale) {
  return glm::translate(dmat4(1.0), at) * glm::rotate(dmat4(1.0), angle, axis) * glm::scale(dmat4(1.0), scale);
}

/// A flat grid of 2·side² triangles in XZ, side × side metres. It has many clusters.
inline Primitive grid(std::uint32_t side) {
  Primitive p;
  for (std::uint32_t z = 0; z <= side; ++z)
    for (std::uint32_t x = 0; x <= side; ++x)
      p.positions.push_back({static_cast<float>(x), 0.0f, static_cast<float>(z)});
  p.normals.assign(p.positions.size(), vec3(0.0f, 1.0f, 0.0f));
  for (std::uint32_t z = 0; z < side; ++z) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t at = z * (side + 1) + x;
      for (const std::uint32_t i : {at, at + side + 1, at + 1, at + 1, at + side + 1, at + side + 2})
        p.indices.push_back(i);
    }
  }
  return test::finished(std::move(p));
}

/// A world, its scene on a recording device, and draw lists of a view of it.
class DrawListsTest : public ::testing::Test {
 protected:
  DrawListsTest() { prepare_scene_world(world_); }
  void TearDown() override { EXPECT_TRUE(device_->faults().empty()) << device_->faults().front(); }

  void sync() {
    const Status status = scene_.sync(maker_.assets(), *serial_);
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  Entity draw(std::uint32_t mesh, const dmat4& matrix, std::uint32_t skin = kNone) {
    drawn_.push_back(world_.create(WorldTransform{matrix}, MeshInstance{mesh, skin}));
    return drawn_.back();
  }
  void clear() {
    for (const Entity entity : drawn_) world_.destroy(entity);
    drawn_.clear();
    world_.resource<JointMatrices>() = {};
  }
  /// Draws a skinned instance with these joint matrices, relative to `origin`.
  Entity draw_skinned(std::uint32_t mesh, const dvec3& origin, const std::vector<mat4>& matrices,
                      bool mirrored = false) {
    const Entity entity = draw(mesh, placed(dvec3(1e3), dvec3(1, 0, 0), 0.0, dvec3(1.0)), 0);
    auto& joints = world_.resource<JointMatrices>();
    joints.ranges.push_back({entity, static_cast<std::uint32_t>(joints.matrices.size()),
                             static_cast<std::uint32_t>(matrices.size()), origin, mirrored});
    std::ranges::sort(joints.ranges, {}, [](const JointMatrices::Range& r) { return r.instance.index; });
    joints.matrices.insert(joints.matrices.end(), matrices.begin(), matrices.end());
    return entity;
  }
  [[nodiscard]] FrameDraws lists_of(const RenderView& view) { return frame_draws(world_, view, scene_, *serial_); }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  std::unique_ptr<JobExecutor> serial_ = make_serial_executor();
  Pipelines pipelines_{*device_};
  GpuScene scene_{*device_, pipelines_};
  World world_;
  SceneMaker maker_{world_};
  std::vector<Entity> drawn_;
};

/// Indices of a primitive's triangles in the GPU's order.
[[nodiscard]] inline std::vector<std::uint32_t> drawn_order(const Primitive& primitive) {
  std::vector<std::uint32_t> indices;
  (void)build_clusters(primitive, indices);
  return indices;
}

}  // namespace gloam::test
