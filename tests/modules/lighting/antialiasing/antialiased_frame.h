// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "engine/math/srgb.h"
#include "modules/lighting/antialiasing/reference.h"
#include "tests/modules/lighting/lit_scene.h"

namespace gloam::test {

/// A glowing square that is turned by an angle, before black. One metre is 20 pixels.
struct AntialiasedFrame : LitSceneTest {
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(LitSceneTest::SetUp());
    if (IsSkipped()) return;
    settings = look_at(dvec3(0.0, 0.0, 3.0), dvec3(0.0), 96, 64);
    settings.camera.orthographic = true;
    settings.camera.half_height_m = 1.6f;
    environment() = {};
    environment().has_exposure = true;
    environment().exposure_ev100 = 0.0f;
    set("lighting.dither", "off");
  }
  void set(std::string_view knob, std::string_view value) { ASSERT_TRUE(renderer->knobs().set(knob, value).ok()); }
  void glow(double angle, const dvec3& at = dvec3(0.0), float half = 1.0f) {
    Material material{.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f), .metallic = 0.0f, .roughness = 1.0f};
    material.emissive = vec3(1.0f);
    scene.draw(scene.mesh(quad(half, scene.material(material))),
               glm::rotate(glm::translate(dmat4(1.0), at), angle, dvec3(0.0, 0.0, 1.0)));
  }
  [[nodiscard]] std::uint32_t antialiasing_passes() const {
    std::uint32_t count = 0;
    for (const PassTime& pass : renderer->report().passes) count += pass.name.starts_with("antialiasing") ? 1 : 0;
    return count;
  }
  [[nodiscard]] Picture drawn(std::string_view antialiasing) {
    set("lighting.antialiasing", antialiasing);
    draw();
    return picture();
  }
  /// The reference picture of the frame as it was drawn last.
  [[nodiscard]] Picture supersampled(std::uint32_t frames) {
    set("lighting.antialiasing", "off");
    draw();
    const FramePictures frame{linear(), picture()};
    const ReferenceInput input{.world = world,
                               .view = world.view_resource<RenderView>(settings.id),
                               .knobs = renderer->knobs(),
                               .frame = frame,
                               .samples = 4 * frames,
                               .executor = *executor,
                               .redraw = [this](const auto& change, const auto& restore) -> Result<FramePictures> {
                                 change(world);
                                 draw();
                                 restore(world);
                                 return FramePictures{linear(), picture()};
                               }};
    return value_of(draw_supersampled(input)).picture;
  }
  [[nodiscard]] static double root_mean_square(const Picture& a, const Picture& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::pow(a.rgba[i] - b.rgba[i], 2.0);
    return std::sqrt(sum / static_cast<double>(a.rgba.size()));
  }
};

}  // namespace gloam::test
