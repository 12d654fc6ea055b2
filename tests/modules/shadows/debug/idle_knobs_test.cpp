// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/idle_knobs.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/scene/gltf/import.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

/// A lamp of 20 cm, far from the origin, and boxes of 2 cm.
class IdleShadowKnobs : public ::testing::Test {
 protected:
  IdleShadowKnobs() {
    prepare_scene_world(world_);
    world_.register_component<Light>();
    world_.register_component<ShadowCaster>();
    world_.register_component<CasterVolume>();
    lamp_ = world_.create(Light{.kind = LightKind::point, .intensity = 1.0f, .range_m = 5.0f, .width_m = 0.2f},
                          WorldTransform{place_});
  }
  /// A box whose nearest point is this far from the lamp's middle along a direction.
  Entity add_box(const dvec3& shift, const dmat4& shape = dmat4(1.0)) {
    return maker_.draw(maker_.mesh(test::box(vec3(0.01f), maker_.material({}))), glm::translate(place_, shift) * shape);
  }
  [[nodiscard]] std::string reason(std::string_view knob, const FrameCounters& counters = {}) const {
    return idle_shadow_knob(world_, knob, counters);
  }
  const dmat4 place_ = glm::translate(dmat4(1.0), dvec3(1e6, 2.0, -70.0));
  World world_;
  test::SceneMaker maker_{world_};
  Entity lamp_;
};

TEST_F(IdleShadowKnobs, a_lamp_without_near_blockers_says_so) {
  EXPECT_EQ(reason("shadows.near"), "no lamp has a near blocker") << "nothing casts";
  const Entity far = add_box(dvec3(0.7, 0.0, 0.0));
  EXPECT_EQ(reason("shadows.near"), "no lamp has a near blocker");
  EXPECT_EQ(reason("shadows.near_directions"), "no lamp has a near blocker");
  EXPECT_EQ(reason("shadows.mips"), "") << "it is about near blockers only";
  // 0.1 m / 0.3 is 33 cm of depth: in the corner of a face up to 58 cm away.
  add_box(dvec3(0.32));
  EXPECT_EQ(reason("shadows.near"), "");
  EXPECT_EQ(reason("shadows.near_directions"), "");
  world_.destroy(far);
  EXPECT_TRUE(has_near_blocker(world_));
}

TEST_F(IdleShadowKnobs, large_turned_and_stretched_meshes_count_where_their_box_ends) {
  const dmat4 turned = glm::rotate(dmat4(1.0), 0.7, glm::normalize(dvec3(1.0, 2.0, -1.0)));
  add_box(dvec3(0.0, -40.0, 0.0), turned * glm::scale(dmat4(1.0), dvec3(0.5)));
  EXPECT_FALSE(has_near_blocker(world_));
  add_box(dvec3(0.0, -40.0, 0.0), glm::scale(dmat4(1.0), dvec3(1.0, 3960.0, 1.0)));  // up to 40 cm below the lamp
  EXPECT_TRUE(has_near_blocker(world_));
}

TEST_F(IdleShadowKnobs, what_casts_nothing_is_no_blocker) {
  const Entity box = add_box(dvec3(0.2, 0.0, 0.0));
  EXPECT_TRUE(has_near_blocker(world_));
  world_.get<MeshInstance>(box).casts_shadows = false;
  EXPECT_FALSE(has_near_blocker(world_));
  world_.get<MeshInstance>(box).casts_shadows = true;
  world_.get<Light>(lamp_).width_m = 0.0f;
  EXPECT_FALSE(has_near_blocker(world_));
  EXPECT_EQ(reason("shadows.near"), "no light that casts shadows has a width");
  world_.get<Light>(lamp_).width_m = 0.2f;
  world_.add(lamp_, ShadowCaster{false, 0});
  EXPECT_FALSE(has_near_blocker(world_));
}

TEST_F(IdleShadowKnobs, a_place_that_is_no_number_may_be_near) {
  add_box(dvec3(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(has_near_blocker(world_));
}

TEST_F(IdleShadowKnobs, a_sun_has_a_width_but_no_near_blocker) {
  world_.get<Light>(lamp_) = Light{.kind = LightKind::directional};
  add_box(dvec3(0.0));
  EXPECT_EQ(reason("shadows.mips"), "");
  EXPECT_EQ(reason("shadows.near"), "no lamp has a near blocker");
}

TEST_F(IdleShadowKnobs, counters_of_tiles_tell_whether_anything_is_filtered) {
  const auto counted = [](double all, double filtered) {
    return FrameCounters{{"shadows.tile_lights", all}, {"shadows.tile_lights_filtered", filtered}};
  };
  EXPECT_EQ(reason("shadows.kernel", counted(4, 1)), "");
  EXPECT_EQ(reason("shadows.kernel", counted(4, 0)), "each light lights all of a tile in view or nothing of it");
  EXPECT_EQ(reason("shadows.kernel", counted(0, 0)), "no surface in view is in reach of a light that casts shadows");
  EXPECT_EQ(reason("shadows.kernel"), "");
  FrameCounters kept = counted(4, 0);
  kept["shadows.tile_lights_kept"] = 3;
  EXPECT_EQ(reason("shadows.kernel", kept), "") << "they may have been filtered";
}

TEST_F(IdleShadowKnobs, without_a_translucent_material_bodies_do_not_matter) {
  EXPECT_EQ(reason("shadows.subsurface"), "no material lets light through");
  Material wax;
  wax.subsurface = true;
  maker_.material(wax);
  EXPECT_EQ(reason("shadows.subsurface"), "");
}

}  // namespace
}  // namespace gloam
