// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>
#include <utility>

#include "engine/ecs/world.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"

namespace host {

/// A box around the origin. Each face has its own vertices, counter-clockwise seen from outside.
inline gloam::Primitive box(gloam::vec3 half_m, std::uint32_t material) {
  gloam::Primitive p;
  p.material = material;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {1.0f, -1.0f}) {
      gloam::vec3 normal(0.0f), u(0.0f), v(0.0f);
      normal[axis] = side;
      u[(axis + 1) % 3] = side;
      v[(axis + 2) % 3] = 1.0f;
      const auto first = static_cast<std::uint32_t>(p.positions.size());
      for (const gloam::vec3 corner : {normal - u - v, normal + u - v, normal + u + v, normal - u + v}) {
        p.positions.push_back(corner * half_m);
        p.normals.push_back(normal);
      }
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + i);
    }
  }
  for (const gloam::vec3& position : p.positions) p.bounds.grow(position);
  return p;
}

/// A box of the little world.
struct LittleBox {
  gloam::vec3 half_m;
  gloam::vec4 color;  ///< linear
  gloam::dvec3 position;
};
inline const LittleBox kLittleBoxes[] = {
    {{8.0f, 0.1f, 8.0f}, {0.4f, 0.4f, 0.38f, 1.0f}, {0.0, -0.1, 0.0}},
    {{0.5f, 0.5f, 0.5f}, {0.6f, 0.15f, 0.1f, 1.0f}, {-1.2, 0.5, 0.0}},
    {{0.5f, 0.5f, 0.5f}, {0.6f, 0.15f, 0.1f, 1.0f}, {1.4, 0.5, -1.0}},
    {{0.3f, 1.2f, 0.3f}, {0.1f, 0.3f, 0.5f, 1.0f}, {0.2, 1.2, -0.6}},
};
inline constexpr float kLittleRoughness = 0.6f;

struct LittleWorld {
  bool meshes = true;    ///< false: only the lights and the sky
  bool shadows = false;  ///< of the lamp and the sun
};

/// Adds three boxes on a floor, a lamp and a sun. world: prepared by Renderer::prepare_world.
inline void build_little_world(gloam::World& world, const LittleWorld& wanted = {}) {
  auto& assets = world.resource<gloam::SceneAssets>();
  const auto add_mesh = [&](gloam::vec3 half_m, gloam::vec4 color) {
    gloam::Material material;
    material.base_color = color;
    material.metallic = 0.0f;
    material.roughness = kLittleRoughness;
    assets.materials.push_back(material);
    gloam::Mesh mesh;
    mesh.primitives.push_back(box(half_m, static_cast<std::uint32_t>(assets.materials.size() - 1)));
    mesh.bounds = mesh.primitives.front().bounds;
    assets.meshes.push_back(std::move(mesh));
    ++assets.version;
    return static_cast<std::uint32_t>(assets.meshes.size() - 1);
  };
  const auto place = [&](std::uint32_t mesh, gloam::dvec3 position) {
    world.create(gloam::LocalTransform{.translation = position}, gloam::WorldTransform{}, gloam::MeshInstance{mesh});
  };
  for (const LittleBox& b : kLittleBoxes)
    if (wanted.meshes) place(add_mesh(b.half_m, b.color), b.position);

  gloam::Light lamp;
  lamp.color = gloam::vec3(1.0f, 0.7f, 0.4f);
  lamp.intensity = 300.0f;
  world.create(gloam::LocalTransform{.translation = gloam::dvec3(0.0, 1.5, 1.5)}, gloam::WorldTransform{}, lamp,
               gloam::ShadowCaster{.enabled = wanted.shadows});
  gloam::Light sun;
  sun.kind = gloam::LightKind::directional;
  sun.intensity = 2000.0f;
  // A directional light shines along the node's −Z; this rotation turns it to the left, then down.
  const gloam::dquat turn = gloam::dquat(0.866, 0.0, 0.5, 0.0) * gloam::dquat(0.966, -0.259, 0.0, 0.0);
  world.create(gloam::LocalTransform{.rotation = turn}, gloam::WorldTransform{}, sun,
               gloam::ShadowCaster{.enabled = wanted.shadows});
  auto& environment = world.resource<gloam::SceneEnvironment>();
  environment.sky_zenith = gloam::vec3(20.0f, 35.0f, 70.0f);
  environment.sky_horizon = gloam::vec3(90.0f, 60.0f, 45.0f);
}

}  // namespace host
