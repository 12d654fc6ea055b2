// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "modules/shadows/filter/cookies.h"
#include "modules/shadows/filter/traced_visibility.h"
#include "tests/modules/shadows/support/shadowed_scene.h"

namespace gloam {
namespace {

/// A lamp among boxes, with maps of a fixed size, over several frames.
class ShadowFrames : public test::ShadowedScene {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ShadowedScene::SetUp());
    if (IsSkipped()) return;
    left = box(dvec3(-0.3, 0.0, 0.8), dvec3(0.05));
    right = box(dvec3(0.2, 0.3, 0.8), dvec3(0.05));
    made = lamp("lamp", LightKind::point, dvec3(0.0, 0.0, 1.5));
    settings = test::look_at(dvec3(0.4, 0.3, 4.0), dvec3(0.0), 95, 63);
    world.get<ShadowCaster>(made).resolution = 128;
  }
  void move(Entity entity, const dvec3& to) {
    world.get<WorldTransform>(entity).matrix = glm::translate(dmat4(1.0), to);
  }
  [[nodiscard]] double drawn_faces() const { return counter("shadows.faces_drawn") + counter("shadows.faces_skipped"); }
  [[nodiscard]] static std::uint64_t bytes() {
    for (const gpu::ModuleMemory& memory : test::shared_device()->memory())
      if (memory.module == "shadows") return memory.bytes;
    return 0;
  }
  /// Adds a spot with a cookie in view.
  Entity projector() {
    const Entity spot = lamp("spot", LightKind::spot, dvec3(0.3, 0.2, 2.0));
    world.get<ShadowCaster>(spot).resolution = 128;
    Cookies cookies;
    world.get<Light>(spot).cookie = world.resource<SceneStrings>().intern("quarters.png");
    cookies.layers[world.get<Light>(spot).cookie] = 0;
    cookies.texels.push_back(resampled_cookie(
        Image{"quarters", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}}));
    cookies.version = 1;
    world.set_resource(std::move(cookies));
    return spot;
  }
  /// Traced visibility 0.5 of the lamp at every pixel.
  [[nodiscard]] TracedVisibility half_shadow() const {
    TracedVisibility traced;
    traced.width = settings.width;
    traced.height = settings.height;
    traced.lights = {made};
    traced.visibility.assign(traced.pixels(), 128);
    traced.judged.assign((traced.pixels() + 7) / 8, 0xFF);
    return traced;
  }
  Entity left, right, made;
};

TEST_F(ShadowFrames, nothing_is_drawn_again_while_nothing_moves) {
  const LinearPicture first = drawn();
  EXPECT_EQ(drawn_faces(), 6.0);
  EXPECT_EQ(counter("shadows.faces_cached"), 0.0);
  EXPECT_EQ(counter("shadows.casting_lights"), 1.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(drawn().rgba, first.rgba);
    EXPECT_EQ(drawn_faces(), 0.0);
    EXPECT_EQ(counter("shadows.faces_cached"), 6.0);
  }
}

TEST_F(ShadowFrames, a_camera_that_moves_draws_no_map_of_a_local_light) {
  draw();
  for (int i = 1; i < 8; ++i) {
    settings = test::look_at(dvec3(0.1 * i, 0.3, 4.0 - 0.2 * i), dvec3(0.05 * i, 0.0, 0.0), 95, 63);
    draw();
    EXPECT_EQ(drawn_faces(), 0.0) << i;
  }
}

TEST_F(ShadowFrames, kept_maps_equal_maps_drawn_anew) {
  draw();
  settings = test::look_at(dvec3(-0.5, 0.6, 3.5), dvec3(0.2, 0.0, 0.0), 95, 63);
  move(left, dvec3(-0.35, 0.2, 0.8));
  const LinearPicture kept = drawn();
  EXPECT_EQ(drawn_faces(), 1.0);
  // Changing the atlas' format and back discards all maps.
  static_cast<void>(drawn("shadows.depth", "d16"));
  const LinearPicture redrawn = drawn("shadows.depth", "d32");
  EXPECT_EQ(drawn_faces(), 6.0);
  EXPECT_EQ(kept.rgba, redrawn.rgba);
}

TEST_F(ShadowFrames, frames_that_are_given_up_leave_the_maps_as_they_were) {
  ViewRequest lost{settings, {}};
  lost.target.overlay = [](FrameGraph&, ImageRef&) -> Status { return Error{ErrorKind::failed, "given up"}; };
  const auto give_up = [&] { EXPECT_FALSE(renderer->render(world, std::span(&lost, 1)).ok()); };
  give_up();
  draw();
  EXPECT_EQ(drawn_faces(), 6.0) << "there were no maps before";
  move(right, dvec3(0.25, 0.35, 0.8));
  give_up();
  draw();
  EXPECT_EQ(drawn_faces(), 1.0);
  move(right, dvec3(0.2, 0.3, 0.8));
  give_up();
  move(right, dvec3(0.25, 0.35, 0.8));
  draw();
  EXPECT_EQ(drawn_faces(), 0.0) << "the box is back where the maps show it";
  for (const auto& [knob, other, back] :
       {std::tuple{"shadows.depth", "d16", "d32"}, {"shadows.bias_units", "4000", "2000"}}) {
    set(knob, back);
    draw();
    set(knob, other);
    give_up();
    set(knob, back);
    draw();
    EXPECT_EQ(drawn_faces(), 0.0) << knob;
  }
}

TEST_F(ShadowFrames, maps_kept_over_frames_that_are_given_up_equal_maps_drawn_anew) {
  ViewRequest lost{settings, {}};
  lost.target.overlay = [](FrameGraph&, ImageRef&) -> Status { return Error{ErrorKind::failed, "given up"}; };
  for (int i = 0; i < 24; ++i) {
    // After 16 frames the other casters rest and have backgrounds.
    move(right, dvec3(0.2 - 0.01 * i, 0.3, 0.8));
    if (i % 3 == 0) {
      EXPECT_FALSE(renderer->render(world, std::span(&lost, 1)).ok());
    }
    if (i % 5 == 0) move(right, dvec3(0.2, 0.3 + 0.01 * i, 0.8));
    draw();
    EXPECT_GE(drawn_faces(), 1.0);
    EXPECT_LE(drawn_faces(), i == 0 ? 6.0 : 2.0);
  }
  const LinearPicture kept = drawn();
  EXPECT_EQ(drawn_faces(), 0.0);
  static_cast<void>(drawn("shadows.depth", "d16"));
  EXPECT_EQ(kept.rgba, drawn("shadows.depth", "d32").rgba);
  EXPECT_EQ(drawn_faces(), 6.0);
}

TEST_F(ShadowFrames, a_map_drawn_without_planes_is_classified_right_when_its_light_comes_back) {
  set("shadows.visibility_bits", "8");
  const Entity other = lamp("other", LightKind::point, dvec3(0.0, 0.0, 1.5));
  world.get<ShadowCaster>(other).resolution = 128;
  world.get<Light>(made).range_m = 1.8f;
  move(right, dvec3(3.0, 3.0, 0.8));
  for (int i = 0; i < 3; ++i) draw();  // counters are two frames late
  ASSERT_GT(counter("shadows.classified_share"), 0.0);
  set("shadows.mode", "monolithic");
  move(right, dvec3(0.2, 0.3, 0.8));
  draw();
  EXPECT_EQ(drawn_faces(), 3.0) << "without planes";
  for (int i = 0; i < 20; ++i) draw();  // until the box counts as resting
  set("shadows.mode", "deferred");
  const auto here = settings;
  settings = test::look_at(dvec3(3.4, 0.3, 1.0), dvec3(3.4, 0.0, 0.0), 95, 63);
  draw();
  EXPECT_EQ(counter("shadows.casting_lights"), 1.0) << "the other lamp alone, with planes";
  settings = here;
  const LinearPicture classified = drawn();
  EXPECT_EQ(drawn_faces(), 0.0);
  EXPECT_EQ(classified.rgba, drawn("shadows.classify", "off").rgba);
}

TEST_F(ShadowFrames, a_box_that_moves_draws_the_faces_that_see_it) {
  draw();
  move(right, dvec3(0.25, 0.35, 0.8));
  draw();
  EXPECT_EQ(drawn_faces(), 1.0);
  EXPECT_EQ(counter("shadows.faces_cached"), 5.0);
}

TEST_F(ShadowFrames, a_light_that_moves_draws_all_its_faces) {
  draw();
  move(made, dvec3(0.0, 0.2, 1.5));
  draw();
  EXPECT_EQ(drawn_faces(), 6.0);
}

TEST_F(ShadowFrames, knobs_that_change_maps_draw_them_anew) {
  draw();
  for (const auto& [knob, value] : {std::pair{"shadows.bias", "hardware"},
                                    {"shadows.bias_units", "4000"},
                                    {"shadows.mip_operator", "average"},
                                    {"shadows.depth", "d16"},
                                    {"shadows.casters", "simplified"}}) {
    set(knob, value);
    draw();
    EXPECT_EQ(drawn_faces(), 6.0) << knob;
    draw();
    EXPECT_EQ(drawn_faces(), 0.0) << knob;
  }
  set("shadows.filter", "hard");
  draw();
  EXPECT_EQ(drawn_faces(), 0.0);
}

TEST_F(ShadowFrames, a_light_that_casts_no_shadow_is_as_lights_without_shadows) {
  const LinearPicture with = drawn(), off = drawn("shadows.mode", "off");
  EXPECT_NE(with.rgba, off.rgba);
  EXPECT_FALSE(module_state("shadows").demanded) << "switched off by its knob";
  set("shadows.mode", "monolithic");
  world.get<ShadowCaster>(made).enabled = false;
  EXPECT_EQ(drawn().rgba, off.rgba);
  EXPECT_FALSE(module_state("shadows").demanded);
  EXPECT_EQ(module_state("shadows").reason, "no light casts shadows");
}

TEST_F(ShadowFrames, two_worlds_share_nothing) {
  World other;
  renderer->prepare_world(other);
  test::SceneMaker maker(other);
  other.resource<SceneEnvironment>().has_exposure = true;
  const std::uint32_t material = maker.material(exact_material(180, 170, 160, 255, 0));
  maker.draw(maker.mesh(test::quad(4.0f, material)));
  Light light;
  light.intensity = 8.0f;
  light.range_m = 12.0f;
  other.create(light, WorldTransform{glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 1.0))}, ShadowCaster{true, 128});
  const LinearPicture mine = drawn();
  draw(other, settings);
  const LinearPicture theirs = linear();
  EXPECT_NE(mine.rgba, theirs.rgba);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(drawn().rgba, mine.rgba);
    EXPECT_EQ(drawn_faces(), 0.0);
    draw(other, settings);
    EXPECT_EQ(linear().rgba, theirs.rgba);
    EXPECT_EQ(drawn_faces(), 0.0);
  }
}

TEST_F(ShadowFrames, memory_goes_back_when_nothing_casts_shadows_for_long) {
  settings.width = settings.height = 8;
  const LinearPicture before = drawn();
  EXPECT_GT(bytes(), 0u);
  world.get<ShadowCaster>(made).enabled = false;
  for (int i = 0; i < 130; ++i) draw();
  renderer->free_idle_memory();
  draw();
  draw();
  EXPECT_EQ(bytes(), 0u);
  world.get<ShadowCaster>(made).enabled = true;
  EXPECT_EQ(drawn().rgba, before.rgba);
  EXPECT_EQ(drawn_faces(), 6.0);
}

TEST_F(ShadowFrames, counters_of_frames_without_maps_are_zero) {
  projector();  // demands the module with any knobs
  draw();
  EXPECT_EQ(drawn_faces(), 7.0);
  set("shadows.mode", "off");
  draw();
  EXPECT_TRUE(module_state("shadows").demanded);
  EXPECT_EQ(drawn_faces() + counter("shadows.faces_cached"), 0.0);
  set("shadows.mode", "monolithic");
  draw();
  EXPECT_EQ(drawn_faces(), 0.0);
  EXPECT_EQ(counter("shadows.faces_cached"), 7.0);
  world.set_resource(half_shadow());
  draw();
  EXPECT_EQ(drawn_faces() + counter("shadows.faces_cached"), 0.0);
  world.remove_resource<TracedVisibility>();
}

TEST_F(ShadowFrames, plans_are_met_again_whatever_faces_are_drawn) {
  const Entity small = lamp("small", LightKind::spot, dvec3(0.6, 0.5, 1.2)),
               large = lamp("large", LightKind::spot, dvec3(-0.6, 0.5, 1.2));
  world.get<ShadowCaster>(small).resolution = 32;
  world.get<ShadowCaster>(large).resolution = 512;
  const Entity lamps[] = {small, large, made};
  draw();
  move(left, dvec3(-0.3, 0.01, 0.8));
  draw();  // from here on the view has backgrounds, which its plans declare in every frame
  draw();
  const std::uint64_t before = renderer->report().plans_compiled;
  std::set<double> drawn_counts;
  for (int frame = 0; frame < 14; ++frame) {
    for (int i = 0; i < 3; ++i)
      if (((frame + 1) >> i & 1) != 0) world.get<WorldTransform>(lamps[i]).matrix[3] += dvec4(0.01, 0.0, 0.0, 0.0);
    if (frame > 7) move(left, dvec3(-1.0, 0.01 * frame, 0.8));
    draw();
    drawn_counts.insert(drawn_faces());
  }
  EXPECT_GE(drawn_counts.size(), 5u);
  EXPECT_LE(renderer->report().plans_compiled - before, 6u)
      << "one, two or four batches, with and without light uploads";
}

TEST_F(ShadowFrames, what_rays_found_leaves_no_memory_behind) {
  draw();
  renderer->free_idle_memory();
  draw();
  draw();
  const std::uint64_t before = bytes();
  world.set_resource(half_shadow());
  draw();
  EXPECT_GE(bytes(), before + 2 * 95 * 63) << "the image and what it is copied from";
  draw();
  world.remove_resource<TracedVisibility>();
  for (int i = 0; i < 3; ++i) draw();
  renderer->free_idle_memory();
  draw();
  draw();
  EXPECT_EQ(bytes(), before);
}

TEST_F(ShadowFrames, two_views_of_a_frame_are_as_each_alone) {
  projector();
  ViewRequest views[] = {{settings, {}}, {test::look_at(dvec3(-0.8, 0.5, 3.0), dvec3(0.2, 0.0, 0.0), 70, 81), {}}};
  views[1].settings.id = ViewId{1};
  for (int frame = 0; frame < 2; ++frame) {
    const Status drawn = renderer->render(world, views);
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    ASSERT_TRUE(renderer->wait().ok());
  }
  const LinearPicture together[] = {linear(0), linear(1)};
  for (std::uint32_t i = 0; i < 2; ++i) {
    draw(world, views[i].settings);
    EXPECT_EQ(linear(i).rgba, together[i].rgba) << "with kept maps";
    set("shadows.depth", "d16");
    draw(world, views[i].settings);
    set("shadows.depth", "d32");
    draw(world, views[i].settings);
    EXPECT_EQ(drawn_faces(), 7.0);
    EXPECT_EQ(linear(i).rgba, together[i].rgba) << "with new maps";
  }
  set("shadows.mode", "off");
  draw();
  EXPECT_NE(linear(0).rgba, together[0].rgba);
}

TEST_F(ShadowFrames, the_atlas_view_shows_every_face) {
  settings.visualizer = "shadow_atlas";
  draw();
  const Picture p = picture();
  // Six faces of 128 texels in an atlas of 512: each is a quarter of the picture's height. Orange borders: drawn in
  // this frame.
  int orange = 0;
  for (std::size_t i = 0; i < p.rgba.size(); i += 4)
    orange += p.rgba[i] > 200 && p.rgba[i + 1] < 160 && p.rgba[i + 2] < 50 ? 1 : 0;
  EXPECT_GT(orange, 6 * 4 * 4);
  draw();
  EXPECT_NE(picture().rgba, p.rgba);  // now the faces are cached
}

TEST_F(ShadowFrames, a_view_of_a_light_that_is_not_in_view_shows_the_picture_as_it_is) {
  const Entity far = lamp("far", LightKind::point, dvec3(0.0, 0.0, 100.0));
  static_cast<void>(far);
  settings.visualizer = "shadow:far";
  draw();
  const Picture p = picture();
  draw();
  EXPECT_EQ(warnings.size(), 1u) << "one warning, not one a frame";
  settings.visualizer = "none";
  draw();
  EXPECT_EQ(picture().rgba, p.rgba);
  EXPECT_EQ(warnings.size(), 1u);
}

}  // namespace
}  // namespace gloam
