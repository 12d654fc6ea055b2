// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/entities/poses.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>
#include <string>

#include "engine/scene/gltf/place.h"
#include "engine/scene/transforms.h"

namespace gloam::gltf {
namespace {

/// Largest difference between entries of the linear parts, relative to the longest column of `a`.
double difference(const dmat4& a, const dmat4& b) {
  double largest = 0.0;
  double length = 0.0;
  for (int column = 0; column < 3; ++column) {
    length = std::max(length, glm::length(dvec3(a[column])));
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::fabs(a[column][row] - b[column][row]));
  }
  return largest / length;
}

/// The pose that gives this matrix, up to the rounding of floats; empty if there is none.
std::optional<LocalTransform> decompose(const dmat4& matrix) {
  constexpr double kTolerance = 1e-5;
  LocalTransform pose;
  pose.translation = dvec3(matrix[3]);
  glm::dmat3 rotation(matrix);
  for (int column = 0; column < 3; ++column) {
    pose.scale[column] = glm::length(rotation[column]);
    if (!(pose.scale[column] > 0.0)) return std::nullopt;
    rotation[column] /= pose.scale[column];
  }
  if (glm::determinant(rotation) < 0.0) {
    pose.scale.x = -pose.scale.x;
    rotation[0] = -rotation[0];
  }
  pose.rotation = glm::normalize(glm::quat_cast(rotation));
  if (difference(matrix, local_matrix(pose)) > kTolerance) return std::nullopt;
  return pose;
}

std::string node_place(const Document& document, std::size_t i) { return place("node", i, document.nodes[i].name); }

bool finite_in_float(const dmat4& matrix) {
  for (int i = 0; i < 16; ++i)
    if (!(std::fabs(matrix[i / 4][i % 4]) <= static_cast<double>(std::numeric_limits<float>::max()))) return false;
  return true;
}

}  // namespace

Status resolve_poses(Document& document) {
  for (std::size_t i = 0; i < document.nodes.size(); ++i) {
    NodeSource& node = document.nodes[i];
    const double length = glm::length(node.pose.rotation);
    if (!(length > 0.0) || !std::isfinite(length))
      return fault_at(node_place(document, i), "its rotation has no length");
    node.pose.rotation /= length;
    if (!node.matrix) continue;
    const dmat4& matrix = *node.matrix;
    if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0)
      return fault_at(node_place(document, i), "the last row of its matrix must be 0, 0, 0, 1");
    if (!finite_in_float(matrix)) return fault_at(node_place(document, i), "its matrix is too large");
    if (const std::optional<LocalTransform> pose = decompose(matrix)) {
      node.pose = *pose;
      node.matrix.reset();
    }
  }
  return {};
}

Result<SceneNodeOrder> select_scene(const Document& document, int wanted) {
  SceneNodeOrder nodes;
  if (wanted >= 0 && static_cast<std::size_t>(wanted) >= document.scenes.size())
    return Error{ErrorKind::usage, "scene " + std::to_string(wanted) + " is asked for, but there are " +
                                       std::to_string(document.scenes.size())};
  if (wanted >= 0)
    nodes.scene = static_cast<std::uint32_t>(wanted);
  else if (!document.scenes.empty())
    nodes.scene = document.default_scene == kNone ? 0 : document.default_scene;
  if (nodes.scene != kNone) {
    nodes.order = document.scenes[nodes.scene].nodes;
  } else {
    for (std::uint32_t i = 0; i < document.nodes.size(); ++i)
      if (document.nodes[i].parent == kNone) nodes.order.push_back(i);
  }
  nodes.used.resize(document.nodes.size());
  nodes.depth.resize(document.nodes.size());
  for (std::size_t i = 0; i < nodes.order.size(); ++i) {
    const std::uint32_t node = nodes.order[i];
    nodes.used[node] = true;
    for (const std::uint32_t child : document.nodes[node].children) {
      nodes.depth[child] = nodes.depth[node] + 1;
      nodes.order.push_back(child);
    }
  }
  return nodes;
}

Result<std::vector<dmat4>> compose_node_worlds(const Document& document, const SceneNodeOrder& nodes) {
  std::vector<dmat4> worlds(document.nodes.size(), dmat4(1.0));
  for (const std::uint32_t i : nodes.order) {
    const NodeSource& node = document.nodes[i];
    const dmat4 local = node.matrix ? *node.matrix : local_matrix(node.pose);
    worlds[i] = node.parent == kNone ? local : worlds[node.parent] * local;
    if (!finite_in_float(worlds[i])) return fault_at(node_place(document, i), "its transform is not finite");
  }
  return worlds;
}

}  // namespace gloam::gltf
