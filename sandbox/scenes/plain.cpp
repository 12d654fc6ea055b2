// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/plain.h"

#include "engine/scene/resources.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

void add_sun(SceneBuilder& builder) {
  Light sun;
  sun.kind = LightKind::directional;
  sun.color = vec3(1.0f, 0.82f, 0.62f);
  sun.intensity = 2000.0f;  // lux: the last minutes before sunset
  builder.add_light("sun", sun, dvec3(0.0, 10.0, 0.0), dvec3(-0.6, -0.45, -0.5), true);
}

}  // namespace

void build_plain_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  const auto material = [&](const char* name, vec4 color, float metallic, float roughness) {
    return builder.add_material({.name = name, .base_color = color, .metallic = metallic, .roughness = roughness});
  };
  const std::uint32_t floor = material("floor", vec4(0.34f, 0.33f, 0.31f, 1.0f), 0.0f, 0.8f);
  const std::uint32_t clay = material("clay", vec4(0.55f, 0.19f, 0.11f, 1.0f), 0.0f, 0.7f);
  const std::uint32_t glaze = material("glaze", vec4(0.05f, 0.20f, 0.28f, 1.0f), 0.0f, 0.18f);
  const std::uint32_t brass = material("brass", vec4(0.83f, 0.63f, 0.33f, 1.0f), 1.0f, 0.3f);
  const std::uint32_t stone = material("stone", vec4(0.58f, 0.55f, 0.50f, 1.0f), 0.0f, 0.6f);

  const vec2 column[] = {{0.0f, 0.0f},  {0.45f, 0.0f}, {0.45f, 0.2f}, {0.3f, 0.3f},
                         {0.26f, 2.2f}, {0.4f, 2.35f}, {0.4f, 2.5f},  {0.0f, 2.5f}};
  const ArchSize arch = {.width_m = 3.0f, .height_m = 1.9f, .radius_m = 1.1f, .depth_m = 0.6f};
  const std::uint32_t pier = builder.add_mesh("pier", box_shape({0.4f, 1.4f, 0.6f}), stone);
  builder.add_instance("floor", builder.add_mesh("floor", box_shape({40.0f, 0.2f, 40.0f}), floor), {0.0, -0.2, 0.0});
  builder.add_instance("box", builder.add_mesh("box", box_shape(vec3(1.2f)), clay), {-2.4, 0.0, 0.4}, 0.5);
  builder.add_instance("sphere", builder.add_mesh("sphere", sphere_shape(0.7f, 48), glaze), {-0.5, 0.7, 0.9});
  builder.add_instance("column", builder.add_mesh("column", turned_shape(column, 40), brass), {1.2, 0.0, 0.2});
  builder.add_instance("arch", builder.add_mesh("arch", arch_shape(arch, 24), stone), {0.2, 1.4, -2.4});
  builder.add_instance("left pier", pier, {-1.1, 0.0, -2.4});
  builder.add_instance("right pier", pier, {1.5, 0.0, -2.4});
  add_sun(builder);
  builder.add_camera("main", {2.6, 2.3, 6.2}, {-0.2, 0.9, -0.4}, 0.75f);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(24.0f, 42.0f, 80.0f);
  environment.sky_horizon = vec3(110.0f, 78.0f, 60.0f);
  environment.sky_ground = vec3(22.0f, 18.0f, 16.0f);
  environment.has_exposure = true;
  environment.exposure_ev100 = 9.4f;
  info.name = "plain";
}

}  // namespace gloam
