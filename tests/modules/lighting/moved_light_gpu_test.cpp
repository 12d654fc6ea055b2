// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/render/declare/draw_pass.h"
#include "shaders/lighting_test/shaders.h"
#include "tests/modules/lighting/guest_module.h"
#include "tests/support/expect_assert.h"

// A module writes its result to another image than the one that it reads, and moves LitOutput there.

namespace gloam {
namespace {

struct MovedLight : test::GuestSceneTest {
  void SetUp() override {
    GuestSceneTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    scene.draw(scene.mesh(test::box(vec3(0.6f), scene.material(exact_material(200, 120, 60, 102, 0)))));
    Light lamp;
    lamp.intensity = 30.0f;
    light(lamp, dvec3(0.5, 0.9, 2.0));
    environment().sky_zenith = vec3(0.4f, 0.6f, 1.2f);
    environment().has_exposure = true;
    environment().exposure_ev100 = 3.0f;
    set("lighting.tone_map", "linear");
  }

  /// Doubles the light in a transient image.
  static void add_doubling(FrameBuilder& frame, PassPhase phase) {
    if (phase != PassPhase::post) return;
    LitOutput& lit = frame.get<LitOutput>();
    DrawPass pass(frame, "twice", {shaders::lighting_test::twice_frag});
    pass.read("lit_image", lit.color);
    lit.color = pass.target(create_view_image(frame, "twice", gpu::Format::rgba16_float));
    pass.draw_triangle();
  }
  [[nodiscard]] std::uint32_t passes(std::string_view name) const {
    std::uint32_t count = 0;
    for (const PassTime& pass : renderer->report().passes) count += pass.name == name ? 1 : 0;
    return count;
  }
};

TEST_F(MovedLight, is_read_and_mapped_where_it_ended) {
  ASSERT_NO_FATAL_FAILURE(draw());
  LinearPicture expected = linear();
  for (std::size_t i = 0; i < expected.rgba.size(); ++i)
    if (i % 4 != 3) expected.rgba[i] *= 2.0f;  // exact in half floats
  EXPECT_EQ(passes("copy_light"), 0u) << "light that has not moved is not copied";
  environment().exposure_ev100 = 2.0f;
  ASSERT_NO_FATAL_FAILURE(draw());
  const Picture brighter = picture();  // twice the exposure

  environment().exposure_ev100 = 3.0f;
  guest = &add_doubling;
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_EQ(differences(linear().rgba, expected.rgba), 0u);
  const Picture drawn = picture();
  int worst = 0;
  for (std::size_t i = 0; i < drawn.rgba.size(); ++i)
    worst = std::max(worst, std::abs(drawn.rgba[i] - brighter.rgba[i]));
  EXPECT_LE(worst, 1);
  EXPECT_GT(*std::max_element(expected.rgba.begin(), expected.rgba.end()), 1.0f);
}

TEST_F(MovedLight, may_move_on_and_return) {
  ASSERT_NO_FATAL_FAILURE(draw());
  LinearPicture expected = linear();
  for (std::size_t i = 0; i < expected.rgba.size(); ++i)
    if (i % 4 != 3) expected.rgba[i] *= 4.0f;
  guest = [](FrameBuilder& frame, PassPhase phase) {
    if (phase != PassPhase::post) return;
    const ImageRef first = frame.get<LitOutput>().color;
    add_doubling(frame, phase);
    DrawPass pass(frame, "back", {shaders::lighting_test::twice_frag});
    pass.read("lit_image", frame.get<LitOutput>().color);
    frame.get<LitOutput>().color = pass.target(first);
    pass.draw_triangle();
  };
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_EQ(differences(linear().rgba, expected.rgba), 0u);
  EXPECT_EQ(passes("copy_light"), 0u);
}

TEST_F(MovedLight, is_copied_only_for_those_who_read_it) {
  guest = &add_doubling;
  for (const bool keep : {true, false}) {
    const ViewRequest request{.settings = settings, .target = {}, .keep_linear = keep};
    ASSERT_TRUE(renderer->render(world, std::span(&request, 1)).ok());
    ASSERT_TRUE(renderer->wait().ok());
    EXPECT_EQ(passes("copy_light"), keep ? 1u : 0u);
  }
  EXPECT_ASSERT((void)renderer->read_linear(settings.id), "keep_linear");
  guest = {};
  const ViewRequest request{.settings = settings, .target = {}, .keep_linear = false};
  ASSERT_TRUE(renderer->render(world, std::span(&request, 1)).ok());
  EXPECT_TRUE(renderer->read_linear(settings.id).ok()) << "light that has not moved is always there";
}

}  // namespace
}  // namespace gloam
