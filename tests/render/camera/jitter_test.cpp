// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/camera/jitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/render_scene.h"

namespace gloam {
namespace {

/// Pixel, to the right and down, at which a view shows a world position; in double precision.
glm::dvec2 pixel_of(const dmat4& clip_from_relative, const dvec3& eye, const RenderView& view, const dvec3& world) {
  const dvec4 clip = clip_from_relative * dvec4(world - eye, 1.0);
  return glm::dvec2(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w) * glm::dvec2(view.width, view.height);
}
glm::dvec2 pixel_of(const RenderView& view, const dvec3& world) {
  return pixel_of(dmat4(view.clip_from_relative), view.position, view, world);
}

std::vector<ViewSettings> all_kinds_of_views() {
  std::vector<ViewSettings> kinds;
  for (const bool orthographic : {false, true})
    for (const bool mirrored : {false, true}) {
      ViewSettings settings = test::look_at(dvec3(1.0, 2.0, 5.0), dvec3(0.2, 0.1, 0.0), 160, 90);
      settings.camera.orthographic = orthographic;
      settings.camera.half_height_m = 3.0f;
      if (mirrored) settings.mirror = MirrorPlane{.normal = glm::normalize(dvec3(0.1, 1.0, 0.0)), .offset = -2.0};
      kinds.push_back(settings);
    }
  return kinds;
}

const dvec3 kPoints[] = {{0.2, 0.1, 0.0}, {-1.0, 1.0, -3.0}, {1.5, -0.8, 1.0}};

TEST(Jitter, begins_at_the_centre_and_repeats) {
  EXPECT_EQ(jitter_point(0), vec2(0.0f));
  for (std::uint64_t i = 0; i < 2 * kJitterPoints; ++i) {
    EXPECT_EQ(jitter_point(i), jitter_point(i + kJitterPoints)) << i;
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(jitter_point(i), vec2(-0.5f)))) << i;
    EXPECT_TRUE(glm::all(glm::lessThan(jitter_point(i), vec2(0.5f)))) << i;
  }
}

TEST(Jitter, has_a_point_in_each_box_after_each_power_of_two) {
  for (int bits = 1; bits <= 6; ++bits)
    for (std::uint32_t first = 0; first < kJitterPoints; first += 1u << bits)
      for (int across = 0; across <= bits; ++across) {
        std::set<std::pair<int, int>> boxes;
        for (std::uint32_t i = first; i < first + (1u << bits); ++i) {
          const vec2 at = jitter_point(i) + 0.5f;
          boxes.insert({static_cast<int>(std::ldexp(at.x, across)), static_cast<int>(std::ldexp(at.y, bits - across))});
        }
        EXPECT_EQ(boxes.size(), 1u << bits) << first << " " << across;
      }
}

TEST(Jitter, shows_the_point_beside_the_centre_of_each_pixel) {
  for (const ViewSettings& settings : all_kinds_of_views())
    for (const vec2 jitter : {vec2(0.0f), vec2(0.4f, -0.3f), vec2(-0.5f, 0.25f)}) {
      const RenderView plain = make_view(settings, 3);
      RenderView view = plain;
      apply_jitter(view, jitter);
      EXPECT_TRUE(view.jittered);
      EXPECT_EQ(view.jitter, jitter);
      for (const dvec3& point : kPoints) {
        const glm::dvec2 moved = pixel_of(view, point) - pixel_of(plain, point);
        EXPECT_NEAR(moved.x, -jitter.x, 1e-3) << settings.camera.orthographic << settings.mirror.has_value();
        EXPECT_NEAR(moved.y, -jitter.y, 1e-3) << settings.camera.orthographic << settings.mirror.has_value();
        const vec4 clip = view.clip_from_relative * vec4(view.relative(point), 1.0f);
        const vec4 unmoved = plain.clip_from_relative * vec4(plain.relative(point), 1.0f);
        EXPECT_NEAR(clip.z / clip.w, unmoved.z / unmoved.w, 1e-5) << "depth does not change";
        if (!plain.clipped) continue;
        EXPECT_NEAR(glm::dot(vec3(view.clip_plane), view.relative(point)) + view.clip_plane.w,
                    glm::dot(vec3(plain.clip_plane), plain.relative(point)) + plain.clip_plane.w, 1e-5);
      }
    }
}

TEST(Jitter, leaves_motion_as_it_is) {
  for (const ViewSettings& settings : all_kinds_of_views()) {
    ViewSettings before = settings;
    before.world_from_camera[3] += dvec4(0.1, -0.05, 0.2, 0.0);
    RenderView plain = make_view(settings, 3);
    plain.previous = make_view(before, 2).view_camera();
    RenderView view = plain;
    apply_jitter(view, {0.4f, -0.3f});
    for (const dvec3& point : kPoints) {
      const auto motion = [&](const RenderView& v) {
        return pixel_of(v, point) - pixel_of(dmat4(v.previous.clip_from_relative), v.previous.position, v, point);
      };
      EXPECT_NEAR(motion(view).x, motion(plain).x, 1e-3);
      EXPECT_NEAR(motion(view).y, motion(plain).y, 1e-3);
    }
  }
}

TEST(Jitter, leaves_the_frustum_and_the_steady_camera_where_they_are) {
  for (const ViewSettings& settings : all_kinds_of_views()) {
    const RenderView plain = make_view(settings, 3);
    EXPECT_EQ(plain.steady_camera().clip_from_relative, plain.clip_from_relative);
    for (const vec2 jitter : {vec2(0.0f), vec2(0.4f, -0.3f), vec2(-0.5f, -0.5f), vec2(0.5f, 0.5f)}) {
      RenderView view = plain;
      apply_jitter(view, jitter);
      EXPECT_EQ(view.steady_camera().position, plain.position);
      EXPECT_EQ(view.steady_camera().clip_from_relative, plain.clip_from_relative);
      // The distance of a point in the picture's corners, which the planes hold, from the nearest one: at most a pixel.
      for (const float x : {-1.0f, 1.0f})
        for (const float y : {-1.0f, 1.0f}) {
          const vec4 from_clip = glm::inverse(view.clip_from_relative) * vec4(x, y, 0.1f, 1.0f);
          const vec3 corner = vec3(from_clip) / from_clip.w;
          const float pixel = 2.0f / view.clip_from_view[1][1] / static_cast<float>(view.height) *
                              (settings.camera.orthographic ? 1.0f : glm::length(corner));
          float nearest = 1e9f;
          for (int i = 0; i < 4; ++i) {
            const Plane& plane = view.frustum.planes[static_cast<std::size_t>(i)];
            nearest = std::min(nearest, glm::dot(plane.normal, corner) + plane.distance);
          }
          EXPECT_GE(nearest, -1e-3f * pixel) << "inside, up to rounding";
          EXPECT_LE(nearest, 1.01f * pixel);
        }
      for (std::size_t i = 0; i < 4; ++i) {
        const Plane& plane = view.frustum.planes[i];
        RenderView centred = plain;
        apply_jitter(centred, vec2(0.0f));
        EXPECT_EQ(plane.normal, centred.frustum.planes[i].normal);
        const vec3 moved = vec3(view.position - plain.position);
        EXPECT_NEAR(plane.distance, centred.frustum.planes[i].distance + glm::dot(plane.normal, moved), 1e-5f);
      }
    }
  }
}

TEST(Jitter, gives_a_camera_at_rest_no_motion_at_all) {
  for (const ViewSettings& settings : all_kinds_of_views()) {
    RenderView view = make_view(settings, 3);
    apply_jitter(view, {0.3f, 0.2f});
    EXPECT_EQ(view.previous.clip_from_relative, view.clip_from_relative);
    EXPECT_EQ(view.previous.position, view.position);
  }
}

}  // namespace
}  // namespace gloam
