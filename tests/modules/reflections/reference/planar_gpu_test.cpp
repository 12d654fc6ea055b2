// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <utility>

#include "modules/accuracy/module.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/reference/reflection_tracing.h"
#include "modules/shadows/components.h"
#include "tests/modules/lighting/guest_module.h"

namespace gloam {
namespace {

using test::value_of;

/// Objects above a floor that is a mirror, drawn by the renderer.
struct DrawnReflections : test::GuestSceneTest {
  void SetUp() override {
    GuestSceneTest::SetUp();
    if (IsSkipped()) return;
    set("reflections.mode", "off");  // surfaces that are seen in the mirror show no reflections
    environment() = {.sky_zenith = {0.2f, 0.4f, 1.0f}, .sky_horizon = {0.7f, 0.6f, 0.5f}, .sky_ground = vec3(0.3f)};
    settings = test::look_at(dvec3(0.6, 1.4, 4.0), dvec3(0.0, 0.2, 0.0), 96, 64);
    Material mirror = exact_material(230, 200, 180, 0, 255);
    mirror.reflectivity = 1.0f;
    const dmat4 flat = glm::rotate(dmat4(1.0), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
    scene.draw(scene.mesh(test::quad(20.0f, scene.material(mirror))), flat);
    Material shining = exact_material(200, 90, 60, 128, 0);
    shining.emissive = {0.3f, 0.1f, 0.0f};
    const Material ball = exact_material(90, 200, 160, 100, 80), brick = exact_material(220, 180, 140, 160, 0);
    scene.draw(scene.mesh(test::round_ball(0.5f, 48, 24, scene.material(ball))), at({-0.8, 0.7, 0.0}));
    scene.draw(scene.mesh(test::round_ball(0.5f, 48, 24, scene.material(shining))),
               glm::scale(at({0.9, 0.8, 0.3}), dvec3(-1.0, 1.4, 0.8)));
    scene.draw(scene.mesh(test::box(vec3(0.4f), scene.material(brick))),
               glm::rotate(at({0.1, 0.6, -1.2}), 0.6, dvec3(0.0, 1.0, 0.0)));
    Light lamp;
    lamp.intensity = 6.0f;
    lamp.range_m = 12.0f;
    unshadowed(lamp, {2.0, 2.5, 2.0});
    lamp.kind = LightKind::spot;
    lamp.inner_angle = 0.2f;
    lamp.outer_angle = 0.6f;
    lamp.color = {0.4f, 0.6f, 1.0f};
    unshadowed(lamp, {-2.0, 2.0, 2.0}, {1.0, -1.0, -1.2});
    lamp.kind = LightKind::directional;
    lamp.intensity = 0.8f;
    unshadowed(lamp, {}, {0.3, -1.0, -0.4});
  }
  [[nodiscard]] static dmat4 at(const dvec3& place) { return glm::translate(dmat4(1.0), place); }
  void unshadowed(const Light& what, const dvec3& place, const dvec3& direction = dvec3(0.0, -1.0, 0.0)) {
    world.add(light(what, place, direction), ShadowCaster{.enabled = false});
  }
  void leave_out_specular_ambient() {
    guest = [](FrameBuilder& frame, PassPhase phase) {
      if (phase == PassPhase::announce) frame.put(SpecularAmbientTaken{});
    };
  }
  [[nodiscard]] TracedReflections trace(const GeometryPicture& geometry) {
    const auto tracer = value_of(make_scene_tracer(world, *executor, geometry.view.position));
    return trace_radiance(
        {.world = world, .geometry = geometry, .tracer = *tracer, .executor = *executor, .settings = {.rays = 4}});
  }
};

TEST_F(DrawnReflections, a_mirror_shows_what_a_mirrored_camera_sees) {
  leave_out_specular_ambient();
  ASSERT_NO_FATAL_FAILURE(draw());
  const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
  const TracedReflections traced = trace(geometry);
  ViewSettings mirrored = settings;
  mirrored.mirror = MirrorPlane{};
  ASSERT_NO_FATAL_FAILURE(draw(world, mirrored));
  const LinearPicture planar = linear();
  std::size_t floor = 0, objects = 0, different = 0;
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const std::size_t index = std::size_t{y} * settings.width + x;
      if (geometry.is_sky(index) || geometry.texel(index).normal.y < 0.9999f) continue;
      if (std::abs(geometry.position(x, y).y + geometry.view.position.y) > 1e-3) continue;
      const dvec3 seen(traced.radiance[4 * index], traced.radiance[4 * index + 1], traced.radiance[4 * index + 2]);
      const dvec3 direction = glm::normalize(geometry.position(x, y) * dvec3(1.0, -1.0, 1.0));
      ++floor;
      objects += relative_error(seen, test::oracle_sky(environment(), direction), 1.0) > 0.02 ? 1 : 0;
      // The geometry buffer's colours and normals are rounded, and edges fall into one pixel or its neighbour.
      different += relative_error(seen, pixel(planar, x, y), 1.0) <= 0.03 ? 0 : 1;
    }
  EXPECT_GT(floor, 2000u);
  EXPECT_GT(objects, 300u);
  EXPECT_LT(different, floor / 100);
}

TEST_F(DrawnReflections, without_reflectivity_the_composite_is_the_usual_picture) {
  for (Material& material : scene.assets().materials) material.reflectivity = 0.0f;
  ++scene.assets().version;
  ASSERT_NO_FATAL_FAILURE(draw());
  const LinearPicture usual = linear();
  leave_out_specular_ambient();
  ASSERT_NO_FATAL_FAILURE(draw());
  const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
  const LinearPicture drawn_base = linear();
  const LinearPicture composed = compose_reflections(drawn_base, geometry, world, trace(geometry));
  const LinearPicture base = without_specular_ambient(usual, geometry, world);
  std::size_t darker = 0;
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      ASSERT_LT(relative_error(pixel(composed, x, y), pixel(usual, x, y), 1.0), 4e-3) << x << ", " << y;
      ASSERT_LT(glm::length(pixel(base, x, y) - pixel(drawn_base, x, y)), 4e-3) << x << ", " << y;
      darker += pixel(base, x, y).g < 0.98 * pixel(usual, x, y).g ? 1 : 0;
    }
  EXPECT_GT(darker, 1000u);
}

}  // namespace
}  // namespace gloam
