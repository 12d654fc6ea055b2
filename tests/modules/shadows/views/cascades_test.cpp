// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/views/cascades.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <random>
#include <vector>

#include "engine/render/camera/jitter.h"

namespace gloam {
namespace {

constexpr float kRim = 0.125f;
const AtlasSquare kSquare{uvec2(1024, 0), 1024};

ViewSettings camera_at(const dvec3& position, double yaw = 0.0, double pitch = 0.0, double roll = 0.0) {
  ViewSettings settings;
  settings.width = 640;
  settings.height = 360;
  settings.world_from_camera = glm::rotate(
      glm::rotate(glm::rotate(glm::translate(dmat4(1.0), position), yaw, dvec3(0, 1, 0)), pitch, dvec3(1, 0, 0)), roll,
      dvec3(0, 0, 1));
  return settings;
}

RenderView view_of(const ViewSettings& settings) { return make_view(settings, 0); }

CasterBounds box(const dvec3& center, const dvec3& half) {
  CasterBounds bounds;
  bounds.grow(center - half, center + half);
  return bounds;
}

FaceAxes sun() { return node_axes(glm::rotate(glm::rotate(dmat4(1.0), 0.4, dvec3(0, 1, 0)), -0.9, dvec3(1, 0, 0))); }

/// The world position at a point of the picture (−1 … 1) and a view depth, from the matrix that draws it.
dvec3 seen_at(const RenderView& view, double x, double y, double depth_m) {
  const dmat4 clip_from_relative(view.clip_from_relative);
  const double w = view.camera.orthographic ? 1.0 : depth_m;
  const dvec3 forward =
      -dvec3(view.view_from_relative[0][2], view.view_from_relative[1][2], view.view_from_relative[2][2]);
  // Intersection of three planes: two of the picture, one of depth.
  glm::dmat3 rows;
  dvec3 right;
  for (int axis = 0; axis < 3; ++axis) {
    rows[axis][0] = clip_from_relative[axis][0];
    rows[axis][1] = clip_from_relative[axis][1];
    rows[axis][2] = forward[axis];
  }
  right = {x * w - clip_from_relative[3][0], y * w - clip_from_relative[3][1], depth_m};
  return view.position + glm::inverse(rows) * right;
}

TEST(CascadeSplits, grow_outwards_and_end_at_the_far_end) {
  for (const bool orthographic : {false, true}) {
    for (std::uint32_t count = 1; count <= 4; ++count) {
      const std::vector<double> splits = cascade_splits(0.1, 100.0, count, orthographic);
      ASSERT_EQ(splits.size(), count);
      double last = 0.1;
      double width = 0.0;
      for (const double split : splits) {
        EXPECT_GT(split, last);
        EXPECT_GE(split - last, width * (1.0 - 1e-9)) << "none is thinner than the one before";
        width = split - last;
        last = split;
      }
      EXPECT_EQ(splits.back(), 100.0);
    }
  }
  EXPECT_TRUE(cascade_splits(0.1, 100.0, 0, false).empty());
  EXPECT_LT(cascade_splits(-5.0, 100.0, 2, true)[0], 100.0) << "orthographic cameras may see behind themselves";
}

// Hard case: shadows.camera_off_centre
TEST(CascadeSpheres, enclose_their_slices_of_every_camera) {
  std::vector<ViewSettings> cameras{camera_at({1, 2, 3}, 0.5, 0.3, 1.2), camera_at({1, 2, 3}, -2.0, -1.2)};
  cameras.push_back(cameras[0]);
  cameras.back().camera.fov_y = 2.6f;
  cameras.push_back(cameras[0]);
  cameras.back().camera.orthographic = true;
  cameras.back().camera.half_height_m = 7.0f;
  for (const ViewSettings& settings : cameras) {
    for (const bool off_centre : {false, true}) {
      RenderView view = view_of(settings);
      if (off_centre) {
        view.clip_from_view[settings.camera.orthographic ? 3 : 2][0] = 0.4f;
        view.clip_from_view[settings.camera.orthographic ? 3 : 2][1] = -0.7f;
        view.clip_from_relative = view.clip_from_view * view.view_from_relative;
      }
      const CascadeSphere sphere = slice_sphere(view, 2.0, 9.0);
      double farthest = 0.0;
      for (const double x : {-1.0, 0.3, 1.0})
        for (const double y : {-1.0, -0.2, 1.0})
          for (const double d : {2.0, 5.0, 9.0})
            farthest = std::max(farthest, glm::length(seen_at(view, x, y, d) - sphere.center));
      EXPECT_LE(farthest, sphere.radius_m * (1.0 + 1e-5));
      EXPECT_GE(farthest, sphere.radius_m * (1.0 - 1e-5)) << "a corner lies on it";
    }
  }
}

// Otherwise maps of a view at rest would be drawn anew in each frame.
TEST(CascadeSpheres, do_not_follow_the_jitter_and_enclose_all_that_it_shows) {
  ViewSettings settings = camera_at({1, 2, 3}, 0.5, 0.3, 1.2);
  for (const bool orthographic : {false, true}) {
    settings.camera.orthographic = orthographic;
    settings.camera.half_height_m = 7.0f;
    RenderView first = view_of(settings);
    apply_jitter(first, vec2(0.0f));
    const CascadeSphere sphere = slice_sphere(first, 2.0, 9.0);
    EXPECT_LT(sphere.radius_m, 1.01 * slice_sphere(view_of(settings), 2.0, 9.0).radius_m);
    for (const vec2 jitter : {vec2(-0.5f, 0.3f), vec2(0.5f, 0.5f), vec2(0.1f, -0.5f)}) {
      RenderView view = view_of(settings);
      apply_jitter(view, jitter);
      EXPECT_EQ(slice_sphere(view, 2.0, 9.0).center, sphere.center);
      EXPECT_EQ(slice_sphere(view, 2.0, 9.0).radius_m, sphere.radius_m);
      EXPECT_EQ(shadow_distance(view, box({9, 5, 0}, {3, 3, 3})), shadow_distance(first, box({9, 5, 0}, {3, 3, 3})));
      for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
          for (const double d : {2.0, 9.0})
            EXPECT_LE(glm::length(seen_at(view, x, y, d) - sphere.center), sphere.radius_m * (1.0 + 1e-5));
    }
  }
}

TEST(CascadeSpheres, keep_their_radius_however_the_camera_moves_among_the_casters) {
  const CasterBounds casters = box({10, 5, 0}, {60, 10, 60});
  std::vector<double> radii;
  for (const CascadeSphere& sphere : cascade_spheres(view_of(camera_at({0, 2, 0})), casters, 4))
    radii.push_back(sphere.radius_m);
  ASSERT_FALSE(radii.empty());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    const dvec3 at(10.0 + 40.0 * unit(random), 5.0 + 8.0 * unit(random), 40.0 * unit(random));
    const auto spheres =
        cascade_spheres(view_of(camera_at(at, 3.0 * unit(random), unit(random), unit(random))), casters, 4);
    for (const CascadeSphere& sphere : spheres) EXPECT_EQ(sphere.radius_m, radii[sphere.slice]);
  }
}

TEST(CascadeSpheres, end_with_the_casters_own_one) {
  const CasterBounds casters = box({0, 0, 0}, {3, 3, 3});
  for (const double distance : {1.0, 10.0, 300.0, 1e4, 1e6}) {
    const auto spheres = cascade_spheres(view_of(camera_at({0, 0, distance})), casters, 4);
    ASSERT_FALSE(spheres.empty()) << distance;
    EXPECT_LT(glm::length(spheres.back().center), 1e-12);
    EXPECT_GE(spheres.back().radius_m, std::sqrt(27.0));
    EXPECT_LE(spheres.back().radius_m, std::sqrt(27.0) * 1.125);
  }
}

TEST(CascadeSpheres, leave_out_slices_without_a_caster) {
  // Wide casters behind the camera: they touch none of the slices in front of it.
  const auto behind = cascade_spheres(view_of(camera_at({0, 0, -500})), box({0, 0, 0}, dvec3(200.0)), 4);
  for (const CascadeSphere& sphere : behind)
    EXPECT_LE(glm::length(sphere.center), sphere.radius_m + 200.0 * 1.8 * 1.125);
  const auto ahead = cascade_spheres(view_of(camera_at({0, 0, 30})), box({0, 0, 0}, dvec3(3.0)), 4);
  ASSERT_EQ(ahead.size(), 1u) << "nothing in front of the casters needs a map";
}

TEST(CascadeSpheres, take_a_distance_where_casters_are_not_known) {
  CasterBounds bad;
  bad.grow(dvec3(0.0), dvec3(std::numeric_limits<double>::infinity()));
  for (const CasterBounds& unknown : {CasterBounds{}, bad}) {
    EXPECT_FALSE(unknown.known());
    const RenderView view = view_of(camera_at({5, 1, 5}, 1.0));
    EXPECT_EQ(shadow_distance(view, unknown), kDefaultShadowDistance * static_cast<double>(view.near_m));
    const auto spheres = cascade_spheres(view, unknown, 4);
    ASSERT_EQ(spheres.size(), 4u);
    for (const double x : {-0.99, 0.0, 0.99}) {
      EXPECT_LE(glm::length(seen_at(view, x, 0.9, 99.9) - spheres[3].center), spheres[3].radius_m);
    }
  }
}

TEST(CascadeSpheres, reach_past_all_casters_up_to_a_limit_that_scales) {
  const RenderView inside = view_of(camera_at({0, 0, 0}));
  const double most = kMostNearPlanes * static_cast<double>(inside.near_m);
  CasterBounds wide = box({0, 0, 0}, dvec3(1e5));
  EXPECT_EQ(shadow_distance(inside, wide), most);
  for (int i = 0; i < 3; ++i) wide.add_size(128.0);  // the near plane says less about the scene than they do
  EXPECT_EQ(shadow_distance(inside, wide), kMostCasterSizes * 128.0);
  wide.add_size(1e9);  // a ground
  EXPECT_EQ(shadow_distance(inside, wide), kMostCasterSizes * 8.0 * 128.0);
  EXPECT_GE(shadow_distance(inside, box({0, 0, 40}, dvec3(50.0))), 40.0 + std::sqrt(3.0) * 50.0);
  EXPECT_GE(shadow_distance(view_of(camera_at({0, 0, 5e4})), box({0, 0, 0}, dvec3(1.0))), 5e4);
}

TEST(CascadeSpheres, of_the_same_scene_in_other_units_are_the_same_in_metres) {
  for (const double unit : {1e-3, 0.01, 0.3, 100.0, 1000.0})
    for (const double half : {0.7, 3.0, 45.0, 900.0}) {
      const auto spheres = [&](double units) {
        RenderView view = view_of(camera_at(dvec3(0.5, 1.0, 2.0) * units));
        view.near_m = static_cast<float>(0.1 * units);
        CasterBounds casters = box(dvec3(0.1, 0.2, 0.3) * units, dvec3(half, 1.0, half) * units);
        casters.grid_unit = units;
        for (int i = 0; i < 9; ++i) casters.add_size(0.31 * units * (i + 1));
        return std::pair(cascade_spheres(view, casters, 4), casters.usual_size());
      };
      const auto [expected, size] = spheres(1.0);
      const auto [found, found_size] = spheres(unit);
      EXPECT_NEAR(found_size / unit, size, 1e-9 * size) << unit;
      ASSERT_EQ(found.size(), expected.size()) << unit;
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].radius_m / unit, expected[i].radius_m, 1e-5 * expected[i].radius_m) << unit << ' ' << half;
        EXPECT_LT(glm::length(found[i].center / unit - expected[i].center), 1e-5 * expected[i].radius_m);
      }
    }
}

TEST(CascadeFaces, shift_by_whole_texels_and_never_change_a_texels_size) {
  for (const dvec3& home : {dvec3(0.0), dvec3(1e5, -1e5, 1e5)}) {
    const CasterBounds casters = box(home, {80, 10, 80});
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<ShadowFace> first(4);
    for (int i = 0; i < 200; ++i) {
      const dvec3 at = home + dvec3(30.0 * unit(random), 3.0 * unit(random), 30.0 * unit(random));
      const RenderView view = view_of(camera_at(at, 3.0 * unit(random), unit(random), unit(random)));
      for (const CascadeSphere& sphere : cascade_spheres(view, casters, 4)) {
        const ShadowFace face = cascade_face(Entity{1, 1}, sun(), sphere, casters, kSquare, kRim);
        ShadowFace& before = first[sphere.slice];
        if (before.far_m == 0.0f) before = face;
        EXPECT_EQ(face.half_extent_m, before.half_extent_m);
        EXPECT_EQ(face.far_m, before.far_m);
        const dvec3 point = home + dvec3(1.25, 2.5, -3.125);
        const auto now = project(face, point);
        const auto then = project(before, point);
        ASSERT_TRUE(now && then);
        EXPECT_NEAR(now->x - then->x, std::round(now->x - then->x), 2e-4);
        EXPECT_NEAR(now->y - then->y, std::round(now->y - then->y), 2e-4);
        EXPECT_NEAR(now->depth, then->depth, 1e-7);
      }
    }
  }
}

TEST(CascadeFaces, of_a_scene_at_another_place_have_the_same_texels_if_the_anchor_has_moved_with_it) {
  const FaceAxes axes = sun();
  const auto face_at = [&](const dvec3& at, const dvec3& anchor) {
    CasterBounds casters = box(at + dvec3(0.3, 0.2, -1.7), dvec3(4.0, 1.0, 3.0));
    casters.grid_anchor = anchor;
    const CascadeSphere sphere{0, at + dvec3(0.123, 0.456, 0.789), 2.7};
    return cascade_face(Entity{}, axes, sphere, casters, kSquare, kRim);
  };
  const dvec3 anchor(0.7, 0.1, -0.2);
  const ShadowFace here = face_at(dvec3(0.0), anchor);
  double unanchored = 0.0;
  for (const dvec3 move : {dvec3(10.0, 0.0, 0.0), dvec3(-3.37, 55.5, 123.4), dvec3(1e6, -2e3, 7e5)}) {
    const ShadowFace there = face_at(move, anchor + move);
    const double texel = 2.0 * static_cast<double>(there.half_extent_m) / kSquare.size;
    EXPECT_LT(glm::length(there.origin - here.origin - move), 1e-5 * texel);
    EXPECT_EQ(there.far_m, here.far_m);
    unanchored = std::max(unanchored, glm::length(face_at(move, anchor).origin - here.origin - move) / texel);
    // A camera that moves among the same casters shifts by whole texels, whatever the anchor.
    CasterBounds casters = box(move, dvec3(4.0));
    casters.grid_anchor = anchor + move;
    const ShadowFace before = cascade_face(Entity{}, axes, {0, move, 2.7}, casters, kSquare, kRim);
    const ShadowFace after =
        cascade_face(Entity{}, axes, {0, move + dvec3(0.61, 0.2, -0.4), 2.7}, casters, kSquare, kRim);
    for (const vec3& axis : {axes.right, axes.up}) {
      const double steps = glm::dot(dvec3(axis), after.origin - before.origin) / texel;
      EXPECT_NEAR(steps, std::round(steps), 1e-3);
    }
  }
  EXPECT_GT(unanchored, 0.1) << "the moves are no multiples of a texel";
}

TEST(CascadeFaces, hold_their_sphere_inside_the_rim_and_all_casters_between_their_ends) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const CasterBounds casters = box(dvec3(unit(random), unit(random), unit(random)) * 20.0,
                                     dvec3(30.0, 12.0, 25.0) * std::abs(unit(random)) + dvec3(0.1));
    const FaceAxes axes =
        node_axes(glm::rotate(dmat4(1.0), unit(random) * 3.0, dvec3(1.0, unit(random), unit(random))));
    const CascadeSphere sphere{0, dvec3(unit(random), unit(random), unit(random)) * 10.0, 5.0 + 4.0 * unit(random)};
    const AtlasSquare square{uvec2(0), 16u << (i % 8)};
    const ShadowFace face = cascade_face(Entity{1, 1}, axes, sphere, casters, square, kRim);
    const double rim = 0.5 * square.size * kRim / (1.0 + kRim);
    for (int p = 0; p < 30; ++p) {
      dvec3 direction(unit(random), unit(random), unit(random));
      const auto seen = project(face, sphere.center + glm::normalize(direction) * sphere.radius_m);
      ASSERT_TRUE(seen.has_value());
      EXPECT_GE(std::min(seen->x, seen->y), rim - 1e-4);
      EXPECT_LE(std::max(seen->x, seen->y), square.size - rim + 1e-4);
      const auto caster = project(face, glm::mix(casters.min, casters.max, 0.5 + 0.5 * direction));
      EXPECT_GE(caster->depth, -1e-6);
      EXPECT_LE(caster->depth, 1.0 + 1e-6);
    }
  }
}

TEST(CascadeFaces, see_what_is_between_them_and_the_light) {
  const CasterBounds casters = box({0, 0, 0}, dvec3(10.0));
  const FaceAxes axes = sun();
  const ShadowFace face = cascade_face(Entity{1, 1}, axes, {0, dvec3(0.0), 4.0}, casters, kSquare, kRim);
  const auto sees = [&](const dvec3& at) { return face_may_see(face, at - dvec3(0.1), at + dvec3(0.1)); };
  EXPECT_TRUE(sees(dvec3(0.0)));
  EXPECT_TRUE(sees(dvec3(axes.forward) * -9.0));
  EXPECT_TRUE(sees(dvec3(axes.forward) * -900.0)) << "however far towards the light";
  EXPECT_FALSE(sees(dvec3(axes.forward) * 60.0));
  EXPECT_FALSE(sees(dvec3(axes.right) * 6.0));
  EXPECT_FALSE(sees(dvec3(axes.up) * -6.0));
}

dmat4 slanted() { return glm::rotate(dmat4(1.0), std::atan(1.0 / 3.0), glm::normalize(dvec3(0.3, 0.1, 1.0))); }

OrientedBox placed(const dvec3& center, const dvec3& half, const dmat4& turn) {
  const glm::dmat3 axes(turn);
  return {center, glm::dmat3(axes[0] * half.x, axes[1] * half.y, axes[2] * half.z)};
}

// In a box along the world's axes a slanted ground is as deep as it is wide.
TEST(CascadeFaces, over_a_slanted_ground_of_any_width_are_as_deep_as_what_is_beside_them) {
  const CascadeSphere sphere{0, dvec3(2.0, 1.0, -3.0), 4.0};
  for (const double width : {1e4, 1e5, 1e7, 1e9}) {
    CasterBounds casters;
    casters.grow(placed(dvec3(0.0), dvec3(width, 0.0, width), slanted()));
    casters.grow(placed(dvec3(2.0, 2.0, -3.0), dvec3(1.0), dmat4(1.0)));
    const ShadowFace face = cascade_face({}, sun(), sphere, casters, kSquare, kRim);
    EXPECT_LT(face.far_m, 8.0f * 4.0f) << width;
    EXPECT_GT(face.far_m, 2.0f * 4.0f) << width;
  }
}

TEST(CascadeFaces, hold_all_casters_beside_their_sphere_whatever_their_boxes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto direction = [&] { return glm::normalize(dvec3(unit(random), unit(random), unit(random) + 1e-3)); };
  std::size_t beside = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<OrientedBox> boxes{placed(dvec3(0.0), dvec3(3e4, 0.0, 2e4), slanted())};
    for (int i = 0; i < 20; ++i) {
      // Some are flat, some are lines.
      const dvec3 half(std::exp(4.0 * unit(random)), i % 3 == 0 ? 0.0 : 2.0, i % 6 == 0 ? 0.0 : 1.0);
      boxes.push_back(placed(30.0 * direction(), half, glm::rotate(dmat4(1.0), 3.0 * unit(random), direction())));
    }
    CasterBounds casters, first, second;
    for (std::size_t i = 0; i < boxes.size(); ++i) (i % 2 == 0 ? first : second).grow(boxes[i]);
    casters.grow(first);
    casters.grow(second);
    const CascadeSphere sphere{0, 10.0 * direction(), 6.0};
    const FaceAxes axes = sun();
    const ShadowFace face = cascade_face({}, axes, sphere, casters, kSquare, kRim);
    const dvec3 forward(axes.forward);
    EXPECT_LT(face.far_m, 1e3f) << "the ground's width does not count";
    for (const OrientedBox& box : boxes) {
      for (int i = 0; i < 200; ++i) {
        const dvec3 point = box.center + box.half_axes * dvec3(unit(random), unit(random), unit(random));
        const dvec3 from = point - sphere.center;
        if (glm::length(from - forward * glm::dot(from, forward)) > sphere.radius_m) continue;
        ++beside;
        const double depth = glm::dot(forward, point - face.origin);
        EXPECT_GE(depth, -1e-3);
        EXPECT_LE(depth, static_cast<double>(face.far_m) + 1e-3);
      }
    }
  }
  EXPECT_GT(beside, 3000u);
}

TEST(CascadeFaces, have_generous_depths_where_casters_are_not_known) {
  const FaceAxes axes = sun();
  const ShadowFace face = cascade_face(Entity{1, 1}, axes, {0, dvec3(3.0), 4.0}, {}, kSquare, kRim);
  EXPECT_GT(project(face, dvec3(3.0) + dvec3(axes.forward) * 999.0)->depth, 0.0);
  EXPECT_LT(project(face, dvec3(3.0) - dvec3(axes.forward) * 999.0)->depth, 1.0);
}

TEST(CascadeFaces, are_finite_for_casters_without_size_and_for_worlds_without_measure) {
  for (const double half : {0.0, 1e-9, 1e12, 1e150}) {
    const CasterBounds casters = box({1, 2, 3}, dvec3(half));
    const RenderView view = view_of(camera_at({1, 2, 8}));
    const auto spheres = cascade_spheres(view, casters, 4);
    EXPECT_FALSE(spheres.empty()) << half;
    for (const CascadeSphere& sphere : spheres) {
      const ShadowFace face = cascade_face(Entity{1, 1}, sun(), sphere, casters, kSquare, kRim);
      EXPECT_TRUE(std::isfinite(face.half_extent_m) && face.half_extent_m > 0.0f);
      EXPECT_TRUE(std::isfinite(face.far_m) && face.far_m > 0.0f);
      EXPECT_TRUE(std::isfinite(glm::dot(face.origin, face.origin)));
    }
  }
}

TEST(CascadeFaces, tell_shaders_what_project_says) {
  const dvec3 home(1e5, 2e4, -1e5);
  const CasterBounds casters = box(home, dvec3(40.0));
  const RenderView view = view_of(camera_at(home + dvec3(3, 1, 2), 0.4));
  for (const CascadeSphere& sphere : cascade_spheres(view, casters, 3)) {
    const ShadowFace face = cascade_face(Entity{1, 1}, sun(), sphere, casters, kSquare, kRim);
    const shaders::ShadowCascade c = cascade_constants(face, view.position, kRim);
    EXPECT_EQ(c.origin, vec2(1024.0f, 0.0f));
    EXPECT_EQ(c.size, 1024.0f);
    EXPECT_EQ(c.depth_m, face.far_m);
    EXPECT_NEAR(c.texel_m, 2.0f * face.half_extent_m / 1024.0f, 1e-7f);
    EXPECT_NEAR(c.rim, 512.0f * (1.0f - 1.0f / 1.125f), 1e-3f);
    for (const dvec3& offset : {dvec3(0.0), dvec3(1.0, 0.0, 0.0), dvec3(-0.3, 2.0, -4.0)}) {
      const dvec3 world = view.position + offset;
      const vec4 relative(view.relative(world), 1.0f);
      const auto seen = project(face, world);
      EXPECT_NEAR(glm::dot(c.row_u, relative), seen->x, 2e-3);
      EXPECT_NEAR(glm::dot(c.row_v, relative), seen->y, 2e-3);
      EXPECT_NEAR(glm::dot(c.row_depth, relative), seen->depth, 1e-6);
    }
  }
}

}  // namespace
}  // namespace gloam
