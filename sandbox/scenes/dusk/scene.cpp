// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/dusk/scene.h"

#include <cmath>
#include <string>
#include <utility>

#include "engine/scene/resources.h"
#include "sandbox/scenes/dusk/images.h"
#include "sandbox/scenes/dusk/parts.h"

namespace gloam {
namespace {

std::uint32_t add_dusk_texture(World& world, Image image, bool is_color, WrapMode wrap) {
  auto& assets = world.resource<SceneAssets>();
  Texture texture;
  texture.name = image.name;
  texture.image = static_cast<std::uint32_t>(assets.images.size());
  texture.srgb = is_color;
  texture.wrap_u = wrap;
  texture.wrap_v = wrap;
  assets.images.push_back(std::move(image));
  assets.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(assets.textures.size() - 1);
}

/// Setts of the road and, from the same pictures, slabs of the pavement.
void add_setts(World& world, SceneBuilder& builder, DuskMaterials& m) {
  SettsImages images = setts_images();
  Material setts{.name = "setts", .base_color = vec4(0.70f, 0.70f, 0.74f, 1.0f), .metallic = 1.0f, .roughness = 1.0f};
  setts.base_color_texture.texture = add_dusk_texture(world, std::move(images.color), true, WrapMode::repeat);
  setts.normal_texture.texture = add_dusk_texture(world, std::move(images.normal), false, WrapMode::repeat);
  setts.metallic_roughness_texture.texture =
      add_dusk_texture(world, std::move(images.roughness), false, WrapMode::repeat);
  m.setts = builder.add_material(setts);
  setts.name = "slabs";
  setts.base_color = vec4(1.0f, 0.97f, 0.93f, 1.0f);
  setts.normal_scale = 0.3f;
  m.slabs = builder.add_material(setts);
}

DuskMaterials add_dusk_materials(World& world, SceneBuilder& builder) {
  const auto material = [&](const char* name, vec3 color, float roughness) {
    return builder.add_plain(name, color, roughness);
  };
  const auto glow = [&](const char* name, vec3 luminance) { return builder.add_glow(name, luminance); };
  const auto translucent = [&](const char* name, float extinction_m) {
    Material made{.name = name, .base_color = vec4(1.0f), .metallic = 0.0f, .roughness = 1.0f};
    made.double_sided = true;
    made.subsurface = true;
    made.extinction_m = extinction_m;
    return builder.add_material(made);
  };
  DuskMaterials m{};
  add_setts(world, builder, m);
  m.paving = material("paving", vec3(0.15f, 0.14f, 0.135f), 0.6f);
  m.soil = material("soil", vec3(0.052f, 0.070f, 0.024f), 1.0f);
  m.gravel = material("gravel", vec3(0.30f, 0.245f, 0.175f), 1.0f);
  m.matt = material("matt", vec3(1.0f), 1.0f);
  m.leaf = translucent("leaf", 0.0006f);
  m.canvas = translucent("canvas", 0.0012f);
  m.paper = translucent("paper", 0.001f);
  // A metal mirrors a fifth of the light, more than water does: so that pictures in puddles are seen from above, too.
  Material water{.name = "puddle", .base_color = vec4(0.20f, 0.21f, 0.23f, 1.0f), .metallic = 1.0f, .roughness = 0.03f};
  m.water = builder.add_material(water);
  m.bulb = glow("bulb", kDuskAmber * 40.0f);
  m.small_bulb = glow("small bulb", kDuskWarm * 40.0f);
  m.ember = glow("embers", vec3(3.2f, 0.75f, 0.10f));
  Material glass{.name = "glass", .base_color = vec4(0.9f, 0.92f, 0.95f, 0.16f), .metallic = 0.0f, .roughness = 0.1f};
  glass.alpha_mode = AlphaMode::blend;
  glass.double_sided = true;
  m.glass = builder.add_material(glass);
  return m;
}

/// A dome seen from inside, with the picture of the sky.
Primitive dome_shape() {
  constexpr std::uint32_t kColumns = 48, kRows = 18;
  constexpr float kRadius = 130.0f;
  Primitive out;
  for (std::uint32_t row = 0; row <= kRows; ++row) {
    const float v = static_cast<float>(row) / kRows, elevation = sky_elevation(v);
    for (std::uint32_t column = 0; column <= kColumns; ++column) {
      const float u = static_cast<float>(column) / kColumns, azimuth = 2.0f * kPi * u;
      const vec3 outward(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                         -std::cos(azimuth) * std::cos(elevation));
      out.positions.push_back(kRadius * outward);
      out.normals.push_back(-outward);
      out.uv0.emplace_back(u, v);
      out.bounds.grow(out.positions.back());
    }
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t a = row * (kColumns + 1) + column, b = a + kColumns + 1;
      if (row > 0) out.indices.insert(out.indices.end(), {a, b, a + 1});
      out.indices.insert(out.indices.end(), {a + 1, b, b + 1});
    }
  }
  return out;
}

/// A crescent in the XY plane that faces +Z, with its lit side towards −Y.
Primitive crescent_shape(float radius_m) {
  constexpr std::uint32_t kSteps = 16;
  Primitive out;
  for (std::uint32_t i = 0; i <= kSteps; ++i) {
    const float turn = kPi * static_cast<float>(i) / kSteps;
    for (const float bulge : {1.0f, 0.72f}) {
      out.positions.emplace_back(-radius_m * std::cos(turn), -radius_m * bulge * std::sin(turn), 0.0f);
      out.normals.emplace_back(0.0f, 0.0f, 1.0f);
      out.bounds.grow(out.positions.back());
    }
    if (i == 0) continue;
    const std::uint32_t first = 2 * (i - 1);
    out.indices.insert(out.indices.end(), {first, first + 2, first + 1, first + 1, first + 2, first + 3});
  }
  return out;
}

void add_moon(Dusk& dusk) {
  const std::uint32_t shine = dusk.builder().add_material({.name = "moon",
                                                           .base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f),
                                                           .emissive = vec3(1.5f, 1.35f, 1.05f),
                                                           .metallic = 0.0f,
                                                           .roughness = 1.0f});
  const dvec3 at(22.0, 43.0, -108.0);
  const Entity moon =
      dusk.builder().add_instance("moon", dusk.builder().add_mesh("moon", crescent_shape(1.5f), shine), at);
  dusk.world().get<MeshInstance>(moon).casts_shadows = false;
  dusk.world().get<LocalTransform>(moon).rotation =
      rotation_towards(at) * dquat(std::cos(-0.3), 0.0, 0.0, std::sin(-0.3));
}

void add_sky(Dusk& dusk) {
  Material sky{.name = "sky",
               .base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f),
               .emissive = vec3(kBrightestSky),
               .metallic = 0.0f,
               .roughness = 1.0f};
  sky.emissive_texture.texture = add_dusk_texture(dusk.world(), dusk_sky_image(), true, WrapMode::clamp_to_edge);
  SceneBuilder& builder = dusk.builder();
  const Entity dome =
      builder.add_instance("sky", builder.add_mesh("sky", dome_shape(), builder.add_material(sky)), {0.0, 1.4, 0.0});
  dusk.world().get<MeshInstance>(dome).casts_shadows = false;
  auto& environment = dusk.world().resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.030f, 0.050f, 0.130f);
  environment.sky_horizon = vec3(0.105f, 0.095f, 0.150f);
  environment.sky_ground = vec3(0.016f, 0.014f, 0.014f);
  environment.has_exposure = true;
  environment.exposure_ev100 = -0.25f;
}

/// The street is one room with a probe; another probe shows everything.
void add_dusk_rooms(Dusk& dusk) {
  SceneBuilder& builder = dusk.builder();
  const dvec3 min(kDuskFacadeX - 0.3, -0.1, kDuskNorthZ - 0.3), max(kDuskLawnX, 13.0, kDuskSouthZ + 0.3);
  const Entity room = builder.add_group("room street", 0.5 * (min + max));
  dusk.world().add<IbrRoom>(room, {.size_m = vec3(max - min)});
  ReflectingHeights heights;
  heights.heights_m[0] = 0.0f;
  heights.heights_m[1] = static_cast<float>(kDuskPavementY);
  heights.count = 2;
  dusk.world().add<ReflectingHeights>(room, heights);
  const Entity sky = builder.add_group("probe sky", {0.6, 2.2, -2.0});
  dusk.world().add<CubeProbe>(sky, {.size_m = vec3(0.0f), .resolution = 256, .global = true});
}

}  // namespace

Entity add_dusk_model(Dusk& dusk, const std::string& name, const Model& model, std::uint32_t material, dvec3 position,
                      double heading) {
  return dusk.builder().add_instance(name, dusk.builder().add_mesh(name, model.shape(), material), position, heading);
}

void build_dusk_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  Dusk dusk{{world, builder, add_street_materials(world, builder)}, add_dusk_materials(world, builder)};
  add_dusk_ground(dusk);
  add_dusk_puddles(dusk);
  add_dusk_houses(dusk);
  add_dusk_park(dusk);
  add_dusk_stalls(dusk);
  add_dusk_figures(dusk);
  add_dusk_lights(dusk);
  add_dusk_particles(dusk);
  add_dusk_rooms(dusk);
  add_moon(dusk);
  add_sky(dusk);
  add_dusk_cameras(dusk);
  info.name = "dusk";
}

}  // namespace gloam
