// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/keys.h"

#include <string>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/scene/keys/table.h"
#include "engine/scene/resources.h"
#include "modules/grass/components.h"
#include "modules/grass/drawing/textures.h"
#include "modules/grass/growth/blade_types.h"

namespace gloam {
namespace {

Status check_grass(World& world) {
  GLOAM_TRY(at_most_one(world.view<const Wind>().size(), "gloam.wind"));
  Status status;
  world.view<const GrassSurface>().each([&](const GrassSurface& surface) {
    const std::string& file = world.resource<SceneStrings>().text(surface.types);
    if (file.empty() || !status.ok()) return;
    if (const auto types = read_blade_types(file); !types.ok()) status = types.error();
  });
  GLOAM_TRY(status);
  return load_blade_textures(world);
}

}  // namespace

void add_grass_keys(KeyRegistry& registry) {
  const auto grass = [](std::string key, std::string fallback, std::string unit, std::string meaning) {
    return key_line("grass", KeyElement::mesh_node, std::move(key), std::move(fallback), std::move(unit),
                    std::move(meaning));
  };
  const auto node = [](std::string key, std::string fallback, std::string unit, std::string meaning) {
    return key_line("grass", KeyElement::node, std::move(key), std::move(fallback), std::move(unit),
                    std::move(meaning));
  };
  registry.add(number_key(grass("gloam.grass.density", "0", "blades/m²", "density of grass on upward-facing triangles"),
                          0, 1e6, &GrassSurface::density));
  registry.add(integer_key(grass("gloam.grass.seed", "1", "", "random seed"), 0, 4294967295.0, &GrassSurface::seed));
  registry.add(vec2_key(grass("gloam.grass.height", "[0.3, 0.06]", "m", "mean and deviation of the height of blades"),
                        0, 100, &GrassSurface::height_m));
  registry.add(
      number_key(grass("gloam.grass.width", "0.006", "m", "width of a blade"), 1e-6, 10, &GrassSurface::width_m));
  registry.add(number_key(grass("gloam.grass.damping", "1.5", "1/s",
                                "damping of the blades' swings, which fall to 1/e in 1 s over this; blade types have a "
                                "factor on it"),
                          0, 1000, &GrassSurface::damping));
  registry.add(number_key(grass("gloam.grass.max_distance", "40", "m", "quantisation range of the LOD"), 1e-3, 1e6,
                          &GrassSurface::max_distance_m));
  registry.add(file_key(grass("gloam.grass.types", "", "", "file of blade types; default: the five built-in types"),
                        &GrassSurface::types));
  registry.add(file_key(grass("gloam.grass.texture", "", "",
                              "image file of blades, layers side by side, each from root (bottom) to tip; alpha below "
                              "0.5 cuts out; default: procedural colours"),
                        &GrassSurface::texture));
  registry.add(integer_key(grass("gloam.grass.texture_layers", "", "",
                                 "layers in the image; default: how many times it is as wide as high if that is a "
                                 "whole number, else 1"),
                           1, kMostImageLayers, &GrassSurface::texture_layers));
  registry.add(choice_key(node("gloam.collider", "", "", "shape of a collider that moves grass"),
                          {"sphere", "capsule", "box"}, ColliderShape::sphere, &Collider::shape));
  registry.add(number_key(node("gloam.collider.radius", "0.5", "m", "radius of a sphere or capsule"), 1e-6, 1e6,
                          &Collider::radius_m));
  registry.add(number_key(node("gloam.collider.height", "1.8", "m", "height of a capsule, caps included"), 1e-6, 1e6,
                          &Collider::height_m));
  registry.add(vec3_key(node("gloam.collider.size", "[1, 1, 1]", "m", "size of a box"), 1e-6, 1e6, &Collider::size_m));
  registry.add(
      vec3_key(node("gloam.wind.velocity", "[0, 0, 0]", "m/s", "velocity of the wind; at most one node per scene"),
               -200, 200, &Wind::velocity));
  registry.add(number_key(node("gloam.wind.gust", "0.3", "", "strength of gusts"), 0, 1, &Wind::gust));
  registry.add_finish("grass", &check_grass);
}

}  // namespace gloam
