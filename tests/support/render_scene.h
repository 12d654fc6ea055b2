// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <utility>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"

/// Small scenes built in code, for tests of rendering.
namespace gloam::test {

/// Completes a primitive: computes its bounds, and sets indices 0, 1, 2, … if it has none.
[[nodiscard]] inline Primitive finished(Primitive primitive) {
  if (primitive.indices.empty())
    for (std::uint32_t i = 0; i < primitive.positions.size(); ++i) primitive.indices.push_back(i);
  primitive.bounds = {};
  for (const vec3& position : primitive.positions) primitive.bounds.grow(position);
  return primitive;
}

/// A square in the XY plane around the origin that faces +Z; texture coordinates run 0…1 from the upper left, tangent
/// +X.
[[nodiscard]] inline Primitive quad(float half, std::uint32_t material = kNone) {
  Primitive p;
  p.material = material;
  p.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  p.normals.assign(4, vec3(0.0f, 0.0f, 1.0f));
  p.tangents.assign(4, vec4(1.0f, 0.0f, 0.0f, 1.0f));
  p.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  p.indices = {0, 1, 2, 0, 2, 3};
  return finished(std::move(p));
}

/// A box around the origin, counter-clockwise seen from outside. Faces do not share vertices.
[[nodiscard]] inline Primitive box(vec3 half, std::uint32_t material = kNone) {
  Primitive p;
  p.material = material;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {1.0f, -1.0f}) {
      vec3 normal(0.0f), u(0.0f), v(0.0f);
      normal[axis] = side;
      u[(axis + 1) % 3] = side;
      v[(axis + 2) % 3] = 1.0f;
      const auto first = static_cast<std::uint32_t>(p.positions.size());
      for (const vec3 corner : {normal - u - v, normal + u - v, normal + u + v, normal - u + v}) {
        p.positions.push_back(corner * half);
        p.normals.push_back(normal);
      }
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + i);
    }
  }
  return finished(std::move(p));
}

/// A ball around the origin with smooth normals, of `round` columns and `high` rows of facets.
[[nodiscard]] inline Primitive round_ball(float radius, std::uint32_t round, std::uint32_t high,
                                          std::uint32_t material = kNone) {
  Primitive p;
  p.material = material;
  for (std::uint32_t row = 0; row <= high; ++row)
    for (std::uint32_t column = 0; column <= round; ++column) {
      const float up = 3.14159265f * static_cast<float>(row) / static_cast<float>(high);
      const float about = 6.28318531f * static_cast<float>(column % round) / static_cast<float>(round);
      const vec3 normal(std::sin(up) * std::sin(about), std::cos(up), std::sin(up) * std::cos(about));
      p.positions.push_back(normal * radius);
      p.normals.push_back(normal);
    }
  for (std::uint32_t row = 0; row < high; ++row)
    for (std::uint32_t column = 0; column < round; ++column) {
      const std::uint32_t a = row * (round + 1) + column, b = a + round + 1;
      for (const std::uint32_t i : {a, b, b + 1, a, b + 1, a + 1}) p.indices.push_back(i);
    }
  return finished(std::move(p));
}

/// Fills a world that prepare_scene_world (or Renderer::prepare_world) has prepared.
class SceneMaker {
 public:
  explicit SceneMaker(World& world) : world_(world) {}

  [[nodiscard]] SceneAssets& assets() { return world_.resource<SceneAssets>(); }

  std::uint32_t material(Material material) { return add(assets().materials, std::move(material)); }
  std::uint32_t mesh(Primitive primitive) {
    Mesh mesh;
    mesh.bounds = primitive.bounds;
    mesh.primitives.push_back(std::move(primitive));
    return add(assets().meshes, std::move(mesh));
  }
  /// A texture with a new image, without filtering.
  std::uint32_t texture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> rgba, bool srgb) {
    Image image{"test", width, height, std::move(rgba)};
    Texture texture;
    texture.name = "test";
    texture.image = add(assets().images, std::move(image));
    texture.srgb = srgb;
    texture.nearest = true;
    texture.wrap_u = texture.wrap_v = WrapMode::clamp_to_edge;
    return add(assets().textures, std::move(texture));
  }
  Entity draw(std::uint32_t mesh_index, const dmat4& world_from_mesh = dmat4(1.0)) {
    return world_.create(WorldTransform{world_from_mesh}, MeshInstance{mesh_index});
  }
  /// An entity with a world matrix and the index of a source node, e.g. a joint.
  Entity node(std::uint32_t index, const dmat4& matrix) {
    return world_.create(WorldTransform{matrix}, SourceNode{index});
  }

 private:
  template <class T>
  std::uint32_t add(std::vector<T>& list, T item) {
    list.push_back(std::move(item));
    ++assets().version;
    return static_cast<std::uint32_t>(list.size()) - 1;
  }
  World& world_;
};

[[nodiscard]] inline ViewSettings look_at(const dvec3& eye, const dvec3& target, std::uint32_t width,
                                          std::uint32_t height) {
  ViewSettings settings;
  settings.width = width;
  settings.height = height;
  // Uses the offset to the target only: a look-at matrix in world coordinates would lose digits far from the origin.
  settings.world_from_camera = glm::inverse(glm::lookAt(dvec3(0.0), target - eye, dvec3(0.0, 1.0, 0.0)));
  settings.world_from_camera[3] = dvec4(eye, 1.0);
  return settings;
}

}  // namespace gloam::test
