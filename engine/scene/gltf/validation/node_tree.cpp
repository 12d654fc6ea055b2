// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <vector>

#include "engine/scene/gltf/place.h"
#include "engine/scene/gltf/validation/document_check.h"

namespace gloam::gltf {
namespace {

std::string node_place(const Document& document, std::uint32_t i) { return place("node", i, document.nodes[i].name); }

Status find_parents(Document& document) {
  for (std::uint32_t i = 0; i < document.nodes.size(); ++i) {
    for (const std::uint32_t child : document.nodes[i].children) {
      std::uint32_t& parent = document.nodes[child].parent;
      if (parent != kNone)
        return fault_at(node_place(document, child),
                        "it is a child of node " + std::to_string(parent) + " and again of node " + std::to_string(i));
      parent = i;
    }
  }
  return {};
}

/// Each node has at most one parent, so a node that cannot be reached from a root is in or below a cycle.
Status refuse_cycles(const Document& document) {
  std::vector<bool> reached(document.nodes.size());
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < document.nodes.size(); ++i)
    if (document.nodes[i].parent == kNone) open.push_back(i);
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    reached[node] = true;
    open.insert(open.end(), document.nodes[node].children.begin(), document.nodes[node].children.end());
  }
  for (std::uint32_t i = 0; i < document.nodes.size(); ++i)
    if (!reached[i])
      return fault_at(node_place(document, i), "it is its own ancestor or below one: a cycle of children");
  return {};
}

Status check_scene_roots(const Document& document, std::size_t index) {
  const SceneSource& scene = document.scenes[index];
  std::vector<bool> listed(document.nodes.size());
  for (const std::uint32_t node : scene.nodes) {
    const NodeSource& root = document.nodes[node];
    if (root.parent != kNone)
      return fault_at(
          place("scene", index, scene.name),
          "node " + std::to_string(node) + " is not a root, it is a child of node " + std::to_string(root.parent));
    if (listed[node])
      return fault_at(place("scene", index, scene.name), "it lists node " + std::to_string(node) + " twice");
    listed[node] = true;
  }
  return {};
}

Status check_links(const Document& document, std::uint32_t index) {
  const NodeSource& node = document.nodes[index];
  if (node.weights.empty()) return {};
  std::size_t targets = 0;
  if (node.mesh != kNone && !document.meshes[node.mesh].primitives.empty())
    targets = document.meshes[node.mesh].primitives[0].targets.size();
  if (node.weights.size() != targets)
    return fault_at(node_place(document, index), "it has " + std::to_string(node.weights.size()) +
                                                     " weights, but its mesh has " + std::to_string(targets) +
                                                     " morph targets");
  return {};
}

}  // namespace

Status check_node_tree(Document& document) {
  GLOAM_TRY(find_parents(document));
  GLOAM_TRY(refuse_cycles(document));
  for (std::size_t i = 0; i < document.scenes.size(); ++i) GLOAM_TRY(check_scene_roots(document, i));
  for (std::uint32_t i = 0; i < document.nodes.size(); ++i) GLOAM_TRY(check_links(document, i));
  return {};
}

}  // namespace gloam::gltf
