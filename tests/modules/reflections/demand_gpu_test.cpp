// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "modules/reflections/captures.h"
#include "modules/reflections/components.h"
#include "tests/support/module_demand.h"

namespace gloam {
namespace {

/// A floor whose material may reflect.
class ReflectionDemand : public test::ModuleDemand {
 protected:
  ReflectionDemand() : ModuleDemand("reflections") {
    request.settings = test::look_at(dvec3(0.0, 1.5, 4.0), dvec3(0.0), 64, 48);
  }
  Entity floor(float reflectivity, float roughness, const dvec3& at = dvec3(0.0)) {
    Material material;
    material.reflectivity = reflectivity;
    material.roughness = roughness;
    material.metallic = 0.0f;
    const dmat4 flat = glm::rotate(glm::translate(dmat4(1.0), at), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
    return scene->draw(scene->mesh(test::quad(3.0f, scene->material(material))), flat);
  }
  void proxy_and_probe() {
    IbrProxy proxy;
    proxy.size_m = vec2(2.0f);
    CubeProbe probe;
    probe.size_m = vec3(9.0f);
    ReflectionCaptures captures;
    captures.proxy_entities = {world.create(proxy, WorldTransform{glm::translate(dmat4(1.0), dvec3(0.0, 1.0, -2.0))})};
    captures.probe_entities = {world.create(probe, WorldTransform{})};
    captures.proxies = {8, 4, 1, std::vector<std::uint16_t>(4 * (64 + 16 + 4 + 1))};
    captures.probes = captures.proxies;
    captures.content = captures.version = 1;
    world.set_resource(captures);
  }
};

TEST_F(ReflectionDemand, a_scene_without_a_reflective_material_has_no_reflections_at_all) {
  proxy_and_probe();
  floor(0.0f, 0.1f);
  floor(-1.0f, 1.0f);
  frames();
  expect_nothing();
}

TEST_F(ReflectionDemand, a_material_that_no_mesh_uses_demands_nothing) {
  Material mirror;
  mirror.reflectivity = 1.0f;
  mirror.roughness = 0.0f;
  static_cast<void>(scene->material(mirror));
  floor(0.0f, 0.1f);
  frames();
  expect_nothing();
}

TEST_F(ReflectionDemand, a_blended_mirror_demands_nothing) {
  Material glass;
  glass.reflectivity = 1.0f;
  glass.roughness = 0.0f;
  glass.alpha_mode = AlphaMode::blend;
  scene->draw(scene->mesh(test::quad(1.0f, scene->material(glass))));
  frames();
  expect_nothing();
}

/// Passes of probes alone.
constexpr const char* kProbePasses[] = {"reflection_start", "reflection_surfaces", "reflection_strong_tiles",
                                        "reflection_surroundings"};

TEST_F(ReflectionDemand, a_smooth_floor_has_the_passes_of_all_tiers) {
  proxy_and_probe();
  floor(1.0f, 0.1f);
  frames(1);
  EXPECT_THAT(passes, testing::IsSupersetOf({"reflection_proxies_upload", "reflection_probes_upload"}));
  frames();
  EXPECT_THAT(passes, testing::UnorderedElementsAre("reflection_start", "reflection_surfaces",
                                                    "reflection_strong_tiles", "reflection_surroundings",
                                                    "reflection_mirror_tiles", "reflection_screen_space",
                                                    "reflection_proxies", "reflection_dilate_x", "reflection_dilate_y",
                                                    "reflection_blur_x", "reflection_blur_y", "reflection_composite"));
  EXPECT_THAT(systems, testing::UnorderedElementsAre("ibr_proxies", "proxy_tiles"));
  EXPECT_GT(state.gpu_bytes, 0u);
}

TEST_F(ReflectionDemand, a_rough_floor_has_the_probes_alone) {
  proxy_and_probe();
  floor(1.0f, 0.7f);
  frames();
  EXPECT_THAT(passes, testing::UnorderedElementsAreArray(kProbePasses));
}

TEST_F(ReflectionDemand, a_rough_floor_without_a_probe_demands_nothing) {
  floor(1.0f, 0.7f);
  frames();
  expect_nothing();
}

TEST_F(ReflectionDemand, a_reflective_object_out_of_view_has_no_passes) {
  proxy_and_probe();
  floor(0.0f, 0.1f);
  floor(1.0f, 0.1f, {0.0, 0.0, 500.0});
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
}

TEST_F(ReflectionDemand, captures_show_captured_probes_and_no_other_tier) {
  proxy_and_probe();
  floor(1.0f, 0.1f);
  request.settings.purpose = ViewPurpose::capture;
  frames();
  EXPECT_THAT(passes, testing::UnorderedElementsAreArray(kProbePasses));
  world.resource<ReflectionCaptures>().probe_entities.clear();
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
}

TEST_F(ReflectionDemand, mode_off_has_no_passes) {
  proxy_and_probe();
  floor(1.0f, 0.1f);
  ASSERT_TRUE(renderer->knobs().set("reflections.mode", "off").ok());
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
}

TEST_F(ReflectionDemand, each_tier_is_drawn_only_if_it_is_wanted) {
  proxy_and_probe();
  floor(1.0f, 0.1f);
  const std::map<std::string, std::vector<bool>> tiers = {
      {"cube", {false, false}}, {"ssr+cube", {true, true}}, {"ibr+cube", {false, true}}, {"all", {true, true}}};
  for (const auto& [value, wanted] : tiers) {
    ASSERT_TRUE(renderer->knobs().set("reflections.tiers", value).ok());
    frames();
    EXPECT_EQ(passes.contains("reflection_screen_space"), wanted[0]) << value;
    EXPECT_EQ(passes.contains("reflection_blur_x"), wanted[1]) << value;
    EXPECT_EQ(passes.contains("reflection_composite"), wanted[1]) << value;
    EXPECT_TRUE(passes.contains("reflection_surroundings")) << value;
  }
}

// Hard case: reflections.room_tiers
TEST_F(ReflectionDemand, the_smallest_room_of_the_camera_leaves_tiers_out) {
  proxy_and_probe();
  floor(1.0f, 0.1f);
  const auto room = [&](const dvec3& center, float side, IbrRoomTiers tiers) {
    return world.create(IbrRoom{.size_m = vec3(side), .tiers = tiers},
                        WorldTransform{glm::translate(dmat4(1.0), center)});
  };
  room(dvec3(0.0), 40.0f, IbrRoomTiers::all);
  room({0.0, 0.0, 50.0}, 4.0f, IbrRoomTiers::cube);  // the camera is elsewhere
  const Entity small = room({0.0, 1.5, 4.0}, 20.0f, IbrRoomTiers::all);
  struct Case {
    IbrRoomTiers tiers;
    const char* knob;
    bool screen_space, proxies;
  };
  const Case cases[] = {
      {IbrRoomTiers::all, "all", true, true},        {IbrRoomTiers::ibr_cube, "all", false, true},
      {IbrRoomTiers::ssr_cube, "all", true, false},  {IbrRoomTiers::cube, "all", false, false},
      {IbrRoomTiers::all, "cube", false, false},     {IbrRoomTiers::ibr_cube, "ssr+cube", false, false},
      {IbrRoomTiers::cube, "ibr+cube", false, false}};
  for (const Case& given : cases) {
    world.get<IbrRoom>(small).tiers = given.tiers;
    ASSERT_TRUE(renderer->knobs().set("reflections.tiers", given.knob).ok());
    frames();
    const auto what = "room " + std::to_string(static_cast<int>(given.tiers)) + ", knob " + given.knob;
    EXPECT_EQ(passes.contains("reflection_screen_space"), given.screen_space) << what;
    EXPECT_EQ(passes.contains("reflection_mirror_tiles"), given.screen_space || given.proxies) << what;
    EXPECT_EQ(passes.contains("reflection_blur_x"), given.screen_space || given.proxies) << what;
    EXPECT_EQ(passes.contains("reflection_composite"), given.screen_space || given.proxies) << what;
    EXPECT_TRUE(passes.contains("reflection_surroundings")) << what;
  }
}

TEST_F(ReflectionDemand, what_disappears_gives_its_memory_back) {
  proxy_and_probe();
  const Entity mirror = floor(1.0f, 0.1f);
  frames();
  EXPECT_GT(state.gpu_bytes, 0u);
  world.remove<MeshInstance>(mirror);
  scene->assets().materials.back().reflectivity = 0.0f;
  ++scene->assets().version;
  frames(130);
  expect_nothing();
}

}  // namespace
}  // namespace gloam
