// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/scene_surfaces.h"

#include <algorithm>
#include <span>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/posing/animated_nodes.h"
#include "engine/scene/units.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

struct Instance {
  Entity entity;
  const Mesh* mesh = nullptr;
  dmat4 world_from_mesh = dmat4(1.0);
};

std::vector<Instance> gather_instances(const World& world, const SceneAssets& assets) {
  const AnimatedNodes animated(world);
  const double metres = 1.0 / scene_unit(world);
  std::vector<Instance> instances;
  world.view<const MeshInstance, const WorldTransform>().each(
      [&](Entity entity, const MeshInstance& drawn, const WorldTransform& transform) {
        if (drawn.mesh >= assets.meshes.size() || drawn.skin != kNone || animated.moves(entity)) return;
        instances.push_back({entity, &assets.meshes[drawn.mesh], metric_matrix(transform.matrix, metres)});
      });
  std::ranges::sort(instances, [](const Instance& a, const Instance& b) { return a.entity.index < b.entity.index; });
  return instances;
}

/// As shaders derive it, without textures.
float reflectivity_of(const Material& material) {
  if (material.reflectivity >= 0.0f) return material.reflectivity;
  return (1.0f - material.roughness) * (0.5f + 0.5f * material.metallic);
}

FitTriangles place_triangles(const Primitive& primitive, const dmat4& world_from_mesh, bool double_sided) {
  FitTriangles placed;
  placed.double_sided = double_sided;
  placed.positions.reserve(primitive.positions.size());
  for (const vec3& p : primitive.positions) placed.positions.emplace_back(world_from_mesh * dvec4(dvec3(p), 1.0));
  // A mirrored instance swaps the winding of its fronts.
  const bool mirrored =
      glm::dot(dvec3(world_from_mesh[0]), glm::cross(dvec3(world_from_mesh[1]), dvec3(world_from_mesh[2]))) < 0.0;
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const auto corners = std::span(primitive.indices).subspan(i, 3);
    if (std::ranges::any_of(corners, [&](std::uint32_t c) { return c >= placed.positions.size(); })) continue;
    placed.indices.insert(placed.indices.end(), {corners[0], corners[mirrored ? 2 : 1], corners[mirrored ? 1 : 2]});
  }
  return placed;
}

void append_up(const FitTriangles& triangles, std::vector<UpTriangle>& up) {
  for (std::size_t i = 0; i < triangles.indices.size(); i += 3) {
    UpTriangle triangle;
    for (std::size_t c = 0; c < 3; ++c) triangle.corners[c] = triangles.positions[triangles.indices[i + c]];
    up.push_back(triangle);
  }
}

}  // namespace

SceneSurfaces gather_surfaces(const World& world) {
  const auto& assets = world.resource<SceneAssets>();
  const Material none;
  SceneSurfaces surfaces;
  for (const Instance& instance : gather_instances(world, assets)) {
    for (const Primitive& primitive : instance.mesh->primitives) {
      const Material& material =
          primitive.material < assets.materials.size() ? assets.materials[primitive.material] : none;
      if (material.alpha_mode == AlphaMode::blend || !primitive.morph_targets.empty()) continue;
      FitTriangles placed = place_triangles(primitive, instance.world_from_mesh, material.double_sided);
      append_up(placed, surfaces.ground);
      if (reflectivity_of(material) >= kLeastReflectivity) append_up(placed, surfaces.reflective);
      surfaces.instances.push_back(std::move(placed));
    }
  }
  return surfaces;
}

}  // namespace gloam
