// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/enclosed_lights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/scene/gltf/import.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A lamp of 20 cm and a closed box around it.
class EnclosedLights : public ::testing::Test {
 protected:
  EnclosedLights() {
    prepare_scene_world(world_);
    world_.register_component<Light>();
    world_.register_component<ShadowCaster>();
    lamp_ = world_.create(Light{.kind = LightKind::point, .intensity = 1.0f, .range_m = 5.0f, .width_m = 0.2f},
                          WorldTransform{place_});
    world_.resource<SceneNames>().add("light", "lamp", lamp_);
  }
  Entity enclose(float half_m, const Material& material, const dvec3& shift = dvec3(0.0)) {
    const Entity entity = maker_.draw(maker_.mesh(test::box(vec3(half_m), maker_.material(material))),
                                      glm::rotate(glm::translate(place_, shift), 0.4, dvec3(0.0, 1.0, 0.0)));
    world_.resource<SceneNames>().add("mesh", "shell", entity);
    return entity;
  }
  const dmat4 place_ = glm::translate(dmat4(1.0), dvec3(3.0, 2.0, -70.0));
  World world_;
  test::SceneMaker maker_{world_};
  Entity lamp_;
};

// Hard case: further.light_inside_geometry
TEST_F(EnclosedLights, are_named_with_the_mesh) {
  enclose(0.1f, {});
  EXPECT_THAT(enclosed_lights(world_), ElementsAre("light \"lamp\" lies inside mesh \"shell\", which casts"));
}

TEST_F(EnclosedLights, are_not_those_outside) {
  enclose(0.1f, {}, dvec3(0.125, 0.0, 0.125));
  EXPECT_THAT(enclosed_lights(world_), IsEmpty());
}

TEST_F(EnclosedLights, are_not_those_in_their_bulbs_or_behind_glass) {
  Material shining, glass;
  shining.emissive = vec3(0.0f, 2.0f, 0.0f);
  glass.alpha_mode = AlphaMode::blend;
  enclose(0.1f, shining);
  enclose(0.15f, glass);
  EXPECT_THAT(enclosed_lights(world_), IsEmpty());
  enclose(0.6f, shining);
  EXPECT_EQ(enclosed_lights(world_).size(), 1u) << "too large for a bulb";
}

TEST_F(EnclosedLights, are_not_those_without_shadows_or_in_meshes_without) {
  world_.get<MeshInstance>(enclose(0.1f, {})).casts_shadows = false;
  EXPECT_THAT(enclosed_lights(world_), IsEmpty());
  enclose(0.1f, {});
  world_.add(lamp_, ShadowCaster{false, 0});
  EXPECT_THAT(enclosed_lights(world_), IsEmpty());
}

}  // namespace
}  // namespace gloam
