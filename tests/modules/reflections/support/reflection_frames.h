// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/math/packing.h"
#include "engine/render/readback/geometry_picture.h"
#include "modules/accuracy/module.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/components.h"
#include "modules/reflections/reference/reflection_tracing.h"
#include "tests/modules/lighting/guest_module.h"
#include "tests/support/worse.h"

namespace gloam::test {

/// Layers of one colour each, with all mips.
[[nodiscard]] inline CapturedLayers flat_layers(const std::vector<vec4>& colors) {
  CapturedLayers layers{8, 4, static_cast<std::uint32_t>(colors.size()), {}};
  for (const vec4& color : colors)
    for (std::size_t texel = 0; texel < layers.layer_halves() / 4; ++texel)
      for (int channel = 0; channel < 4; ++channel) layers.texels.push_back(float_to_half(color[channel]));
  return layers;
}

/// Frames of a floor that mirrors, with things on it that shine by themselves.
class ReflectionFrames : public GuestSceneTest {
 protected:
  void SetUp() override {
    GuestSceneTest::SetUp();
    if (IsSkipped()) return;
    settings = look_at(dvec3(0.4, 1.2, 4.0), dvec3(0.0, 0.3, 0.0), 96, 64);
  }
  [[nodiscard]] static dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }
  Entity mirror_floor(float roughness = 0.0f, float height = 0.0f, float reflectivity = 1.0f) {
    Material mirror = exact_material(255, 255, 255, 0, 255);
    mirror.roughness = roughness;
    mirror.reflectivity = reflectivity;
    const dmat4 flat =
        glm::rotate(at(0.0, static_cast<double>(height), 0.0), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
    return scene.draw(scene.mesh(quad(8.0f, scene.material(mirror))), flat);
  }
  /// A material that reflects nothing and has this radiance.
  [[nodiscard]] std::uint32_t shining(const vec3& light) {
    Material material;
    material.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    material.metallic = 1.0f;  // of a black metal: no highlight
    material.reflectivity = 0.0f;
    material.emissive = light;
    return scene.material(material);
  }
  Entity shining_box(const dvec3& center, const vec3& half, const vec3& light) {
    return scene.draw(scene.mesh(box(half, shining(light))), at(center.x, center.y, center.z));
  }
  Entity proxy(const vec2& size, const dmat4& matrix) {
    IbrProxy quad;
    quad.size_m = size;
    return world.create(quad, WorldTransform{matrix});
  }
  Entity probe(const vec3& size, const dvec3& center, bool global = false) {
    CubeProbe what;
    what.size_m = size;
    what.global = global;
    return world.create(what, WorldTransform{at(center.x, center.y, center.z)});
  }
  /// Captures of one colour for each proxy and probe of the world.
  static void capture(World& of, const std::vector<vec4>& proxies, const std::vector<vec4>& probes,
                      std::uint64_t version = 1) {
    ReflectionCaptures captures;
    of.view<const IbrProxy>().each([&](Entity entity, const IbrProxy&) { captures.proxy_entities.push_back(entity); });
    of.view<const CubeProbe>().each(
        [&](Entity entity, const CubeProbe&) { captures.probe_entities.push_back(entity); });
    ASSERT_EQ(captures.proxy_entities.size(), proxies.size());
    ASSERT_EQ(captures.probe_entities.size(), probes.size());
    const auto by_index = [](Entity a, Entity b) { return a.index < b.index; };
    std::ranges::sort(captures.proxy_entities, by_index);
    std::ranges::sort(captures.probe_entities, by_index);
    captures.proxies = flat_layers(proxies);
    captures.probes = flat_layers(probes);
    captures.content = captures.version = version;
    of.set_resource(captures);
  }
  void sky(const vec3& light) { environment() = {.sky_zenith = light, .sky_horizon = light, .sky_ground = light}; }
  /// A sky, two boxes and a ball above the floor.
  void furnish(float roughness = 0.0f) {
    environment() = {.sky_zenith = {0.2f, 0.4f, 1.0f}, .sky_horizon = {0.7f, 0.6f, 0.5f}, .sky_ground = vec3(0.3f)};
    mirror_floor(roughness);
    shining_box({-0.9, 0.5, 0.0}, vec3(0.4f, 0.5f, 0.3f), {2.0f, 0.2f, 0.1f});
    shining_box({0.8, 0.35, -0.6}, vec3(0.3f, 0.35f, 0.5f), {0.1f, 1.5f, 0.3f});
  }
  /// Draws and reads the light.
  [[nodiscard]] LinearPicture shot() {
    draw();
    return linear();
  }
  [[nodiscard]] GeometryPicture geometry() { return value_of(renderer->read_geometry(world, settings.id)); }
  /// A named image of half floats, four per pixel.
  [[nodiscard]] std::vector<vec4> values(std::string_view name) {
    const ImageBytes bytes = image(name);
    std::vector<vec4> values(bytes.bytes.size() / 8);
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::uint16_t halves[4];
      std::memcpy(halves, bytes.bytes.data() + 8 * i, 8);
      for (int c = 0; c < 4; ++c) values[i][c] = half_to_float(halves[c]);
    }
    return values;
  }
  /// Values of the visualizer's image for the current scene.
  [[nodiscard]] std::vector<vec4> shown(const std::string& visualizer) {
    settings.visualizer = visualizer;
    draw();
    std::vector<vec4> found = values(visualizer);
    settings.visualizer = "none";
    return found;
  }
  struct Agreement {
    std::size_t confident = 0;  ///< pixels
    std::size_t different = 0;  ///< of those
  };
  /// Compares the frame with one of traced reflections, where the drawn ones are confident.
  [[nodiscard]] Agreement compare_with_traced() {
    const std::vector<vec4> confidence = shown("reflection_confidence");
    const LinearPicture drawn = shot();
    const GeometryPicture seen = geometry();
    const auto tracer = value_of(make_scene_tracer(world, *executor, seen.view.position));
    world.set_resource(trace_radiance(
        {.world = world, .geometry = seen, .tracer = *tracer, .executor = *executor, .settings = {.rays = 1}}));
    const LinearPicture traced = shot();
    world.remove_resource<TracedReflections>();
    Agreement found;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        if (confidence[std::size_t{y} * settings.width + x].x < 0.9f) continue;
        ++found.confident;
        found.different += relative_error(pixel(drawn, x, y), pixel(traced, x, y), 2.0) <= 0.03 ? 0 : 1;
      }
    return found;
  }
  [[nodiscard]] static double worst_difference(const LinearPicture& a, const LinearPicture& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < std::min(a.rgba.size(), b.rgba.size()); ++i) {
      const double difference = std::abs(static_cast<double>(a.rgba[i]) - static_cast<double>(b.rgba[i]));
      worst = worse(worst, difference);
    }
    return worst;
  }
};

}  // namespace gloam::test
