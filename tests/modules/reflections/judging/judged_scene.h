// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/math/srgb.h"
#include "modules/reflections/bake.h"
#include "modules/shadows/components.h"
#include "tests/modules/reflections/support/reflection_frames.h"

/// Scenes whose drawn reflections are judged by traced ones. Each case prints its figures.
namespace gloam::test {

class JudgedReflections : public ReflectionFrames {
 protected:
  void SetUp() override {
    ReflectionFrames::SetUp();
    if (IsSkipped()) return;
    settings = look_at(dvec3(0.0, 1.0, 5.0), dvec3(0.0, 0.3, 0.0), 320, 180);
    settings.camera.fov_y = 0.8f;
  }
  void TearDown() override {
    ReflectionFrames::TearDown();
    if (!missed_.empty() && !HasFailure()) GTEST_SKIP() << "missed bars (docs/measurements-reflections.md):" << missed_;
  }
  /// Judges a figure by its bar. Up to `known`, a miss is written down: the test is skipped and names it, so that it is
  /// seen in each run. Beyond it the test fails.
  void expect_at_most(double figure, double bar, double known, const std::string& what) {
    if (figure <= bar) return;
    if (figure > known || std::isnan(figure))
      ADD_FAILURE() << what << ": " << figure << ", bar " << bar << ", known " << known;
    missed_ += " " + what + " " + std::to_string(figure) + " (bar " + std::to_string(bar) + ")";
  }
  /// A lamp without shadows, in drawn and in traced light.
  Entity lamp(const Light& what, const dvec3& at) {
    const Entity entity = light(what, at);
    world.add(entity, ShadowCaster{.enabled = false});
    return entity;
  }
  /// A plain rectangle around `at` in the plane y = at.y.
  Entity ground(const Material& material, const dvec3& at, const glm::dvec2& half) {
    dmat4 place = glm::translate(dmat4(1.0), at);
    place = glm::rotate(place, -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
    return scene.draw(scene.mesh(quad(1.0f, scene.material(material))), glm::scale(place, dvec3(half.x, half.y, 1.0)));
  }
  Entity solid(const Material& material, const dvec3& center, const vec3& half) {
    return scene.draw(scene.mesh(box(half, scene.material(material))), glm::translate(dmat4(1.0), center));
  }
  [[nodiscard]] static Material matt(const vec3& color) {
    Material material;
    material.base_color = vec4(color, 1.0f);
    material.roughness = 0.9f;
    material.metallic = 0.0f;
    material.reflectivity = 0.0f;
    return material;
  }
  [[nodiscard]] static Material glow(const vec3& light) {
    Material material = matt(vec3(0.0f));
    material.emissive = light;
    return material;
  }
  [[nodiscard]] static Material mirror(float roughness) {
    Material material = exact_material(255, 255, 255, 0, 255);
    material.roughness = roughness;
    material.reflectivity = 1.0f;
    return material;
  }
  /// Captures all proxies and probes of a world.
  void bake(World& of) {
    attach_captures(of, value_of(bake_reflections(*renderer, of, {.executor = executor.get(), .progress = {}})));
  }
  /// The settled frame: later frames find what earlier ones left.
  [[nodiscard]] LinearPicture drawn() {
    for (int i = 0; i < 2; ++i) draw();
    return shot();
  }
  /// The same frame with traced reflections.
  [[nodiscard]] LinearPicture traced(std::uint32_t rays) {
    draw();
    const GeometryPicture seen = geometry();
    const auto tracer = value_of(make_scene_tracer(world, *executor, seen.view.position));
    world.set_resource(trace_radiance(
        {.world = world, .geometry = seen, .tracer = *tracer, .executor = *executor, .settings = {.rays = rays}}));
    LinearPicture picture = shot();
    world.remove_resource<TracedReflections>();
    return picture;
  }
  /// Linear light as a screen shows it, 0…1.
  [[nodiscard]] static dvec3 shown_light(const dvec3& light) {
    dvec3 display(0.0);
    for (int c = 0; c < 3; ++c) display[c] = linear_to_srgb(std::clamp(light[c], 0.0, 1.0));
    return display;
  }
  [[nodiscard]] static double greatest(const dvec3& v) { return std::max({v.x, v.y, v.z}); }

 private:
  std::string missed_;
};

}  // namespace gloam::test
