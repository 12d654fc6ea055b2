// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/module.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "engine/scene/gltf/import.h"
#include "modules/lights/components.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/components.h"
#include "modules/shadows/knobs.h"

namespace gloam {
namespace {

class ShadowsModuleTest : public ::testing::Test {
 protected:
  ShadowsModuleTest() {
    prepare_scene_world(world);
    world.register_component<Light>("light");
    module->register_components(world);
    module->knobs(knobs);
  }
  void prepare_view() {
    module->prepare_view(world, view.id, knobs);
    world.view_resource<ViewFaces>(view.id).casting_lights = 1;
  }
  [[nodiscard]] std::string reason(const RenderView* of = nullptr) const { return module->demand(world, of).reason; }
  [[nodiscard]] bool needed(const RenderView* of = nullptr) const { return module->demand(world, of).needed; }

  std::unique_ptr<Module> module = make_shadows_module();
  World world;
  KnobRegistry knobs;
  RenderView view;
};

TEST_F(ShadowsModuleTest, a_world_calls_for_it_with_lights_that_cast_shadows) {
  EXPECT_FALSE(needed());
  EXPECT_EQ(reason(), "no light casts shadows");
  world.create(Light{}, ShadowCaster{false, 0});
  EXPECT_FALSE(needed());
  world.create(Light{});
  EXPECT_TRUE(needed());
  EXPECT_EQ(reason(), "1 light casts shadows");
  world.create(Light{}, ShadowCaster{});
  EXPECT_EQ(reason(), "2 lights cast shadows");
}

TEST_F(ShadowsModuleTest, a_cookie_alone_calls_for_it) {
  Light spot;
  spot.kind = LightKind::spot;
  spot.cookie = 1;
  world.create(spot, ShadowCaster{false, 0});
  EXPECT_TRUE(needed());
  EXPECT_EQ(reason(), "1 light projects an image");
}

TEST_F(ShadowsModuleTest, a_view_without_casting_lights_does_not) {
  world.create(Light{});
  prepare_view();
  EXPECT_TRUE(needed(&view));
  world.view_resource<ViewFaces>(view.id).casting_lights = 0;
  EXPECT_FALSE(needed(&view));
  EXPECT_EQ(reason(&view), "1 light casts shadows, none in view");
}

TEST_F(ShadowsModuleTest, off_is_off) {
  world.create(Light{});
  EXPECT_TRUE(module->needs_casters(world, knobs));
  ASSERT_TRUE(knobs.set("shadows.mode", "off").ok());
  prepare_view();
  EXPECT_FALSE(needed(&view));
  EXPECT_EQ(reason(&view), "1 light casts shadows, but shadows.mode=off");
  EXPECT_FALSE(module->needs_casters(world, knobs));
}

TEST_F(ShadowsModuleTest, knobs_become_numbers) {
  const ShadowKnobs usual = shadow_knobs(knobs);
  EXPECT_TRUE(usual.enabled && usual.mips && usual.receiver_plane && usual.oriented && usual.early_outs);
  EXPECT_FALSE(usual.square || usual.d16);
  EXPECT_EQ(usual.mip_operator, GLOAM_SHADOW_MIPS_COVERAGE);
  EXPECT_EQ(usual.filter, 3u);
  EXPECT_EQ(usual.kernel, 8u);
  EXPECT_EQ(usual.levels, 255u);
  EXPECT_EQ(usual.atlas_size, 4096u);
  EXPECT_FLOAT_EQ(usual.bias_m, 0.002f);
  EXPECT_EQ(usual.bias_units, 0.0f);
  for (const auto& [name, value] : {std::pair{"bias", "hardware"},
                                    {"bias_units", "300"},
                                    {"kernel", "16"},
                                    {"visibility_bits", "4"},
                                    {"atlas", "8192"},
                                    {"mip_operator", "average"},
                                    {"casters", "simplified"},
                                    {"depth", "d16"},
                                    {"filter", "pcss"}})
    ASSERT_TRUE(knobs.set("shadows." + std::string(name), value).ok()) << name;
  const ShadowKnobs other = shadow_knobs(knobs);
  EXPECT_TRUE(other.d16 && other.simplified && !other.oriented);
  EXPECT_EQ(other.mip_operator, GLOAM_SHADOW_MIPS_AVERAGE);
  ASSERT_TRUE(knobs.set("shadows.mip_operator", "coverage").ok());
  EXPECT_EQ(shadow_knobs(knobs).mip_operator, GLOAM_SHADOW_MIPS_NEAREST) << "16 bits have no room for coverage";
  EXPECT_EQ(other.filter, 2u);
  EXPECT_EQ(other.kernel, 16u);
  EXPECT_EQ(other.levels, 15u);
  EXPECT_EQ(other.atlas_size, 8192u);
  EXPECT_EQ(other.bias_m, 0.0f);
  EXPECT_EQ(other.bias_units, 300.0f);
}

TEST_F(ShadowsModuleTest, constants_tell_knobs_apart) {
  std::set<std::vector<std::uint32_t>> values;
  for (const char* filter : {"hard", "pcf", "pcss", "chs"})
    for (const char* kernel : {"4", "8"})
      for (const char* plane : {"on", "off"}) {
        ASSERT_TRUE(knobs.set("shadows.filter", filter).ok() && knobs.set("shadows.kernel", kernel).ok() &&
                    knobs.set("shadows.receiver_plane", plane).ok());
        const ShadowKnobs now = shadow_knobs(knobs);
        std::vector<std::uint32_t> constants;
        for (const gpu::SpecConstant& constant : shadow_constants(now, now.filter))
          constants.push_back(constant.value.bits);
        values.insert(constants);
      }
  EXPECT_EQ(values.size(), 16u);
}

}  // namespace
}  // namespace gloam
