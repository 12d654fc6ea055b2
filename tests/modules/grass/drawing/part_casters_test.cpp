// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/drawing/part_casters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "modules/grass/drawing/still_air.h"

namespace gloam {
namespace {

/// A perspective or orthographic projection from a random place, looking along a random axis.
struct Look {
  CasterSourcePart part;
  dvec3 eye;
};

Look random_look(std::mt19937& random, bool orthographic) {
  std::uniform_real_distribution<double> place(-20.0, 20.0), unit(-1.0, 1.0);
  const dvec3 forward = glm::normalize(dvec3(unit(random), unit(random), unit(random)) + dvec3(1e-3));
  const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0.3, 1.0, 0.2)));
  const dvec3 up = glm::cross(right, forward);
  dmat4 rows(0.0);
  rows[0] = dvec4(right, 0.0);
  rows[1] = dvec4(up, 0.0);
  rows[2] = orthographic ? dvec4(forward * -0.05, 1.0) : dvec4(0.0, 0.0, 0.0, 0.05);
  rows[3] = orthographic ? dvec4(0.0, 0.0, 0.0, 8.0) : dvec4(forward, 0.0);
  Look look;
  look.part.projection = {dvec3(place(random), place(random), place(random)), glm::transpose(rows), orthographic};
  const double a = unit(random), b = unit(random), c = unit(random), d = unit(random);
  look.part.clip = vec4(static_cast<float>(std::min(a, b)), static_cast<float>(std::min(c, d)),
                        static_cast<float>(std::max(a, b)), static_cast<float>(std::max(c, d)));
  look.eye = dvec3(place(random), place(random), place(random)) * 1000.0;
  return look;
}

// A point that the part shows is inside all planes, also at the border, and one that it does not show is outside of
// one.
TEST(CasterPart, planes_hold_what_the_part_shows_and_nothing_else) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-30.0, 30.0);
  int shown = 0, hidden = 0;
  for (int i = 0; i < 10000; ++i) {
    const Look look = random_look(random, i % 2 == 1);
    const shaders::GrassCasterPart planes = caster_part(look.part, look.eye);
    const dvec3 from_light(place(random), place(random), place(random));
    const dvec4 clip = look.part.projection.clip_from_relative * dvec4(from_light, 1.0);
    const dvec3 relative = from_light + (look.part.projection.origin - look.eye);
    double least = 1e30;
    for (const vec4& plane : planes.planes) least = std::min(least, glm::dot(dvec3(plane), relative) + double{plane.w});
    const double slack = 1e-6 * (glm::length(relative) + 1.0);
    const dvec4 bounds(look.part.clip);
    const bool inside = clip.w > 0.0 && clip.x >= bounds.x * clip.w && clip.x <= bounds.z * clip.w &&
                        clip.y >= bounds.y * clip.w && clip.y <= bounds.w * clip.w;
    EXPECT_TRUE(!inside || least >= -slack) << i;
    EXPECT_TRUE(inside || least <= slack) << i;
    shown += inside ? 1 : 0;
    hidden += inside ? 0 : 1;
  }
  EXPECT_GT(shown, 100);
  EXPECT_GT(hidden, 1000);
}

TEST(CasterPart, lists_are_found_by_the_index_of_a_part) {
  const std::vector<PartLists> lists = {{.first = 0, .count = 3}, {.first = 3, .count = 1}};
  EXPECT_EQ(find_part(lists, 0), &lists[0]);
  EXPECT_EQ(find_part(lists, 2), &lists[0]);
  EXPECT_EQ(find_part(lists, 3), &lists[1]);
  EXPECT_EQ(find_part(lists, 4), nullptr);
  EXPECT_EQ(find_part(lists, CasterSourceDraw::kNoPart), nullptr);
}

TEST(GrassRestCount, begins_anew_when_a_blade_moves_or_anything_that_moves_blades_changes) {
  GrassRest rest;
  for (int i = 0; i < 3; ++i) {
    rest = counted_rest(rest, {7, 2}, 0);
    EXPECT_FALSE(casters_rest(&rest, 7)) << i;
  }
  rest = counted_rest(rest, {7, 2}, 0);
  EXPECT_TRUE(casters_rest(&rest, 7));
  EXPECT_FALSE(casters_rest(&rest, 8));
  EXPECT_FALSE(casters_rest(nullptr, 7));
  EXPECT_FALSE(casters_rest(&rest, 0)) << "the wind blows";
  rest = counted_rest(rest, {7, 0}, 0);
  EXPECT_TRUE(casters_rest(&rest, 7)) << "a frame without a step says nothing";
  EXPECT_FALSE(casters_rest(&(rest = counted_rest(rest, {8, 2}, 0)), 8));
  rest = counted_rest({7, 8}, {7, 2}, 1);
  EXPECT_FALSE(casters_rest(&rest, 7));
}

}  // namespace
}  // namespace gloam
