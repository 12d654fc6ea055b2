// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/shadowed_scene.h"

namespace gloam {
namespace {

/// A lamp among boxes, with maps of a set size, from frame to frame.
class ShadowFrames : public test::ShadowedScene {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ShadowedScene::SetUp());
    if (IsSkipped()) return;
    left = box(dvec3(-1.0, 0.0, 0.8), dvec3(0.05));
    right = box(dvec3(1.0, 0.0, 0.8), dvec3(0.05));
    made = lamp("lamp", LightKind::point, dvec3(0.0, 0.0, 1.5));
    settings = test::look_at(dvec3(0.4, 0.3, 4.0), dvec3(0.0), 95, 63);
    world.get<ShadowCaster>(made).resolution = 128;
  }
  void move(Entity entity, const dvec3& to) {
    world.get<WorldTransform>(entity).matrix = glm::translate(dmat4(1.0), to);
  }
  [[nodiscard]] double drawn_faces() const { return counter("shadows.faces_drawn") + counter("shadows.faces_skipped"); }
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
  move(left, dvec3(-1.05, 0.2, 0.8));
  const LinearPicture kept = drawn();
  EXPECT_EQ(drawn_faces(), 1.0);
  // An atlas of another size and back: everything is new.
  static_cast<void>(drawn("shadows.atlas", "2048"));
  const LinearPicture anew = drawn("shadows.atlas", "4096");
  EXPECT_EQ(drawn_faces(), 6.0);
  EXPECT_EQ(kept.rgba, anew.rgba);
}

TEST_F(ShadowFrames, a_box_that_moves_draws_the_faces_that_see_it) {
  draw();
  move(right, dvec3(1.05, 0.1, 0.8));
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
                                    {"shadows.casters", "simplified"},
        {"shadows.atlas", "1024"}}) {
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
  EXPECT_TRUE(module_state("shadows").demanded);
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
  const auto bytes = [] {
    for (const gpu::ModuleMemory& memory : test::shared_device()->memory())
      if (memory.module == "shadows") return memory.bytes;
    return std::uint64_t{0};
  };
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

TEST_F(ShadowFrames, the_atlas_view_shows_every_face) {
  settings.visualizer = "shadow_atlas";
  set("shadows.atlas", "1024");
  draw();
  const Picture p = picture();
  // Six faces of 128 texels in 1024 fill an eighth of the picture's height each; orange borders, drawn in this frame.
  int orange = 0;
  for (std::size_t i = 0; i < p.rgba.size(); i += 4)
    orange += p.rgba[i] > 200 && p.rgba[i + 1] < 160 && p.rgba[i + 2] < 50 ? 1 : 0;
  EXPECT_GT(orange, 6 * 4 * 4);
  draw();
  EXPECT_NE(picture().rgba, p.rgba);  // now they are kept ones
}

TEST_F(ShadowFrames, a_view_of_a_light_that_is_not_in_view_shows_the_picture_as_it_is) {
  const Entity far = lamp("far", LightKind::point, dvec3(0.0, 0.0, 100.0));
  static_cast<void>(far);
  settings.visualizer = "shadow:far";
  draw();
  const Picture p = picture();
  settings.visualizer = "none";
  draw();
  EXPECT_EQ(picture().rgba, p.rgba);
  EXPECT_EQ(warnings.size(), 1u);
}

}  // namespace
}  // namespace gloam
