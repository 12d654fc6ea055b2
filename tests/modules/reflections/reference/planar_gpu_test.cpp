// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <utility>

#include "engine/ecs/view.h"
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
  [[nodiscard]] TracedReflections trace(const GeometryPicture& geometry, const ReflectionTracing& tracing) {
    const auto tracer = value_of(make_scene_tracer(world, *executor, geometry.view.position));
    return trace_radiance(
        {.world = world, .geometry = geometry, .tracer = *tracer, .executor = *executor, .settings = tracing});
  }
  /// Compares reflections of the floor with the picture of a mirrored camera.
  struct FloorError {
    std::size_t floor = 0;    ///< pixels
    std::size_t objects = 0;  ///< that show no sky
    std::size_t different = 0;
    dvec3 traced = dvec3(0.0), drawn = dvec3(0.0);  ///< sums over objects
  };
  [[nodiscard]] FloorError compare(const GeometryPicture& geometry, const TracedReflections& traced,
                                   const LinearPicture& planar, double most) {
    FloorError error;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const std::size_t index = std::size_t{y} * settings.width + x;
        if (geometry.is_sky(index) || geometry.texel(index).normal.y < 0.9999f) continue;
        if (std::abs(geometry.position(x, y).y + geometry.view.position.y) > 1e-3) continue;
        const dvec3 seen(traced.radiance[4 * index], traced.radiance[4 * index + 1], traced.radiance[4 * index + 2]);
        const dvec3 direction = glm::normalize(geometry.position(x, y) * dvec3(1.0, -1.0, 1.0));
        ++error.floor;
        error.different += relative_error(seen, pixel(planar, x, y), 1.0) <= most ? 0 : 1;
        if (relative_error(seen, test::oracle_sky(environment(), direction), 1.0) <= 0.02) continue;
        ++error.objects;
        error.traced += seen;
        error.drawn += pixel(planar, x, y);
      }
    return error;
  }
};

TEST_F(DrawnReflections, a_mirror_shows_what_a_mirrored_camera_sees) {
  ASSERT_NO_FATAL_FAILURE(draw());
  const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
  // The picture without reflections has surroundings of the sky, as the last surface of a traced ray.
  const TracedReflections traced = trace(geometry, {.rays = 4, .bounces = 1});
  ViewSettings mirrored = settings;
  mirrored.mirror = MirrorPlane{};
  ASSERT_NO_FATAL_FAILURE(draw(world, mirrored));
  const FloorError error = compare(geometry, traced, linear(), 0.03);
  EXPECT_GT(error.floor, 2000u);
  EXPECT_GT(error.objects, 300u);
  // The geometry buffer's colours and normals are rounded, and edges fall into one pixel or its neighbour.
  EXPECT_LT(error.different, error.floor / 100);
}

TEST_F(DrawnReflections, a_mirror_shows_the_traced_reflections_of_a_mirrored_camera) {
  for (Material& material : scene.assets().materials) {
    if (material.reflectivity >= 0.0f) continue;  // the floor
    material.metallic = 1.0f;
    material.base_color = {1.0f, 0.8f, 0.4f, 1.0f};
  }
  ++scene.assets().version;
  world.view<Light>().each([](Light& light) { light.intensity = 0.0f; });  // pixels widen highlights of curved surfaces
  ASSERT_NO_FATAL_FAILURE(draw());
  const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
  const TracedReflections one = trace(geometry, {.rays = 256, .bounces = 1});
  const TracedReflections two = trace(geometry, {.rays = 256, .bounces = 2});
  leave_out_specular_ambient();
  ViewSettings mirrored = settings;
  mirrored.mirror = MirrorPlane{};
  ASSERT_NO_FATAL_FAILURE(draw(world, mirrored));
  const GeometryPicture below = value_of(renderer->read_geometry(world, settings.id));
  const LinearPicture planar = compose_reflections(linear(), below, world, trace(below, {.rays = 256, .bounces = 1}));
  const FloorError error = compare(geometry, two, planar, 0.06), before = compare(geometry, one, planar, 0.06);
  EXPECT_GT(error.objects, 300u);
  EXPECT_LT(error.different, error.floor / 50);
  EXPECT_GT(before.different, error.floor / 20) << "a further bounce is seen";
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(error.traced[c] / error.drawn[c], 1.0, 0.01);
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
  const LinearPicture composed = compose_reflections(drawn_base, geometry, world, trace(geometry, {.rays = 4}));
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
