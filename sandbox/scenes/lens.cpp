// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/lens.h"

#include <array>
#include <string>

#include "engine/scene/resources.h"
#include "modules/depth_of_field/components.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

// The camera looks along −Z over a table whose top is at height 0.
constexpr dvec3 kEye(0.0, 0.42, 3.0);
constexpr dvec3 kTarget(0.0, 0.16, 0.0);
constexpr float kFov = 0.35f;
constexpr float kFocus_m = 3.0f;
constexpr float kFNumber = 2.0f;

std::uint32_t add_lens_material(SceneBuilder& builder, const char* name, vec3 color, float roughness) {
  return builder.add_material(
      {.name = name, .base_color = vec4(color, 1.0f), .metallic = 0.0f, .roughness = roughness});
}

/// Pieces of a board game: three before the focus, one at it, four behind it.
void add_pieces(SceneBuilder& builder) {
  const vec2 outline[] = {{0.0f, 0.0f},    {0.075f, 0.0f}, {0.075f, 0.03f}, {0.04f, 0.06f},  {0.025f, 0.2f},
                          {0.045f, 0.22f}, {0.03f, 0.25f}, {0.05f, 0.29f},  {0.045f, 0.33f}, {0.0f, 0.36f}};
  const Primitive piece = turned_shape(outline, 32);
  const std::uint32_t light =
      builder.add_mesh("light piece", piece, add_lens_material(builder, "maple", vec3(0.62f, 0.45f, 0.27f), 0.5f));
  const std::uint32_t dark =
      builder.add_mesh("dark piece", piece, add_lens_material(builder, "walnut", vec3(0.12f, 0.05f, 0.03f), 0.4f));
  const std::uint32_t red =
      builder.add_mesh("red piece", piece, add_lens_material(builder, "lacquer", vec3(0.55f, 0.03f, 0.03f), 0.3f));
  constexpr std::array<dvec3, 7> kPlaces = {{{-0.33, 0.0, 1.1},
                                             {0.27, 0.0, 0.75},
                                             {-0.3, 0.0, 0.4},
                                             {0.42, 0.0, -0.6},
                                             {-0.45, 0.0, -1.3},
                                             {0.2, 0.0, -2.2},
                                             {0.75, 0.0, -3.2}}};
  builder.add_instance("piece at the focus", red, {0.0, 0.0, 0.0});
  for (std::size_t i = 0; i < kPlaces.size(); ++i)
    builder.add_instance("piece " + std::to_string(i), i % 2 == 0 ? light : dark, kPlaces[i]);
}

/// A table with inlaid strips, a wire close to the camera, and a lattice far behind.
void add_lens_room(SceneBuilder& builder) {
  const std::uint32_t oak = add_lens_material(builder, "oak", vec3(0.3f, 0.2f, 0.12f), 0.6f);
  const std::uint32_t ebony = add_lens_material(builder, "ebony", vec3(0.03f, 0.03f, 0.03f), 0.5f);
  const std::uint32_t steel = add_lens_material(builder, "steel", vec3(0.5f, 0.52f, 0.55f), 0.4f);
  const std::uint32_t wall = add_lens_material(builder, "wall", vec3(0.08f, 0.1f, 0.16f), 0.9f);
  builder.add_instance("table", builder.add_mesh("table", box_shape({4.0f, 0.1f, 7.0f}), oak), {0.0, -0.1, -1.2});
  const std::uint32_t strip = builder.add_mesh("strip", box_shape({4.0f, 0.004f, 0.1f}), ebony);
  for (int i = 0; i < 16; ++i) builder.add_instance("strip", strip, {0.0, 0.0, 1.6 - 0.4 * i});
  builder.add_instance("wire", builder.add_mesh("wire", box_shape({0.008f, 1.2f, 0.008f}), steel), {0.12, 0.0, 1.7});
  const std::uint32_t bar = builder.add_mesh("bar", box_shape({0.05f, 3.0f, 0.05f}), steel);
  for (int i = 0; i < 13; ++i) builder.add_instance("bar", bar, {-2.4 + 0.4 * i, -0.1, -6.0});
  builder.add_instance("wall", builder.add_mesh("wall", box_shape({24.0f, 9.0f, 0.2f}), wall), {0.0, -2.0, -16.0});
}

/// Bulbs with a radius of 1 cm: rows at five distances behind the focus, and two before it.
void add_bulbs(SceneBuilder& builder) {
  const Primitive ball = sphere_shape(0.01f, 16);
  constexpr std::array<vec3, 3> kColors = {{{1.0f, 0.62f, 0.28f}, {0.5f, 0.75f, 1.0f}, {1.0f, 0.3f, 0.25f}}};
  std::array<std::uint32_t, 3> bulbs{};
  for (std::size_t i = 0; i < kColors.size(); ++i) {
    Material glow{.name = "glow", .base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f), .metallic = 0.0f, .roughness = 1.0f};
    glow.emissive = kColors[i] * 6000.0f;
    bulbs[i] = builder.add_mesh("bulb", ball, builder.add_material(glow));
  }
  constexpr std::array<double, 5> kDepths = {-1.0, -2.5, -5.0, -9.0, -15.0};
  int number = 0;
  for (const double z : kDepths)
    for (int i = 0; i < 7; ++i, ++number) {
      const double spread = 0.09 * (kEye.z - z), lift = 0.035 * (kEye.z - z);
      builder.add_instance("bulb", bulbs[static_cast<std::size_t>(number) % bulbs.size()],
                           {spread * (i - 3) + 0.3 * z / 7.0, 0.2 + lift + 0.05 * ((number * 5) % 7), z});
    }
  builder.add_instance("near bulb", bulbs[0], {-0.2, 0.42, 1.5});
  builder.add_instance("near bulb", bulbs[1], {0.26, 0.35, 1.3});
}

void add_lens_lights(SceneBuilder& builder) {
  Light key;
  key.kind = LightKind::spot;
  key.color = vec3(1.0f, 0.86f, 0.7f);
  key.intensity = 2400.0f;
  key.range_m = 20.0f;
  key.inner_angle = 0.5f;
  key.outer_angle = 0.7f;
  key.width_m = 0.3f;
  builder.add_light("key", key, {-2.6, 3.6, 2.6}, {0.6, -0.75, -0.85}, true);
  Light rim;
  rim.kind = LightKind::directional;
  rim.color = vec3(0.6f, 0.72f, 1.0f);
  rim.intensity = 24.0f;
  builder.add_light("rim", rim, {0.0, 4.0, -4.0}, {-0.5, -0.6, 0.5}, false);
}

}  // namespace

void build_lens_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  add_lens_room(builder);
  add_pieces(builder);
  add_bulbs(builder);
  add_lens_lights(builder);
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
    const Entity camera = builder.add_camera(bokeh == Bokeh::round ? "round" : "hexagonal", kEye, kTarget, kFov);
    world.add<DepthOfField>(camera, {.focus_m = kFocus_m, .f_number = kFNumber, .bokeh = bokeh});
  }
  builder.add_camera("sharp", kEye, kTarget, kFov);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.4f, 0.5f, 0.8f);
  environment.sky_horizon = vec3(1.0f, 0.9f, 1.1f);
  environment.sky_ground = vec3(0.3f);
  environment.has_exposure = true;
  environment.exposure_ev100 = 6.5f;
  info.name = "lens";
}

}  // namespace gloam
