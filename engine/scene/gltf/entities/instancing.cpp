// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/entities/instancing.h"

#include <string>
#include <utility>
#include <vector>

#include "engine/scene/gltf/buffers/accessor_read.h"
#include "engine/scene/gltf/place.h"

namespace gloam::gltf {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

/// Poses of a node's instances; a list is empty or has `count` items.
struct InstancePoses {
  std::size_t count = 0;
  std::vector<vec3> translations;
  std::vector<vec4> rotations;
  std::vector<vec3> scales;
};

Error instancing_fault(std::string sentence) { return {ErrorKind::input, std::move(sentence)}; }

template <class V>
Status read_poses(const Document& document, const char* name, std::uint32_t accessor, std::vector<V>& out,
                  InstancePoses& poses) {
  if (accessor == kNone) return {};
  const Accessor& source = document.accessors[accessor];
  const std::string place_of = std::string(name) + " (" + place("accessor", accessor) + ")";
  if (source.components != static_cast<std::uint32_t>(V::length()))
    return instancing_fault(place_of + " must have " + std::to_string(V::length()) + " components");
  if (poses.count != 0 && source.count != poses.count)
    return instancing_fault(place_of + " has " + std::to_string(source.count) + " elements, but there are " +
                            std::to_string(poses.count) + " instances");
  if (source.count > kMaxNodes)
    return instancing_fault(place_of + " has " + std::to_string(source.count) + " elements, at most " +
                            std::to_string(kMaxNodes) + " are read");
  poses.count = source.count;
  return read_vectors(document, accessor, out);
}

Result<InstancePoses> read_instances(const Document& document, const InstancingSource& source) {
  InstancePoses poses;
  GLOAM_TRY(read_poses(document, "TRANSLATION", source.translation, poses.translations, poses));
  GLOAM_TRY(read_poses(document, "ROTATION", source.rotation, poses.rotations, poses));
  GLOAM_TRY(read_poses(document, "SCALE", source.scale, poses.scales, poses));
  for (const vec4& rotation : poses.rotations)
    if (!(glm::length(dvec4(rotation)) > 0.0)) return instancing_fault("a rotation has no length");
  return poses;
}

NodeSource instance_node(const NodeSource& of, std::uint32_t parent, const InstancePoses& poses, std::size_t i) {
  NodeSource node;
  node.mesh = of.mesh;
  node.weights = of.weights;
  node.parent = parent;
  if (!poses.translations.empty()) node.pose.translation = dvec3(poses.translations[i]);
  if (!poses.scales.empty()) node.pose.scale = dvec3(poses.scales[i]);
  if (!poses.rotations.empty()) {
    const dvec4 r(poses.rotations[i]);
    node.pose.rotation = glm::normalize(dquat(r.w, r.x, r.y, r.z));
  }
  return node;
}

Status expand_node(Document& document, std::uint32_t index) {
  const Result<InstancePoses> poses = read_instances(document, *document.nodes[index].instancing);
  if (!poses) return poses.error();
  if (document.nodes.size() + poses->count > kMaxNodes)
    return instancing_fault("with its instances the file has " + std::to_string(document.nodes.size() + poses->count) +
                            " nodes, at most " + std::to_string(kMaxNodes) + " are read");
  const auto first = static_cast<std::uint32_t>(document.nodes.size());
  for (std::size_t i = 0; i < poses->count; ++i) {
    document.nodes.push_back(instance_node(document.nodes[index], index, *poses, i));
    document.nodes[index].children.push_back(static_cast<std::uint32_t>(first + i));
  }
  NodeSource& node = document.nodes[index];
  node.first_instance = first;
  node.instance_count = static_cast<std::uint32_t>(poses->count);
  node.instanced_mesh = std::exchange(node.mesh, kNone);
  node.weights.clear();
  return {};
}

}  // namespace

Status expand_instances(Document& document) {
  const std::size_t count = document.nodes.size();
  for (std::uint32_t i = 0; i < count; ++i) {
    const NodeSource& node = document.nodes[i];
    if (!node.instancing || node.mesh == kNone) continue;
    const std::string where = place("node", i, node.name) + ", " + kExtension;
    if (node.skin != kNone) {
      document.warnings.push_back(where + ": a mesh with a skin has no instances, it is drawn once");
      continue;
    }
    if (const Status status = expand_node(document, i); !status) return fault_at(where, status.error().message);
  }
  return {};
}

}  // namespace gloam::gltf
