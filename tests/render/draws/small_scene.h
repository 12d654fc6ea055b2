// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "modules/lights/components.h"
#include "tests/support/render_scene.h"

namespace gloam::test {

/// A bar of 5 sections along Y (0…4 m, 1 m wide), wound counter-clockwise. It follows joint 0 below 2 m and joint 1
/// above.
[[nodiscard]] inline Primitive skinned_bar(std::uint32_t material = kNone) {
  Primitive p;
  p.material = material;
  const vec2 around[] = {{-0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, -0.5f}, {-0.5f, -0.5f}};
  for (std::uint32_t ring = 0; ring < 5; ++ring) {
    for (const vec2 side : around) {
      const auto height = static_cast<float>(ring);
      p.positions.push_back({side.x, height, side.y});
      p.normals.push_back(glm::normalize(vec3(side.x, 0.0f, side.y)));
      const float upper = height < 2.0f ? 0.0f : height > 2.0f ? 1.0f : 0.5f;
      p.joints.push_back({0, 1, 0, 0});
      p.weights.push_back({1.0f - upper, upper, 0.0f, 0.0f});
    }
  }
  for (std::uint32_t ring = 0; ring < 4; ++ring) {
    for (std::uint32_t side = 0; side < 4; ++side) {
      const std::uint32_t a = 4 * ring + side, b = 4 * ring + (side + 1) % 4;
      for (const std::uint32_t i : {a, b, b + 4, a, b + 4, a + 4}) p.indices.push_back(i);
    }
  }
  return finished(std::move(p));
}

/// Adds a skin of two joints with world matrices `lower` and `upper`, at glTF nodes `first_node` and `first_node` + 1.
/// Its inverse bind matrices are those of joints at heights of 0 and 2 m. Returns the skin's index.
inline std::uint32_t two_joint_skin(World& world, std::uint32_t first_node, const dmat4& lower, const dmat4& upper) {
  SceneMaker scene(world);
  Skin skin;
  skin.joint_nodes = {first_node, first_node + 1};
  skin.inverse_bind = {mat4(1.0f), glm::translate(mat4(1.0f), vec3(0.0f, -2.0f, 0.0f))};
  scene.node(first_node, lower);
  scene.node(first_node + 1, upper);
  scene.assets().skins.push_back(std::move(skin));
  return static_cast<std::uint32_t>(scene.assets().skins.size()) - 1;
}

/// Fills the world with one of everything that can be drawn, around the origin and within 10 m: a floor, boxes,
/// textured, alpha-masked and blended quads, a bent bar, a morphed quad. No lights.
inline void fill_small_scene(World& world) {
  SceneMaker scene(world);
  const auto at = [](double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); };

  Material textured;
  textured.base_color_texture.texture =
      scene.texture(2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 0}, true);
  Material bumpy = textured;
  bumpy.normal_texture.texture =
      scene.texture(3, 1, {128, 128, 255, 255, 200, 128, 220, 255, 60, 128, 220, 255}, false);
  Material cut_out = textured;
  cut_out.alpha_mode = AlphaMode::mask;
  cut_out.double_sided = true;
  Material glass;
  glass.base_color = vec4(0.2f, 0.4f, 0.8f, 0.5f);
  glass.alpha_mode = AlphaMode::blend;
  glass.metallic = 0.0f;

  scene.draw(scene.mesh(box(vec3(5.0f, 0.1f, 5.0f))), at(0, -1, 0));
  const std::uint32_t cube = scene.mesh(box(vec3(0.5f), scene.material(textured)));
  scene.draw(cube, at(-2, 0, 0));
  scene.draw(cube, at(-2, 1.5, 0) * glm::scale(dmat4(1.0), dvec3(-1.0, 1.0, 1.0)));
  scene.draw(scene.mesh(quad(0.5f, scene.material(bumpy))), at(-1, 0, 1));
  scene.draw(scene.mesh(quad(0.5f, scene.material(cut_out))), at(0, 0.5, 2));
  scene.draw(scene.mesh(quad(1.0f, scene.material(glass))), at(0, 0, 2.5));

  const std::uint32_t skin =
      two_joint_skin(world, 0, at(2, -1, 0), at(2, 1, 0) * glm::rotate(dmat4(1.0), 0.6, dvec3(0, 0, 1)));
  world.create(WorldTransform{}, MeshInstance{scene.mesh(skinned_bar()), skin});

  Primitive flag = quad(0.5f);
  flag.morph_targets = {{std::vector<vec3>(4, vec3(0, 0.5f, 0)), std::vector<vec3>(4, vec3(0.2f, 0, 0))}};
  const std::uint32_t flag_mesh = scene.mesh(flag);
  scene.assets().meshes[flag_mesh].morph_weights = {0.5f};
  world.create(WorldTransform{at(3, 0, 1)}, MeshInstance{flag_mesh}, MorphInstance{});
}

/// Adds a point light and a sun.
inline std::vector<Entity> add_lights(World& world) {
  Light lamp;
  lamp.intensity = 100.0f;
  Light sun;
  sun.kind = LightKind::directional;
  sun.intensity = 50.0f;
  const dmat4 down = glm::rotate(dmat4(1.0), -1.0, dvec3(1.0, 0.0, 0.0));
  return {world.create(WorldTransform{glm::translate(dmat4(1.0), dvec3(1.0, 3.0, 3.0))}, lamp),
          world.create(WorldTransform{down}, sun)};
}

}  // namespace gloam::test
