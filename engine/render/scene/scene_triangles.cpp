// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/scene/scene_triangles.h"

#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"

namespace gloam {

std::uint64_t instance_triangles(const World& world) {
  const std::vector<Mesh>& meshes = world.resource<SceneAssets>().meshes;
  std::vector<std::uint64_t> triangles(meshes.size(), 0);
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (const Primitive& primitive : meshes[m].primitives) triangles[m] += primitive.indices.size() / 3;
  std::uint64_t sum = 0;
  world.view<const MeshInstance>().each([&](Entity, const MeshInstance& instance) {
    if (instance.mesh < triangles.size()) sum += triangles[instance.mesh];
  });
  return sum;
}

}  // namespace gloam
