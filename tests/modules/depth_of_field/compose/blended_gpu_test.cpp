// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "modules/fog/components.h"
#include "tests/modules/depth_of_field/support/dof_stage.h"
#include "tests/support/worse.h"

namespace gloam::test {
namespace {

/// A glowing pane over part of a far wall with stripes.
class BlendedSurfaces : public DofStageTest {
 protected:
  struct Pane {
    AlphaMode mode = AlphaMode::blend;
    float alpha = 1.0f;
    double distance_m = 3.0;
  };
  static void add_scene(DofStage& stage, const Pane& pane) {
    for (int i = -6; i <= 6; ++i) stage.glow({2.0 * i, 0.0, -28.0}, 0.8f, vec3(4.0f, 1.0f, 8.0f));
    Material material{.base_color = vec4(0.0f, 0.0f, 0.0f, pane.alpha), .metallic = 0.0f, .roughness = 1.0f};
    material.alpha_mode = pane.mode;
    material.emissive = vec3(1.0f, 3.0f, 0.5f);
    const float half = 0.2f * static_cast<float>(pane.distance_m);
    stage.scene.draw(stage.scene.mesh(quad(half, stage.scene.material(material))),
                     glm::translate(dmat4(1.0), dvec3(0.02, 0.01, -pane.distance_m)));
  }
  static double worst_difference(const LinearPicture& a, const LinearPicture& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
      worst = worse(worst, std::abs(double{a.rgba[i]} - b.rgba[i]) / std::max(1.0, double{b.rgba[i]}));
    return worst;
  }
};

TEST_F(BlendedSurfaces, of_full_opacity_look_like_opaque_ones_through_a_lens) {
  for (const double distance_m : {0.7, 3.0, 9.0})
    for (const char* resolution : {"half", "full"}) {
      DofStage blended, opaque;
      add_scene(blended, {.mode = AlphaMode::blend, .distance_m = distance_m});
      add_scene(opaque, {.mode = AlphaMode::opaque, .distance_m = distance_m});
      for (DofStage* stage : {&blended, &opaque}) {
        stage->set("dof.resolution", resolution);
        stage->focus({.focus_m = 3.0f, .f_number = 0.2f});
      }
      EXPECT_LT(worst_difference(blended.draw(), opaque.draw()), 2e-3) << distance_m << " m, " << resolution;
    }
}

TEST_F(BlendedSurfaces, of_full_opacity_look_like_opaque_ones_in_fog) {
  DofStage blended, opaque;
  add_scene(blended, {.mode = AlphaMode::blend});
  add_scene(opaque, {.mode = AlphaMode::opaque});
  for (DofStage* stage : {&blended, &opaque}) stage->world.create(Fog{0.1f, vec3(2.0f, 0.5f, 0.1f)});
  EXPECT_LT(worst_difference(blended.draw(), opaque.draw()), 2e-3);
}

TEST_F(BlendedSurfaces, that_are_invisible_change_nothing) {
  DofStage with, without;
  add_scene(with, {.mode = AlphaMode::blend, .alpha = 0.0f});
  add_scene(without, {.mode = AlphaMode::blend, .alpha = 0.0f, .distance_m = 1e6});
  for (DofStage* stage : {&with, &without}) stage->focus({.focus_m = 3.0f, .f_number = 0.2f});
  EXPECT_TRUE(with.draw().rgba == without.draw().rgba);
}

TEST_F(BlendedSurfaces, without_fog_and_lens_have_no_depth_drawn) {
  DofStage stage;
  add_scene(stage, {});
  const auto draws_depth = [&] {
    static_cast<void>(stage.draw());
    const auto& passes = stage.renderer->report().passes;
    return std::ranges::any_of(passes, [](const PassTime& pass) { return pass.name == "front_depth"; });
  };
  EXPECT_FALSE(draws_depth());
  stage.focus({.focus_m = 3.0f, .f_number = 0.2f});
  EXPECT_TRUE(draws_depth());
}

}  // namespace
}  // namespace gloam::test
