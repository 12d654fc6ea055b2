// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/ext/vector_double2.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tests/render/draws/drawn_scene.h"
#include "tests/support/worse.h"

/// Screen motion in double precision: rays through pixels meet triangles, whose corners in the previous frame are
/// projected with the previous camera.
namespace gloam::test {

using glm::dvec2;

/// Triangles in world space, three corners each, in a frame and in the one before.
struct MovingTriangles {
  std::vector<dvec3> now, before;
  bool one_sided = false;  ///< clockwise triangles are not drawn

  /// The triangles of a mesh whose matrix changes.
  void add(const Primitive& mesh, const dmat4& matrix_now, const dmat4& matrix_before) {
    for (const std::uint32_t i : mesh.indices) {
      const dvec4 corner(dvec3(mesh.positions[i]), 1.0);
      now.push_back(dvec3(matrix_now * corner));
      before.push_back(dvec3(matrix_before * corner));
    }
  }
};

struct Ray {
  dvec3 origin;
  dvec3 direction;  ///< its parameter is the view depth
};

/// Half extents of the picture in view space: at a depth of 1 m, or at every depth of an orthographic camera.
inline dvec2 half_extent(const ViewSettings& s) {
  const double y = s.camera.orthographic ? static_cast<double>(s.camera.half_height_m)
                                         : std::tan(0.5 * static_cast<double>(s.camera.fov_y));
  return {y * s.width / s.height, y};
}

inline Ray ray_through(const ViewSettings& s, const dvec2& pixel) {
  const dvec2 at = dvec2(2.0 * pixel.x / s.width - 1.0, 1.0 - 2.0 * pixel.y / s.height) * half_extent(s);
  const dvec3 eye(s.world_from_camera[3]);
  const glm::dmat3 turn(s.world_from_camera);
  if (s.camera.orthographic) return {eye + turn * dvec3(at, 0.0), turn * dvec3(0.0, 0.0, -1.0)};
  return {eye, turn * dvec3(at, -1.0)};
}

/// Pixel position of the point at `offset` from the camera; none behind it.
inline std::optional<dvec2> project_offset(const ViewSettings& s, const dvec3& offset) {
  const dvec3 local = glm::transpose(glm::dmat3(s.world_from_camera)) * offset;
  const double w = s.camera.orthographic ? 1.0 : -local.z;
  if (w <= 0.0) return std::nullopt;
  const dvec2 ndc = dvec2(local) / (w * half_extent(s));
  return dvec2((0.5 + 0.5 * ndc.x) * s.width, (0.5 - 0.5 * ndc.y) * s.height);
}

struct ExpectedMotion {
  bool sky = true;
  dvec2 motion = dvec2(0.0);
};

/// The motion under a point of the picture. The pictures have the size of `now`.
inline ExpectedMotion expected_motion(const MovingTriangles& triangles, const ViewSettings& now, ViewSettings before,
                                      const dvec2& pixel) {
  before.width = now.width;
  before.height = now.height;
  const Ray ray = ray_through(now, pixel);
  double nearest = std::numeric_limits<double>::infinity();
  dvec3 point_before(0.0);
  for (std::size_t t = 0; t + 2 < triangles.now.size(); t += 3) {
    const dvec3* c = &triangles.now[t];
    const dvec3* b = &triangles.before[t];
    const dvec3 edge1 = c[1] - c[0], edge2 = c[2] - c[0], across = glm::cross(ray.direction, edge2);
    const double determinant = glm::dot(edge1, across);
    if (std::abs(determinant) < 1e-12 || (triangles.one_sided && determinant < 0.0)) continue;
    const dvec3 from = ray.origin - c[0], q = glm::cross(from, edge1);
    const double u = glm::dot(from, across) / determinant, v = glm::dot(ray.direction, q) / determinant;
    const double depth = glm::dot(edge2, q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || depth <= 0.0 || depth >= nearest) continue;
    nearest = depth;
    point_before = b[0] + u * (b[1] - b[0]) + v * (b[2] - b[0]);
  }
  const bool sky = std::isinf(nearest);
  if (sky && (now.camera.orthographic || before.camera.orthographic)) return {true, dvec2(0.0)};
  const dvec3 offset = sky ? ray.direction : point_before - dvec3(before.world_from_camera[3]);
  const auto at = project_offset(before, offset);
  return {sky, at ? pixel - *at : dvec2(65536.0)};
}

/// Motion and depth of a view's last frame.
struct MotionPicture {
  std::uint32_t width = 0;
  std::vector<vec2> motion;
  std::vector<float> depth;
};

inline MotionPicture read_motion(Stage& stage, std::uint32_t view = 0) {
  static constexpr std::string_view kNames[] = {"motion", "depth"};
  const std::vector<ImageBytes> images = value_of(stage.renderer->read_images(stage.world, ViewId{view}, kNames));
  EXPECT_EQ(images[0].format, gpu::Format::rg32_float);
  MotionPicture picture;
  picture.width = images[0].width;
  picture.motion.resize(images[0].bytes.size() / sizeof(vec2));
  picture.depth.resize(images[1].bytes.size() / sizeof(float));
  std::memcpy(picture.motion.data(), images[0].bytes.data(), images[0].bytes.size());
  std::memcpy(picture.depth.data(), images[1].bytes.data(), images[1].bytes.size());
  return picture;
}

/// Result of a comparison of all pixels that are not at an edge of a triangle against another surface.
struct Compared {
  int surface = 0, sky = 0;  ///< pixels compared
  double worst = 0.0;        ///< pixels of motion
  double longest = 0.0;      ///< longest expected motion that stays in the picture
};

constexpr double kMotionBar = 0.02;  ///< pixels

inline Compared compare_motion(const MotionPicture& picture, const MovingTriangles& triangles, const ViewSettings& now,
                               const ViewSettings& before) {
  Compared compared;
  for (std::uint32_t y = 0; y < now.height; ++y) {
    for (std::uint32_t x = 0; x < now.width; ++x) {
      const dvec2 pixel(x + 0.5, y + 0.5);
      const ExpectedMotion expected = expected_motion(triangles, now, before, pixel);
      bool edge = false;
      for (const dvec2& step : {dvec2(0.05, 0.0), dvec2(-0.05, 0.0), dvec2(0.0, 0.05), dvec2(0.0, -0.05)}) {
        const ExpectedMotion near = expected_motion(triangles, now, before, pixel + step);
        edge = edge || near.sky != expected.sky || glm::length(near.motion - expected.motion) > 0.1;
      }
      if (edge) continue;
      const std::size_t i = std::size_t{y} * picture.width + x;
      EXPECT_EQ(picture.depth[i] == 0.0f, expected.sky) << x << "," << y;
      ++(expected.sky ? compared.sky : compared.surface);
      compared.worst = worse(compared.worst, glm::length(dvec2(picture.motion[i]) - expected.motion));
      const double length = glm::length(expected.motion);
      if (length < now.width + now.height) compared.longest = std::max(compared.longest, length);
    }
  }
  return compared;
}

}  // namespace gloam::test
