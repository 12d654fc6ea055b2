// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <random>
#include <set>

#include "modules/shadows/atlas/face_casters.h"

namespace gloam {
namespace {

/// The six faces of a lamp at the origin, and casters on its axes, 3 m away.
class ShadowCacheTest : public ::testing::Test {
 protected:
  ShadowCacheTest() {
    const vec3 axes[] = {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1)};
    for (std::uint32_t i = 0; i < 6; ++i) {
      ShadowFace face;
      face.light = {7, 1};
      face.kind = LightKind::point;
      face.index = i;
      face.forward = axes[i];
      face.up = std::abs(axes[i].y) > 0.5f ? vec3(0, 0, 1) : vec3(0, 1, 0);
      face.right = glm::cross(face.forward, face.up);
      face.far_m = 10.0f;
      face.square = {uvec2(64 * i, 0), 64};
      faces.push_back(face);
      casters.push_back(caster(i, 3.0 * dvec3(axes[i])));
    }
  }
  Caster caster(std::uint32_t entity, const dvec3& at) {
    Caster made;
    made.entity = {entity, 1};
    made.primitive = &primitive;
    move(made, at);
    return made;
  }
  static void move(Caster& caster, const dvec3& at) {
    caster.world_from_mesh = glm::translate(dmat4(1.0), at);
    caster.bounds_min = at - dvec3(0.2);
    caster.bounds_max = at + dvec3(0.2);
  }
  [[nodiscard]] std::vector<FaceContent> contents(std::uint64_t salt = 1) const {
    return face_contents(faces, caster_states(casters, {}, *executor), salt, *executor);
  }
  /// The faces whose map the cache does not hold.
  [[nodiscard]] std::vector<std::uint32_t> dirty() const {
    const auto now = contents();
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < faces.size(); ++i)
      if (!cache.has_map(faces[i], now[i])) found.push_back(i);
    return found;
  }
  void draw_all() {
    const auto now = contents();
    for (std::size_t i = 0; i < faces.size(); ++i) cache.set_drawn(faces[i], now[i]);
  }

  GpuPrimitive primitive;
  std::vector<ShadowFace> faces;
  std::vector<Caster> casters;
  ShadowCache cache;
  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
};

using Faces = std::vector<std::uint32_t>;

TEST_F(ShadowCacheTest, holds_what_was_drawn_and_nothing_else) {
  EXPECT_EQ(dirty(), (Faces{0, 1, 2, 3, 4, 5}));
  draw_all();
  EXPECT_EQ(dirty(), Faces{});
  cache.clear();
  EXPECT_EQ(dirty().size(), 6u);
}

TEST_F(ShadowCacheTest, a_caster_that_moves_touches_the_faces_that_see_it) {
  draw_all();
  move(casters[2], dvec3(0.0, 3.1, 0.0));
  EXPECT_EQ(dirty(), Faces{2});
  draw_all();
  move(casters[2], dvec3(3.1, 0.0, 0.2));  // from the upper face to the right one
  EXPECT_EQ(dirty(), (Faces{0, 2}));
}

TEST_F(ShadowCacheTest, casters_that_come_and_go_touch_the_faces_that_see_them) {
  draw_all();
  casters.push_back(caster(9, dvec3(0.0, 0.0, 4.0)));
  EXPECT_EQ(dirty(), Faces{4});
  draw_all();
  casters.pop_back();
  EXPECT_EQ(dirty(), Faces{4});
}

TEST_F(ShadowCacheTest, what_is_out_of_reach_touches_no_face) {
  draw_all();
  casters.push_back(caster(9, dvec3(0.0, 0.0, 11.0)));
  EXPECT_EQ(dirty(), Faces{});
}

TEST_F(ShadowCacheTest, a_caster_whose_vertices_move_keeps_its_faces_dirty) {
  casters[5].moving = true;
  draw_all();
  EXPECT_EQ(dirty(), Faces{5});
}

TEST_F(ShadowCacheTest, a_light_that_moves_touches_all_its_faces) {
  draw_all();
  for (ShadowFace& face : faces) face.origin.x += 1e-3;
  EXPECT_EQ(dirty().size(), 6u);
}

TEST_F(ShadowCacheTest, a_face_that_gets_another_square_is_drawn_again_and_so_is_what_lay_there) {
  draw_all();
  faces[0].square = {uvec2(128, 0), 128};  // overlaps the squares of faces 2 and 3
  EXPECT_EQ(dirty(), Faces{0});
  const auto now = contents();
  cache.set_drawn(faces[0], now[0]);
  EXPECT_EQ(dirty(), (Faces{2, 3}));
  faces[2].square = {uvec2(192, 64), 32};  // inside the square of face 0
  const auto then = contents();
  cache.set_drawn(faces[2], then[2]);
  EXPECT_EQ(dirty(), (Faces{0, 3}));
  EXPECT_EQ(cache.size(), 4u);
}

TEST_F(ShadowCacheTest, squares_that_only_touch_do_not_disturb_each_other) {
  std::mt19937 random(5);
  faces.clear();
  casters.clear();
  std::set<std::uint32_t> alive;
  for (std::uint32_t i = 0; i < 600; ++i) {
    ShadowFace face;
    face.light = {i, 1};
    const std::uint32_t size = 16u << random() % 5;
    face.square = {uvec2(random() % (512 / size), random() % (512 / size)) * size, size};
    std::erase_if(alive, [&](std::uint32_t other) {
      const AtlasSquare& a = faces[other].square;
      const AtlasSquare& b = face.square;
      return a.origin.x < b.origin.x + b.size && b.origin.x < a.origin.x + a.size && a.origin.y < b.origin.y + b.size &&
             b.origin.y < a.origin.y + a.size;
    });
    alive.insert(i);
    faces.push_back(face);
    cache.set_drawn(face, {});
    ASSERT_EQ(cache.size(), alive.size());
    for (const std::uint32_t other : alive) ASSERT_TRUE(cache.has_map(faces[other], {}));
  }
}

/// Casters around many lights: face_contents() counts exactly the casters that may_see() finds, although it skips
/// casters out of range.
TEST_F(ShadowCacheTest, a_faces_content_has_all_casters_that_it_may_see) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> spread(-15.0, 15.0), shift(-1e6, 1e6);
  const dvec3 middle(shift(random), shift(random), shift(random));
  casters.clear();
  for (std::uint32_t i = 0; i < 400; ++i)
    casters.push_back(caster(i, middle + dvec3(spread(random), spread(random), spread(random))));
  casters[7].bounds_max = casters[7].bounds_min - dvec3(1.0);  // may be anywhere
  const std::vector<ShadowFace> cube = faces;
  for (std::uint32_t light = 0; light < 12; ++light) {
    const dvec3 at = middle + dvec3(spread(random), spread(random), spread(random));
    for (ShadowFace face : cube) {
      face.light = {100 + light, 1};
      face.origin = at;
      face.far_m = 1.0f + static_cast<float>(light);
      if (light == 3) face.tan_half = 0.0f, face.half_extent_m = 4.0f;
      faces.push_back(face);
    }
  }
  const auto found = contents();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const FaceVolume volume = face_volume(faces[f]);
    const auto seen = std::ranges::count_if(casters, [&](const Caster& c) { return may_see(volume, c); });
    EXPECT_EQ(found[f].casters, seen) << f;
  }
}

TEST_F(ShadowCacheTest, withheld_casters_are_as_if_they_were_not_there) {
  const std::size_t own = faces.size();
  for (std::size_t i = 0; i < own; ++i) {
    faces.push_back(faces[i]);
    faces.back().light = {8, 1};
  }
  casters[4].moving = true;
  const auto states = caster_states(casters, {}, *executor);
  const WithheldCasters withheld = {{{{7, 1}, {{2, 1}, {4, 1}}}, {{9, 1}, {{3, 1}}}}};
  const auto found = face_contents(faces, states, 1, *executor, withheld), with_all = contents();
  casters.erase(casters.begin() + 4);
  casters.erase(casters.begin() + 2);
  const auto without = contents();
  for (std::size_t i = 0; i < own; ++i) {
    EXPECT_EQ(found[i], without[i]) << i;
    EXPECT_EQ(found[own + i], with_all[own + i]) << "another light " << i;
  }
  EXPECT_NE(found[2], with_all[2]);
  EXPECT_TRUE(with_all[4].moving);
  EXPECT_FALSE(found[4].moving);
}

TEST_F(ShadowCacheTest, other_knobs_are_other_content) {
  const auto one = contents(1), other = contents(2);
  for (std::size_t i = 0; i < faces.size(); ++i) EXPECT_NE(one[i].hash, other[i].hash);
}

TEST_F(ShadowCacheTest, content_does_not_depend_on_the_number_of_threads) {
  const auto serial = make_serial_executor();
  EXPECT_EQ(face_contents(faces, caster_states(casters, {}, *serial), 1, *serial), contents());
}

}  // namespace
}  // namespace gloam
