// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "tests/modules/grass/support/stems.h"

#include "engine/render/readback/geometry_picture.h"

namespace gloam::test {
namespace {

/// Several views of one field.
class GrassInViews : public GrassTest {
 protected:
  static void blow(GrassStage& stage) {
    stage.lawn(2.0f, 4000);
    stage.wind(vec3(5.0f, 0.0f, 1.0f), 0.6f);
    stage.set("grass.cast_distance", "0");
    stage.run_at(1.0 / 60.0);
  }
  [[nodiscard]] static ViewSettings whole() { return look_at({0.0, 2.0, 5.0}, {0.0, 0.0, 0.0}, 96, 64); }
  [[nodiscard]] static ViewSettings corner() {
    ViewSettings view = look_at({-1.6, 0.8, -0.9}, {-1.7, 0.1, -1.9}, 48, 32);
    view.id = ViewId{1};
    return view;
  }
  [[nodiscard]] static std::set<std::uint32_t> masters_of(const GrassStage& stage, const GrassCopy& copy) {
    std::set<std::uint32_t> masters;
    for (const auto& [master, knots] : copy.live_knots(stage.field())) masters.insert(master);
    return masters;
  }
  [[nodiscard]] static GrassSurface wide() {
    GrassSurface values;
    values.width_m = 0.03f;
    return values;
  }
};

TEST_F(GrassInViews, two_views_of_a_frame_simulate_each_master_once) {
  GrassStage stage;
  blow(stage);
  for (int frame = 0; frame < 4; ++frame) {
    const ViewSettings views[] = {corner(), whole()};
    stage.draw(views);
    const GrassCopy near = stage.copy(ViewId{1}), all = stage.copy(ViewId{0});
    std::set<std::uint32_t> masters = masters_of(stage, near);
    EXPECT_EQ(near.dispatch.masters, masters.size());
    EXPECT_GT(masters.size(), 10u);
    masters.merge(masters_of(stage, all));
    EXPECT_EQ(near.dispatch.masters + all.dispatch.masters, masters.size()) << "frame " << frame;
    EXPECT_EQ(knot_distance(near.live_knots(stage.field()), all.live_knots(stage.field())), 0.0);
  }
}

TEST_F(GrassInViews, a_second_view_does_not_change_what_the_first_shows) {
  GrassStage alone, both;
  blow(alone);
  blow(both);
  for (int frame = 0; frame < 5; ++frame) {
    alone.draw(whole());
    const ViewSettings views[] = {corner(), whole()};
    both.draw(views);
    EXPECT_TRUE(alone.copy().live_knots(alone.field()) == both.copy().live_knots(both.field())) << "frame " << frame;
  }
  EXPECT_EQ(differences(alone.linear().rgba, both.linear().rgba), 0u);
}

TEST_F(GrassInViews, the_counters_tell_what_was_simulated) {
  GrassStage stage;
  blow(stage);
  stage.draw(whole());
  const std::map<std::string, double> counters = stage.renderer->report().counters;
  const GrassCopy copy = stage.copy();
  EXPECT_EQ(counters.at("grass.live"), copy.draws.live);
  EXPECT_EQ(counters.at("grass.masters_simulated"), copy.dispatch.masters);
  EXPECT_EQ(counters.at("grass.blades"), 4000.0);
  EXPECT_EQ(counters.at("grass.patches"), static_cast<double>(copy.patches.size()));
}

TEST_F(GrassInViews, a_mirror_shows_the_blades_on_its_visible_side) {
  GrassStage stage;
  stage.set("grass.lod_pixels", "0");
  stage.set("grass.segments", "full");
  stage.lawn(0.6f, 250, dvec3(0.0), wide());
  for (const auto& [normal, offset] :
       {std::pair{dvec3(0.0, 0.0, 1.0), -0.8}, {dvec3(0.0, 0.0, 1.0), 0.0}, {dvec3(0.0, 1.0, 0.0), 0.1}}) {
    SCOPED_TRACE(std::to_string(normal.y) + " " + std::to_string(offset));
    ViewSettings view = front();
    if (normal.y > 0.0) view = look_at({0.1, 0.45, 1.3}, {0.0, 0.05, 0.0}, 96, 64);
    view.mirror = MirrorPlane{normal, offset};
    const GrassPicture picture = grass_picture(stage, view);
    EXPECT_TRUE(picture.with.view.mirrored);
    EXPECT_GT(picture.grass_pixels(), 100u);
    std::vector<Stem> stems = stems_of(stage.field(), stage.copy(), picture.with.view.position);
    expect_grass_on_stems(picture, stems);
    std::size_t behind = 0;
    for (std::size_t i = 0; i < picture.with.depth.size(); ++i)
      behind += picture.is_grass(i) && glm::dot(picture.world(i), normal) <
                                           offset - 0.002 - 0.53 * pixel_at(picture.with.view, picture.world(i))
                    ? 1
                    : 0;
    EXPECT_EQ(behind, 0u) << "pixels show blades behind the mirror";
    // Blades wholly before the mirror are complete.
    std::erase_if(stems, [&](const Stem& stem) {
      return std::ranges::any_of(stem.at, [&](const dvec3& p) { return glm::dot(p, normal) < offset + 0.03; });
    });
    EXPECT_EQ(missed_pixels(picture, stems).missed, 0u);
  }
}

TEST_F(GrassInViews, a_floor_that_mirrors_shows_grass_and_simulates_it_once) {
  GrassStage stage;
  stage.lawn(0.5f, 800, dvec3(0.0, 0.4, 0.0));
  stage.wind(vec3(4.0f, 0.0f, 0.0f), 0.5f);
  stage.run_at(1.0 / 60.0);
  Material mirror;
  mirror.base_color = vec4(1.0f);
  mirror.roughness = 0.0f;
  mirror.metallic = 1.0f;
  mirror.reflectivity = 1.0f;
  stage.scene.draw(stage.scene.mesh(quad(8.0f, stage.scene.material(mirror))), GrassStage::lying(dvec3(0.0)));
  stage.set("reflections.mode", "planar");
  const ViewSettings view = look_at({0.0, 1.0, 2.2}, {0.0, 0.1, 0.0}, 96, 64);
  const ViewId companion = CompanionViews::ids_of(view.id).front();
  stage.draw(view, 3);
  ASSERT_TRUE(stage.has_grass(companion));
  const GrassCopy shown = stage.copy(view.id), mirrored = stage.copy(companion);
  std::set<std::uint32_t> masters = masters_of(stage, shown);
  masters.merge(masters_of(stage, mirrored));
  EXPECT_EQ(shown.dispatch.masters + mirrored.dispatch.masters, masters.size());
  EXPECT_EQ(knot_distance(shown.live_knots(stage.field()), mirrored.live_knots(stage.field())), 0.0);

  GrassStage alone;
  alone.lawn(0.5f, 800, dvec3(0.0, 0.4, 0.0));
  alone.wind(vec3(4.0f, 0.0f, 0.0f), 0.5f);
  alone.run_at(1.0 / 60.0);
  alone.draw(view, 3);
  EXPECT_EQ(knot_distance(shown.live_knots(stage.field()), alone.copy().live_knots(alone.field())), 0.0);

  stage.run_at(0.0);
  stage.draw(view);
  const std::vector<float> with = stage.linear().rgba;
  const GeometryPicture seen = stage.geometry();
  stage.draw(without_grass(view));
  const std::vector<float> bare = stage.linear().rgba;
  std::size_t on_floor = 0;
  for (std::size_t i = 0; i < seen.depth.size(); ++i) {
    if (seen.is_sky(i)) continue;
    const dvec3 point = seen.position(static_cast<std::uint32_t>(i % 96), static_cast<std::uint32_t>(i / 96));
    if (std::abs(point.y + seen.view.position.y) < 1e-3) on_floor += with[4 * i + 1] != bare[4 * i + 1] ? 1 : 0;
  }
  EXPECT_GT(on_floor, 50u) << "pixels of the floor show blades";
}

TEST_F(GrassInViews, static_views_show_no_grass) {
  GrassStage stage;
  stage.lawn(0.6f, 500);
  ViewSettings view = front();
  view.static_only = true;
  view.purpose = ViewPurpose::capture;
  stage.draw(without_grass(view));
  const std::vector<float> bare = stage.linear().rgba;
  stage.draw(view);
  EXPECT_EQ(differences(stage.linear().rgba, bare), 0u);
  EXPECT_FALSE(stage.has_grass());
  view.static_only = false;
  stage.draw(view);
  EXPECT_GT(differences(stage.linear().rgba, bare), 1000u);
}

TEST_F(GrassInViews, views_of_any_size_show_grass) {
  GrassStage stage;
  stage.lawn(0.6f, 400);
  for (const auto& [width, height] : {std::pair{1u, 1u}, {7u, 5u}, {61u, 37u}, {96u, 64u}}) {
    ViewSettings view = front();
    view.width = width;
    view.height = height;
    stage.draw(view);
    for (const float light : stage.linear().rgba) ASSERT_TRUE(std::isfinite(light));
    EXPECT_GT(stage.copy().draws.live, 20u);
  }
}

TEST_F(GrassInViews, reading_an_image_simulates_nothing) {
  GrassStage stage, undisturbed;
  blow(stage);
  blow(undisturbed);
  for (int frame = 0; frame < 4; ++frame) {
    stage.draw(whole());
    undisturbed.draw(whole());
    const LiveKnots knots = stage.copy().live_knots(stage.field());
    EXPECT_TRUE(knots == undisturbed.copy().live_knots(undisturbed.field())) << "frame " << frame;
    const GeometryPicture first = stage.geometry();
    EXPECT_TRUE(stage.copy().live_knots(stage.field()) == knots) << "frame " << frame << " after it was drawn again";
    EXPECT_TRUE(stage.geometry().depth == first.depth) << "frame " << frame;
  }
}

}  // namespace
}  // namespace gloam::test
