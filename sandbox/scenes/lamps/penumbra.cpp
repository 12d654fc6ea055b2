// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/lamps/penumbra.h"

#include "engine/scene/resources.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

/// The half x < 0 of a square in the XZ plane.
Primitive half_sheet_shape(float half_size_m) {
  Primitive sheet;
  const float s = half_size_m;
  sheet.positions = {{-s, 0, -s}, {-s, 0, s}, {0, 0, s}, {0, 0, -s}};
  sheet.normals.assign(4, vec3(0.0f, 1.0f, 0.0f));
  sheet.indices = {0, 1, 2, 0, 2, 3};
  for (const vec3& position : sheet.positions) sheet.bounds.grow(position);
  return sheet;
}

}  // namespace

void build_penumbra_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  const std::uint32_t floor = builder.add_material(
      {.name = "floor", .base_color = vec4(0.5f, 0.49f, 0.47f, 1.0f), .metallic = 0.0f, .roughness = 0.9f});
  Material paper{.name = "paper", .base_color = vec4(0.6f, 0.3f, 0.2f, 1.0f), .metallic = 0.0f, .roughness = 0.9f};
  paper.double_sided = true;
  const std::uint32_t sheet = builder.add_material(paper);
  builder.add_instance("floor", builder.add_mesh("floor", box_shape({30.0f, 0.2f, 30.0f}), floor), {0.0, -0.2, 0.0});
  builder.add_instance("sheet", builder.add_mesh("sheet", half_sheet_shape(10.0f), sheet), {0.0, 1.0, 0.0});
  Light lamp;
  lamp.kind = LightKind::spot;
  lamp.color = vec3(1.0f, 0.86f, 0.7f);
  lamp.intensity = 3000.0f;
  lamp.range_m = 40.0f;
  lamp.inner_angle = 0.45f;
  lamp.outer_angle = 0.5f;
  lamp.width_m = 0.8f;
  builder.add_light("lamp", lamp, {0.0, kPenumbraLampHeight_m, 0.0}, {0.0, -1.0, 0.0}, true);
  builder.add_camera("main", {1.6, 0.9, 2.2}, {0.0, 0.1, 0.0}, 0.8f);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.05f, 0.07f, 0.12f);
  environment.sky_horizon = vec3(0.1f);
  environment.sky_ground = vec3(0.03f);
  environment.has_exposure = true;
  environment.exposure_ev100 = 4.0f;
  info.name = "penumbra";
}

}  // namespace gloam
