// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/modules/shadows/support/reuse_twins.h"

// shadows.reuse=exact and lighting.reuse=exact: pictures equal those of a renderer that keeps nothing, to the bit.

namespace gloam {
namespace {

using test::Twin;
using VisibilityReuse = test::ReuseTwins;

TEST_F(VisibilityReuse, at_rest_everything_is_kept_and_only_what_changes_is_made_anew) {
  rest();
  const double all = counted_anew("shadows.tile_lights");
  // A flame flickers: its shadows stay.
  change_lamp(0, [](Light& l) { l.intensity *= 0.7f, l.color = vec3(1.0f, 0.8f, 0.5f); });
  draw_both("flicker");
  EXPECT_EQ(kept(), all);
  // A lamp moves: those of the others stay.
  move_lamp(2, dvec3(0.02, 0.0, 0.01));
  draw_both("lamp");
  EXPECT_GT(kept(), 0.3 * all);
  EXPECT_LT(kept(), all);
  rest();
  // What only the spot sees moves there and back.
  change_lamp(0, [](Light& l) { l.intensity = 0.0f; });
  draw_both("a lamp goes out");
  rest();
  move_thing(2, dvec3(0.0, 0.05, 0.0));
  draw_both("caster");
  EXPECT_LT(kept(), counted_anew("shadows.tile_lights"));
  move_thing(2, dvec3(0.0, -0.05, 0.0));
  draw_both("caster back");
  rest();
}

TEST_F(VisibilityReuse, pixels_that_change_are_made_anew_though_no_light_sees_it) {
  // A pane above the floor that casts nothing: its depth, its normals and its material change, one at a time.
  std::vector<std::uint32_t> meshes;
  each([&](Twin& twin) {
    test::SceneMaker maker(*twin.world);
    Material waxen = exact_material(180, 170, 160, 255, 0);
    waxen.subsurface = true;
    const std::uint32_t plain = maker.material(exact_material(180, 170, 160, 255, 0)), wax = maker.material(waxen);
    Primitive smooth = test::quad(0.7f, plain);
    for (vec3& normal : smooth.normals) normal = glm::normalize(normal + vec3(0.4f, 0.0f, 0.0f));
    meshes = {maker.mesh(test::quad(0.7f, plain)), maker.mesh(smooth), maker.mesh(test::quad(0.7f, wax))};
    const Entity pane = twin.things.emplace_back(maker.draw(meshes[0], flat(0.05)));
    twin.world->get<MeshInstance>(pane).casts_shadows = false;
  });
  const std::size_t pane = 4;
  const auto show = [&](std::size_t mesh) {
    each([&](Twin& twin) {
      twin.world->get<MeshInstance>(twin.things[pane]).mesh = meshes[mesh];
      twin.world->mark_changed<MeshInstance>(twin.things[pane]);
    });
  };
  rest();
  const double all = counted_anew("shadows.tile_lights");
  const auto expect_some_anew = [&](const std::string& what) {
    draw_both(what);
    EXPECT_LT(kept(), all) << what;
    EXPECT_GT(kept(), 0.1 * all) << what;
    rest();
  };
  move_thing(pane, dvec3(0.0, 0.004, 0.0));
  expect_some_anew("depth");
  show(1);
  expect_some_anew("shading normal");
  show(0);
  expect_some_anew("shading normal, back");
  show(2);
  expect_some_anew("material");
  move_thing(pane, dvec3(0.3, 0.0, 0.0));
  expect_some_anew("edge");
}

TEST_F(VisibilityReuse, light_that_changes_is_computed_anew_where_shadows_are_kept) {
  std::vector<std::uint32_t> meshes;
  each([&](Twin& twin) {
    test::SceneMaker maker(*twin.world);
    Material shining = exact_material(180, 170, 160, 255, 0);
    shining.emissive = vec3(3.0f, 1.0f, 0.2f);
    meshes.clear();
    for (const Material& material : {exact_material(180, 170, 160, 255, 0), exact_material(90, 170, 160, 255, 0),
                                     shining, exact_material(180, 170, 160, 255, 200)})
      meshes.push_back(maker.mesh(test::quad(0.25f, maker.material(material))));
    const Entity pane = twin.things.emplace_back(maker.draw(meshes[0], flat(0.05)));
    twin.world->get<MeshInstance>(pane).casts_shadows = false;
    twin.lamps.push_back(
        twin.world->create(point(0.05f), WorldTransform{at(-0.4, 0.5, 0.6)}, ShadowCaster{false, 128}));
  });
  for (int i = 0; i < 4; ++i) draw_both("at rest");
  const double tiles = lit_kept();  // those that show a surface
  EXPECT_GT(tiles, 40.0);
  const auto expect_some_anew = [&](const std::string& what) {
    draw_both(what);
    EXPECT_EQ(kept(), counted_anew("shadows.tile_lights") - counted_anew("shadows.tile_lights_unshadowed")) << what;
    EXPECT_LT(lit_kept(), tiles) << what;
    EXPECT_GT(lit_kept(), 0.0) << what;
    draw_both(what + ", at rest");
    EXPECT_EQ(lit_kept(), tiles) << what;
  };
  for (const std::size_t mesh : {1u, 2u, 3u, 0u}) {
    each([&](Twin& twin) {
      twin.world->get<MeshInstance>(twin.things[4]).mesh = meshes[mesh];
      twin.world->mark_changed<MeshInstance>(twin.things[4]);
    });
    expect_some_anew("material " + std::to_string(mesh));
  }
  change_lamp(4, [](Light& l) { l.range_m = 0.7f; });
  draw_both("a lamp without shadows");
  draw_both("at rest");
  change_lamp(4, [](Light& l) { l.color = vec3(1.0f, 0.2f, 0.1f); });
  expect_some_anew("colour of a lamp without shadows");
  change_lamp(4, [](Light& l) { l.width_m = 0.3f; });
  expect_some_anew("width of a lamp without shadows");
  each([](Twin& twin) { twin.world->resource<SceneEnvironment>().sky_zenith = vec3(0.3f, 0.1f, 0.2f); });
  draw_both("sky");
  EXPECT_EQ(lit_kept(), 0.0);
  draw_both("sky, at rest");
  draw_both("sky, at rest");
  EXPECT_EQ(lit_kept(), tiles);
}

TEST_F(VisibilityReuse, a_camera_that_moves_keeps_nothing_and_costs_no_keys) {
  rest();
  for (int i = 0; i < 3; ++i) {
    settings.world_from_camera = at(0.01, 0.0, 0.0) * settings.world_from_camera;
    draw_both("moving");
    EXPECT_EQ(kept(), 0.0);
  }
  rest();
  settings.camera_cut = true;
  settings.world_from_camera = at(0.5, 0.0, 0.0) * settings.world_from_camera;
  draw_both("cut");
  EXPECT_EQ(kept(), 0.0);
  settings.camera_cut = false;
  rest();
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 1.5f;
  draw_both("orthographic");
  EXPECT_EQ(kept(), 0.0);
  rest();
  settings.width = 61;
  settings.height = 43;
  draw_both("resized");
  rest();
}

TEST_F(VisibilityReuse, frames_that_are_given_up_and_read_again_change_nothing) {
  rest();
  move_thing(1, dvec3(0.1, 0.0, 0.0));
  give_up();
  draw_both("after a frame that was given up");
  give_up();
  move_lamp(0, dvec3(0.1, 0.0, 0.0));
  give_up();
  draw_both("after more");
  each([&](Twin& twin) {
    EXPECT_TRUE(
        twin.renderer->read_images(*twin.world, settings.id, std::vector<std::string_view>{"shadow_pyramid"}).ok());
  });
  draw_both("read again");
  rest();
}

TEST_F(VisibilityReuse, knobs_of_the_filter_void_what_was_kept) {
  for (const auto& [knob, value] : {std::pair{"shadows.visibility_bits", "4"},
                                    {"shadows.bias_mm", "4"},
                                    {"shadows.slot_limit", "40"},
                                    {"shadows.slot_limit", "4194301"},
                                    {"shadows.mode", "off"},
                                    {"shadows.mode", "deferred"}}) {
    for (int i = 0; i < 3; ++i) draw_both("before " + std::string(knob));
    both(knob, value);
    has_lists_ = std::string_view(value) != "off";
    draw_both(std::string(knob) + "=" + value);
    if (std::string_view(knob) != "shadows.mode") {
      EXPECT_EQ(kept(), 0.0) << knob;
    }
    draw_both(std::string(knob) + "=" + value + ", again");
  }
}

/// What was kept over a run of frames.
struct KeptInRun {
  double lights = 0.0;
  int partly = 0;  ///< frames that keep some visibilities and make others
};

class RandomVisibilityReuse : public VisibilityReuse {
 protected:
  /// Changes things, lamps, the camera and knobs at random, draws both after each change.
  KeptInRun run(int changes) {
    std::mt19937 random(7);
    const auto some = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
    KeptInRun found;
    for (int i = 0; i < changes; ++i) {
      const dvec3 by(some(0.1), some(0.03), some(0.1));
      switch (const unsigned what = random() % 16; what) {
        case 0:
        case 1:
          move_thing(1 + random() % 3, by);
          break;
        case 2:
          move_lamp(random() % 4, by);
          break;
        case 3: {
          const auto factor = static_cast<float>(1.0 + some(0.5));
          const std::size_t lamp = random() % 4;
          change_lamp(lamp, [&](Light& l) { l.intensity *= factor; });
          break;
        }
        case 4: {
          const std::size_t lamp = random() % 3;
          change_lamp(lamp, [&](Light& l) { l.width_m = l.width_m > 0.05f ? 0.03f : 0.12f; });
          break;
        }
        case 5:
          settings.world_from_camera = glm::translate(dmat4(1.0), by) * settings.world_from_camera;
          break;
        case 6:
          give_up();
          break;
        case 7:
          if (random() % 4 == 0) both("shadows.filter", random() % 2 == 0 ? "pcss" : "chs");
          break;
        case 8: {
          const std::size_t lamp = random() % 3;
          change_lamp(lamp, [&](Light& l) { l.range_m = l.range_m > 2.0f ? 1.5f : 6.0f; });
          break;
        }
        default:
          break;
      }
      draw_both("change " + std::to_string(i));
      if (HasFailure()) break;
      found.lights += kept();
      if (kept() > 0.0 && filtered() > 0.0) ++found.partly;
    }
    return found;
  }
};

TEST_F(RandomVisibilityReuse, two_hundred_random_changes) {
  const KeptInRun found = run(200);
  EXPECT_GT(found.lights, 1000.0);
  EXPECT_GE(found.partly, 10);
}

// Which lights are dim depends on all lights of a tile and on its materials.
TEST_F(RandomVisibilityReuse, random_changes_with_dim_lights) {
  both("shadows.min_contribution", "0.015");
  each([](Twin& twin) { twin.world->resource<SceneEnvironment>().exposure_ev100 = 4.5f; });
  change_lamp(1, [](Light& l) { l.intensity *= 0.3f; });
  draw_both("first");
  EXPECT_GT(counted_anew("shadows.tile_lights_dim"), 5.0);
  for (int i = 0; i < 4; ++i) draw_both("at rest");
  EXPECT_GT(kept(), 0.0);
  change_lamp(0, [](Light& l) { l.intensity *= 0.8f; });
  draw_both("another brightness");
  each([](Twin& twin) { twin.world->resource<SceneEnvironment>().exposure_ev100 = 4.0f; });
  draw_both("exposure");
  for (int i = 0; i < 3; ++i) draw_both("at rest");
  each([](Twin& twin) {
    SceneAssets& assets = twin.world->resource<SceneAssets>();
    for (Material& material : assets.materials) material.base_color = vec4(0.05f, 0.05f, 0.05f, 1.0f);
    ++assets.version;
  });
  draw_both("material");
  draw_both("material, again");
  change_lamp(0, [](Light& l) { l.width_m = 0.3f; });
  draw_both("width");
  const KeptInRun found = run(60);
  EXPECT_GT(found.lights, 300.0);
  EXPECT_GT(found.partly, 0);
}

}  // namespace
}  // namespace gloam
