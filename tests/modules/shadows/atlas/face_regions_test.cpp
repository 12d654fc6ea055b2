// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/face_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "modules/shadows/atlas/face_casters.h"

namespace gloam {
namespace {

ShadowFace face_at(const dvec3& origin, bool perspective) {
  ShadowFace face;
  face.origin = origin;
  face.tan_half = perspective ? 1.125f : 0.0f;
  face.half_extent_m = perspective ? 0.0f : 4.0f;
  face.near_m = perspective ? 0.05f : 0.0f;
  face.far_m = 20.0f;
  face.square = {uvec2(512, 0), 512};
  return face;
}

/// The texel of a world position in the face; false when it is nearer than the near plane.
bool place_in(const ShadowFace& face, const dvec3& point, glm::dvec2& place) {
  const vec4 clip = clip_from_mesh(face, dmat4(1.0)) * vec4(vec3(point), 1.0f);
  if (face.tan_half > 0.0f && clip.w < face.near_m) return false;
  place = (glm::dvec2(clip.x, -clip.y) / static_cast<double>(clip.w) + 1.0) * (0.5 * face.square.size);
  return true;
}

TEST(FaceRegions, every_point_of_a_box_lies_in_what_it_covers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> spread(-6.0, 6.0), share(0.0, 1.0);
  int inside = 0;
  for (int round = 0; round < 400; ++round) {
    const ShadowFace face = face_at(dvec3(0.5, -0.3, 0.2), round % 2 == 0);
    const dvec3 low(spread(random), spread(random), spread(random));
    const CasterBox box{low, low + 2.0 * dvec3(share(random), share(random), share(random))};
    const TexelRect covered = covered_texels(face, box);
    for (int i = 0; i < 50; ++i) {
      const dvec3 point = glm::mix(box.low, box.high, dvec3(share(random), share(random), share(random)));
      glm::dvec2 place;
      if (!place_in(face, point, place)) continue;
      const double size = face.square.size;
      if (place.x < 0.0 || place.y < 0.0 || place.x >= size || place.y >= size) continue;
      ++inside;
      ASSERT_TRUE(place.x >= covered.begin.x && place.y >= covered.begin.y && place.x < covered.end.x &&
                  place.y < covered.end.y)
          << round;
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST(FaceRegions, a_box_behind_the_light_covers_nothing_and_one_that_nobody_knows_all) {
  const ShadowFace face = face_at(dvec3(0.0), true);
  EXPECT_TRUE(covered_texels(face, {dvec3(-1.0, -1.0, 1.0), dvec3(1.0, 1.0, 2.0)}).empty());
  EXPECT_EQ(covered_texels(face, {dvec3(1.0), dvec3(-1.0)}), whole_face(face));
  const CasterBox round_the_light{dvec3(-1.0), dvec3(1.0)};
  EXPECT_EQ(covered_texels(face, round_the_light), whole_face(face));
}

TEST(FaceRegions, boxes_far_apart_are_regions_of_their_own_and_near_ones_are_joined) {
  const ShadowFace face = face_at(dvec3(0.0), false);
  const auto small_box = [](double x, double y) { return CasterBox{{x, y, -5.0}, {x + 0.2, y + 0.2, -4.8}}; };
  const CasterBox apart[] = {small_box(-3.0, -3.0), small_box(3.0, 3.0)};
  EXPECT_EQ(covered_regions(face, apart).size(), 2u);
  const CasterBox near[] = {small_box(-3.0, -3.0), small_box(-2.7, -3.0)};
  EXPECT_EQ(covered_regions(face, near).size(), 1u);
  const CasterBox outside[] = {small_box(9.0, 0.0)};
  EXPECT_TRUE(covered_regions(face, outside).empty());
}

TEST(FaceRegions, regions_are_few_do_not_overlap_and_hold_every_box) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> spread(-4.0, 4.0);
  for (int round = 0; round < 200; ++round) {
    const ShadowFace face = face_at(dvec3(0.0), false);
    std::vector<CasterBox> boxes;
    for (int i = 0; i < 1 + round % 12; ++i) {
      const dvec3 low(spread(random), spread(random), -6.0);
      boxes.push_back({low, low + dvec3(0.3)});
    }
    const std::vector<TexelRect> regions = covered_regions(face, boxes);
    EXPECT_LE(regions.size(), kMostRegions);
    for (const TexelRect& a : regions) {
      EXPECT_EQ(a.begin % kRegionStep, uvec2(0));
      EXPECT_EQ(a.end % kRegionStep, uvec2(0));
      for (const TexelRect& b : regions)
        EXPECT_TRUE(&a == &b || a.begin.x >= b.end.x || b.begin.x >= a.end.x || a.begin.y >= b.end.y ||
                    b.begin.y >= a.end.y);
    }
    for (const CasterBox& box : boxes) {
      const TexelRect covered = covered_texels(face, box);
      EXPECT_TRUE(std::ranges::any_of(regions, [&](const TexelRect& region) {
        return glm::all(glm::lessThanEqual(region.begin, covered.begin)) &&
               glm::all(glm::greaterThanEqual(region.end, covered.end));
      }));
    }
  }
}

TEST(FaceRegions, the_volume_of_a_region_sees_what_is_drawn_there) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> spread(-4.0, 4.0);
  const TexelRect region{{64, 192}, {128, 320}};
  int seen = 0;
  for (int i = 0; i < 4000; ++i) {
    const ShadowFace face = face_at(dvec3(0.0), i % 2 == 0);
    const dvec3 point(spread(random), spread(random), spread(random) - 4.1);
    glm::dvec2 place;
    if (!place_in(face, point, place)) continue;
    const bool drawn = place.x >= region.begin.x && place.y >= region.begin.y && place.x < region.end.x &&
                       place.y < region.end.y && point.z > -20.0;
    const bool in_view = may_see(face_volume(face, region), CasterBox{point, point});
    EXPECT_TRUE(!drawn || in_view);
    seen += in_view;
  }
  EXPECT_GT(seen, 20);
  EXPECT_LT(seen, 1000);
}

}  // namespace
}  // namespace gloam
