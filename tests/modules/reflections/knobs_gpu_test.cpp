// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Knobs that switch parts of reflections off.
#include <gtest/gtest.h>

#include <cstddef>

#include "tests/modules/reflections/support/reflection_frames.h"

namespace gloam::test {
namespace {

class ReflectionKnobFrames : public ReflectionFrames {
 protected:
  /// A mirror that leans by 6 degrees, before a striped wall.
  void leaning_mirror() {
    sky(vec3(0.05f));
    Material mirror = exact_material(255, 255, 255, 0, 255);
    mirror.roughness = 0.0f;
    mirror.reflectivity = 1.0f;
    scene.draw(scene.mesh(quad(2.0f, scene.material(mirror))), glm::rotate(at(0.0, 0.0, 1.0), -1.466, dvec3(1, 0, 0)));
    for (int i = 0; i < 3; ++i)
      shining_box({0.0, 0.5 + 1.0 * i, -1.6}, {6.0f, 0.5f, 0.05f},
                  i % 2 == 0 ? vec3(1.0f, 0.2f, 0.1f) : vec3(0.1f, 0.4f, 1.0f));
    settings = look_at(dvec3(0.0, 2.0, 4.0), dvec3(0.0, 0.4, 0.6), 96, 64);
    settings.camera.fov_y = 0.7f;
    set("reflections.blur", "off");
    set("ssr.resolution", "full");
    set("ssr.reach", "8");
  }
  [[nodiscard]] Agreement with_knobs(const char* normal, const char* bump) {
    set("reflections.normal", normal);
    set("reflections.bump", bump);
    const Agreement found = compare_with_traced();
    EXPECT_GT(found.confident, 300u) << normal;
    return found;
  }
};

TEST_F(ReflectionKnobFrames, rays_of_pixel_normals_meet_what_traced_rays_meet_on_a_leaning_mirror) {
  leaning_mirror();
  set("reflections.tiers", "ssr+cube");
  const Agreement pixel = with_knobs("pixel", "on"), up = with_knobs("up", "off"), bent = with_knobs("up", "on");
  // The edge between two stripes may fall into a row of pixels or its neighbour.
  EXPECT_LE(pixel.different, settings.width);
  EXPECT_GT(up.different, up.confident / 3);
  EXPECT_LT(bent.different, up.different);
}

TEST_F(ReflectionKnobFrames, dilation_carries_blur_over_silhouettes_and_costs_two_passes) {
  sky(vec3(0.0f));
  mirror_floor(0.35f);
  shining_box({0.0, 0.9, -1.0}, {0.5f, 0.5f, 0.2f}, vec3(4.0f));
  const auto dilations = [&] {
    std::size_t count = 0;
    for (const PassTime& pass : renderer->report().passes) count += pass.name.starts_with("reflection_dilate") ? 1 : 0;
    return count;
  };
  const LinearPicture with = shot();
  EXPECT_EQ(dilations(), 2u);
  set("reflections.dilation", "off");
  const LinearPicture without = shot();
  EXPECT_EQ(dilations(), 0u);
  EXPECT_GT(worst_difference(with, without), 0.1);
}

}  // namespace
}  // namespace gloam::test
