// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/drawn_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <vector>

// Which faces and rectangles are drawn when caster sources come, go, change and move.

namespace gloam {
namespace {

constexpr Entity kSpot = {50, 1};
constexpr Entity kOtherSpot = {51, 1};

/// Two spots at the origin, one along −Z and one along +Z, and meshes 4 m in front of the first.
class DrawnFaces : public ::testing::Test {
 protected:
  DrawnFaces() {
    primitive.index_count = 3;
    for (const double side : {-1.0, 1.0}) {
      ShadowFace face;
      face.light = side < 0.0 ? kSpot : kOtherSpot;
      face.right = vec3(static_cast<float>(-side), 0.0f, 0.0f);
      face.forward = vec3(0.0f, 0.0f, static_cast<float>(side));
      face.far_m = 10.0f;
      face.square = {uvec2(side < 0.0 ? 0 : 512, 0), 512};
      faces.push_back(face);
    }
    for (std::uint32_t i = 0; i < 5; ++i) mesh(dvec3(-3.0 + 1.5 * i, 0.0, -4.0));
  }
  void mesh(const dvec3& at) {
    Caster& caster = casters.emplace_back();
    caster.entity = {static_cast<std::uint32_t>(casters.size()), 1};
    caster.primitive = &primitive;
    caster.world_from_mesh = glm::translate(dmat4(1.0), at);
    caster.bounds_min = at - dvec3(0.1);
    caster.bounds_max = at + dvec3(0.1);
  }
  CasterSource& source(const dvec3& low, const dvec3& high, bool moving = false) {
    CasterSource& made = *sources.emplace_back(std::make_unique<CasterSource>());
    made.bounds = {low, high};
    made.content_hash = sources.size();
    made.moving = moving;
    return made;
  }

  /// One frame of the view. given_up: nothing of it is drawn.
  DrawnMaps frame(bool given_up = false) {
    std::vector<const CasterSource*> list;
    for (const auto& made : sources) list.push_back(made.get());
    const MapInputs inputs{
        .faces = faces, .casters = casters, .poses = {}, .sources = list, .salt = 1, .atlas_is_empty = atlas_is_empty};
    DrawnMaps maps = plan_maps(inputs, kept, *executor);
    if (!given_up) commit_maps(maps.faces, maps.held, kept);
    return maps;
  }
  void frames(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) static_cast<void>(frame());
  }

  /// Expects that a region holds the projection of a box in front of the first light, and at most the margin and the
  /// grid of regions (16 texels together) beyond it.
  static void expect_around(const TexelRect& region, const dvec3& low, const dvec3& high) {
    glm::dvec2 least(1e9), most(-1e9);
    for (unsigned corner = 0; corner < 8; ++corner) {
      const dvec3 at((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                     (corner & 4) != 0 ? high.z : low.z);
      const glm::dvec2 texel(256.0 + 256.0 * at.x / -at.z, 256.0 - 256.0 * at.y / -at.z);
      least = glm::min(least, texel);
      most = glm::max(most, texel);
    }
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_LE(region.begin[axis], least[axis]) << axis;
      EXPECT_GE(region.end[axis], most[axis]) << axis;
      EXPECT_GE(region.begin[axis], least[axis] - 16.0) << axis;
      EXPECT_LE(region.end[axis], most[axis] + 16.0) << axis;
    }
  }

  GpuPrimitive primitive;
  std::vector<ShadowFace> faces;
  std::vector<Caster> casters;
  std::vector<std::unique_ptr<CasterSource>> sources;
  ViewMapState kept;
  bool atlas_is_empty = false;  ///< of the next frame
  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
};

const dvec3 kLow(-0.5, 0.5, -3.0), kHigh(0.5, 1.0, -2.5);
using Sources = std::vector<const CasterSource*>;

TEST_F(DrawnFaces, a_resting_source_is_drawn_into_the_faces_that_see_it_and_then_cached) {
  const CasterSource& field = source(kLow, kHigh);
  const DrawnMaps first = frame();
  ASSERT_EQ(first.faces.size(), 2u);
  EXPECT_EQ(first.faces[0].regions[0].sources, Sources{&field});
  EXPECT_EQ(first.faces[1].regions[0].sources, Sources{});
  EXPECT_EQ(first.faces[0].content.casters, 6u);
  EXPECT_EQ(kept.counts.skipped, 1u) << "nothing is in front of the second light";
  EXPECT_TRUE(frame().faces.empty());
  EXPECT_EQ(kept.counts.cached, 2u);
}

TEST_F(DrawnFaces, a_source_that_changes_comes_or_goes_costs_its_rectangle) {
  frames(2);
  CasterSource& field = source(kLow, kHigh);
  for (const char* what : {"it comes", "its hash changes", "it goes"}) {
    SCOPED_TRACE(what);
    if (what[4] == 'h') field.content_hash = 77;
    if (what[3] == 'g') sources.clear();
    const DrawnMaps maps = frame();
    ASSERT_EQ(maps.faces.size(), 1u);
    EXPECT_EQ(maps.faces[0].face.light, kSpot);
    ASSERT_EQ(maps.faces[0].regions.size(), 1u);
    expect_around(maps.faces[0].regions[0].texels, kLow, kHigh);
    EXPECT_EQ(maps.faces[0].regions[0].sources.size(), sources.size());
    EXPECT_EQ(kept.counts.cached, 1u);
    EXPECT_TRUE(frame().faces.empty());
  }
}

TEST_F(DrawnFaces, a_source_of_which_nothing_is_told_is_drawn_in_every_frame) {
  source(kLow, kHigh).content_hash = 0;
  frames(20);
  for (int i = 0; i < 3; ++i) {
    const DrawnMaps maps = frame();
    ASSERT_EQ(maps.faces.size(), 1u);
    EXPECT_EQ(maps.faces[0].face.light, kSpot);
    ASSERT_EQ(maps.faces[0].regions.size(), 1u);
    expect_around(maps.faces[0].regions[0].texels, kLow, kHigh);
    EXPECT_EQ(maps.faces[0].regions[0].sources.size(), 1u);
  }
}

TEST_F(DrawnFaces, bounds_that_move_cost_the_old_and_the_new_rectangle) {
  CasterSource& field = source(kLow, kHigh);
  frames(2);
  const dvec3 step(0.2, 0.0, 0.0);
  field.bounds = {kLow + step, kHigh + step};
  const DrawnMaps maps = frame();
  ASSERT_EQ(maps.faces.size(), 1u);
  ASSERT_EQ(maps.faces[0].regions.size(), 1u);
  expect_around(maps.faces[0].regions[0].texels, kLow, kHigh + step);
}

TEST_F(DrawnFaces, a_frame_that_is_given_up_costs_nothing_in_the_next) {
  CasterSource& field = source(kLow, kHigh);
  frames(2);
  const dvec3 step(0.2, 0.0, 0.0);
  field.bounds = {kLow + step, kHigh + step};
  for (int i = 0; i < 3; ++i) EXPECT_EQ(frame(true).faces.size(), 1u);
  field.bounds = {kLow, kHigh};
  EXPECT_TRUE(frame().faces.empty()) << "the source is back where the map shows it";
  field.bounds = {kLow + step, kHigh + step};
  EXPECT_EQ(frame(true).faces.size(), 1u);
  field.bounds = {kLow - step, kHigh - step};
  const DrawnMaps maps = frame();
  ASSERT_EQ(maps.faces.size(), 1u);
  ASSERT_EQ(maps.faces[0].regions.size(), 1u);
  expect_around(maps.faces[0].regions[0].texels, kLow - step, kHigh);
}

TEST_F(DrawnFaces, maps_that_are_made_anew_in_a_frame_given_up_are_still_held) {
  frames(2);
  atlas_is_empty = true;
  EXPECT_EQ(frame(true).faces.size(), 2u);
  atlas_is_empty = false;
  EXPECT_TRUE(frame().faces.empty());
  atlas_is_empty = true;
  EXPECT_EQ(frame().faces.size(), 2u);
  atlas_is_empty = false;
  EXPECT_TRUE(frame().faces.empty());
}

TEST_F(DrawnFaces, a_moving_source_is_drawn_every_frame_over_casters_that_are_drawn_once) {
  const CasterSource& field = source(dvec3(-0.5, -0.5, -3.0), dvec3(0.5, 0.5, -2.5), true);
  frames(1);
  const DrawnMaps second = frame();
  ASSERT_EQ(second.backgrounds.size(), 1u);
  ASSERT_EQ(second.backgrounds[0].regions.size(), 1u);
  EXPECT_EQ(second.backgrounds[0].regions[0].sources, Sources{});
  EXPECT_GE(second.backgrounds[0].regions[0].draws.size(), 1u) << "the mesh in the middle";
  std::uint64_t texels = 0;
  for (int i = 0; i < 20; ++i) {
    const DrawnMaps maps = frame();
    EXPECT_TRUE(maps.backgrounds.empty()) << i;
    ASSERT_EQ(maps.faces.size(), 1u);
    ASSERT_EQ(maps.faces[0].regions.size(), 1u);
    const DrawnRegion& region = maps.faces[0].regions[0];
    expect_around(region.texels, field.bounds.min, field.bounds.max);
    EXPECT_TRUE(region.on_background);
    EXPECT_TRUE(region.draws.empty());
    EXPECT_EQ(region.sources, Sources{&field});
    if (i > 0) {
      EXPECT_EQ(kept.counts.texels, texels);
    }
    texels = kept.counts.texels;
    EXPECT_EQ(texels, region.texels.texels());
  }
}

TEST_F(DrawnFaces, a_moving_source_over_a_whole_face_leaves_its_resting_casters_cached) {
  const CasterSource& field = source(dvec3(-9.0, -9.0, -3.0), dvec3(9.0, 9.0, -2.5), true);
  EXPECT_TRUE(frame().backgrounds.empty()) << "a first map needs none";
  const DrawnMaps second = frame();
  ASSERT_EQ(second.backgrounds.size(), 1u);
  EXPECT_EQ(second.backgrounds[0].regions[0].texels, whole_face(faces[0]));
  EXPECT_EQ(second.backgrounds[0].regions[0].draws.size(), 5u);
  const DrawnMaps third = frame();
  EXPECT_TRUE(third.backgrounds.empty());
  ASSERT_EQ(third.faces.size(), 1u);
  EXPECT_EQ(third.faces[0].regions[0].texels, whole_face(faces[0]));
  EXPECT_TRUE(third.faces[0].regions[0].on_background);
  EXPECT_TRUE(third.faces[0].regions[0].draws.empty());
  EXPECT_EQ(third.faces[0].regions[0].sources, Sources{&field});
  faces[0].origin.x += 0.01;
  const DrawnMaps elsewhere = frame();
  EXPECT_TRUE(elsewhere.backgrounds.empty()) << "a light that moves needs none either";
  EXPECT_EQ(elsewhere.faces[0].regions[0].draws.size(), 5u);
}

TEST_F(DrawnFaces, a_resting_source_belongs_to_the_background_of_what_moves_in_front_of_it) {
  const CasterSource& field = source(dvec3(-0.5, -0.5, -5.0), dvec3(0.5, 0.5, -4.5));
  const CasterSource& blade = source(dvec3(-0.2, -0.2, -3.0), dvec3(0.2, 0.2, -2.5), true);
  frames(1);
  const DrawnMaps second = frame();
  ASSERT_EQ(second.backgrounds.size(), 1u);
  EXPECT_EQ(second.backgrounds[0].regions[0].sources, Sources{&field});
  EXPECT_EQ(second.faces[0].regions[0].sources, Sources{&blade});
  EXPECT_TRUE(frame().backgrounds.empty());
  sources[0]->content_hash = 99;
  const DrawnMaps changed = frame();
  ASSERT_EQ(changed.faces.size(), 1u);
  Sources drawn;
  for (const DrawnRegion& region : changed.faces[0].regions)
    for (const CasterSource* one : region.sources)
      if (std::ranges::find(drawn, one) == drawn.end()) drawn.push_back(one);
  EXPECT_EQ(drawn, (Sources{&field, &blade})) << "it has changed, so it does not rest";
}

TEST_F(DrawnFaces, a_source_that_stops_is_drawn_once_more_and_then_rests) {
  CasterSource& field = source(kLow, kHigh, true);
  frames(5);
  field.moving = false;
  ASSERT_EQ(frame().faces.size(), 1u);
  EXPECT_TRUE(frame().faces.empty());
  frames(CasterHistory::kRestFrames);
  source(kLow - dvec3(0.0, 0.0, 1.0), kHigh - dvec3(0.0, 0.0, 1.0), true);
  const DrawnMaps maps = frame();
  ASSERT_EQ(maps.backgrounds.size(), 1u);
  EXPECT_EQ(maps.backgrounds[0].regions[0].sources, Sources{&field});
}

TEST_F(DrawnFaces, a_source_that_takes_turns_is_drawn_in_every_second_frame_at_all_places_that_it_had) {
  CasterSource& field = source(kLow, kHigh, true);
  field.turns = 2;
  frames(2);
  dvec3 low = kLow, high = kHigh;
  std::vector<dvec3> lows, highs;  // since it was drawn
  int drawn = 0;
  for (int i = 0; i < 6; ++i) {
    lows.push_back(low), highs.push_back(high);
    low.x += 0.5, high.x += 0.5;
    field.bounds = {low, high};
    const DrawnMaps maps = frame();
    EXPECT_EQ(kept.counts.in_turn, maps.faces.empty() ? 1u : 0u);
    if (maps.faces.empty()) continue;
    ++drawn;
    lows.push_back(low), highs.push_back(high);
    ASSERT_EQ(maps.faces.size(), 1u);
    for (std::size_t n = 0; n < lows.size(); ++n) {
      const TexelRect wanted = covered_texels(faces[0], lows[n], highs[n]);
      std::uint64_t covered = 0;
      for (const DrawnRegion& region : maps.faces[0].regions) {
        const TexelRect both{glm::max(region.texels.begin, wanted.begin), glm::min(region.texels.end, wanted.end)};
        covered += both.texels();
        EXPECT_EQ(region.sources, Sources{&field});
      }
      EXPECT_EQ(covered, wanted.texels()) << "place " << n << " in frame " << i;
    }
    lows.clear(), highs.clear();
  }
  EXPECT_EQ(drawn, 3);
}

TEST_F(DrawnFaces, beside_a_mesh_that_moves_a_source_waits_for_its_turn_elsewhere) {
  CasterSource& field = source(kLow, kHigh, true);
  field.turns = 4;
  frames(4);
  int whole = 0;
  for (int i = 0; i < 8; ++i) {
    casters[0].world_from_mesh = glm::translate(casters[0].world_from_mesh, dvec3(0.0, 0.01, 0.0));
    casters[0].bounds_min.y += 0.01, casters[0].bounds_max.y += 0.01;
    const DrawnMaps maps = frame();
    ASSERT_EQ(maps.faces.size(), 1u) << i;
    const TexelRect blades = covered_texels(faces[0], kLow, kHigh);
    bool has_blades = false;
    for (const DrawnRegion& region : maps.faces[0].regions) has_blades = has_blades || region.texels.contains(blades);
    whole += has_blades ? 1 : 0;
    EXPECT_EQ(kept.counts.in_turn, has_blades ? 0u : 1u) << i;
  }
  EXPECT_EQ(whole, 2);
}

TEST_F(DrawnFaces, a_source_that_stops_while_it_waits_is_drawn_once_more) {
  CasterSource& field = source(kLow, kHigh, true);
  field.turns = 2;
  frames(3);
  while (frame().faces.size() != 1) {
  }
  ASSERT_TRUE(frame().faces.empty()) << "it waits";
  field.moving = false;
  field.turns = 1;
  ASSERT_EQ(frame().faces.size(), 1u);
  EXPECT_TRUE(frame().faces.empty());
}

TEST_F(DrawnFaces, sources_that_no_light_reaches_cost_nothing) {
  source(dvec3(-1.0, -1.0, -12.0), dvec3(1.0, 1.0, -11.0), true);  // beyond the range
  source(dvec3(20.0, 0.0, -1.0), dvec3(21.0, 1.0, 1.0), true);     // beside both faces
  for (const DrawnFace& face : frame().faces) EXPECT_TRUE(face.regions[0].sources.empty());
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(frame().faces.empty());
    EXPECT_EQ(kept.counts.texels, 0u);
  }
}

TEST_F(DrawnFaces, a_source_with_unknown_bounds_is_in_all_faces) {
  CasterSource& field = source(kLow, kHigh, true);
  for (const WorldBox& unknown : {WorldBox{}, WorldBox{dvec3(std::nan("")), kHigh}, WorldBox{kHigh, kLow}}) {
    field.bounds = unknown;
    const DrawnMaps maps = frame();
    ASSERT_EQ(maps.faces.size(), 2u);
    for (const DrawnFace& face : maps.faces) {
      EXPECT_EQ(face.regions[0].texels, whole_face(face.face));
      EXPECT_EQ(face.regions[0].sources, Sources{&field});
    }
  }
}

TEST_F(DrawnFaces, a_source_is_withheld_with_its_entity) {
  source(dvec3(2.0, 2.0, -3.0), dvec3(2.1, 2.1, -2.5));
  CasterSource& field = source(kLow, kHigh, true);
  field.entity = {3, 1};
  frames(3);
  kept.history.withhold({{{kSpot, {{3, 1}}}}});
  const DrawnMaps left_out = frame();
  ASSERT_EQ(left_out.faces.size(), 1u) << "the map without it";
  for (const DrawnRegion& region : left_out.faces[0].regions) EXPECT_EQ(region.sources, Sources{});
  EXPECT_FALSE(left_out.faces[0].content.moving);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(frame().faces.empty()) << "it sways unseen";
  kept.history.withhold({});
  const DrawnMaps back = frame();
  ASSERT_EQ(back.faces.size(), 1u);
  Sources drawn;
  for (const DrawnRegion& region : back.faces[0].regions)
    drawn.insert(drawn.end(), region.sources.begin(), region.sources.end());
  EXPECT_TRUE(std::ranges::find(drawn, &field) != drawn.end());
}

TEST_F(DrawnFaces, a_resting_source_costs_its_rectangle_when_it_is_withheld_and_when_it_comes_back) {
  source(kLow, kHigh).entity = {900, 1};  // behind all meshes' entities
  source(dvec3(2.0, 2.0, -3.0), dvec3(2.1, 2.1, -2.5));
  frames(3);
  for (const bool withheld : {true, false}) {
    kept.history.withhold(withheld ? WithheldCasters{{{kSpot, {{900, 1}}}}} : WithheldCasters{});
    const DrawnMaps maps = frame();
    ASSERT_EQ(maps.faces.size(), 1u) << withheld;
    ASSERT_EQ(maps.faces[0].regions.size(), 1u);
    expect_around(maps.faces[0].regions[0].texels, kLow, kHigh);
    EXPECT_TRUE(frame().faces.empty());
  }
}

}  // namespace
}  // namespace gloam
