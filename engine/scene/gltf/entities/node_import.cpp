// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/entities/node_import.h"

#include <cmath>
#include <limits>
#include <string>

#include "engine/math/world_box.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/gltf/place.h"
#include "engine/scene/resources.h"

namespace gloam::gltf {
namespace {

/// Depths of a perspective camera are near / depth: with less, those of far surfaces are no normal floats.
constexpr double kLeastNear_m = 1e-20;

Result<Camera> import_camera(const CameraSource& source) {
  Camera camera;
  camera.orthographic = source.orthographic;
  const auto refuse = [](const char* fault) { return Error{ErrorKind::input, fault}; };
  if (source.orthographic) {
    camera.half_width_m = static_cast<float>(std::fabs(source.xmag));
    camera.half_height_m = static_cast<float>(std::fabs(source.ymag));
    if (!(camera.half_width_m > 0.0f && camera.half_height_m > 0.0f) ||
        !std::isfinite(camera.half_width_m + camera.half_height_m))
      return refuse("xmag and ymag must not be 0");
    if (source.znear < 0.0) return refuse("znear must be ≥ 0");
  } else {
    camera.fov_y = static_cast<float>(source.yfov);  // rounding may give 0 or π
    if (!(camera.fov_y > 0.0f && camera.fov_y < kPi)) return refuse("yfov must be in 0…π");
    if (!(static_cast<float>(source.znear) > 0.0f)) return refuse("znear must be > 0");
    if (source.znear < kLeastNear_m) return refuse("znear must be at least 1e-20: depths would be 0");
  }
  camera.near_m = static_cast<float>(source.znear);
  const bool endless = !source.orthographic && source.zfar > double{std::numeric_limits<float>::max()};
  camera.far_m = endless ? 0.0f : static_cast<float>(source.zfar);
  if (!std::isfinite(camera.near_m + camera.far_m)) return refuse("znear and zfar are too large");
  const bool infinite = (source.zfar == 0.0 && !source.orthographic) || endless;
  if (!infinite && !(camera.far_m > camera.near_m)) return refuse("zfar must be larger than znear");
  return camera;
}

/// The node's name, or `other`, the name of its mesh or camera, if it has none.
const std::string& name_or(const NodeSource& node, const std::string& other) {
  return node.name.empty() ? other : node.name;
}

class NodeImporter {
 public:
  NodeImporter(Document& document, std::span<const std::uint32_t> joint_counts, World& world)
      : document_(document), joint_counts_(joint_counts), world_(world) {}

  Status add_mesh(std::uint32_t index, Entity entity) {
    const NodeSource& node = document_.nodes[index];
    const MeshSource& mesh = document_.meshes[node.mesh];
    MeshInstance instance{node.mesh, kNone};
    const std::uint32_t joints = joint_counts_[node.mesh];
    if (node.skin != kNone && joints > 0) {
      const std::size_t there = document_.skins[node.skin].joints.size();
      if (joints > there)
        return fault_at(place("node", index, node.name), "its mesh names joint " + std::to_string(joints - 1) +
                                                             ", but its skin has " + std::to_string(there));
      instance.skin = node.skin;
    } else if (node.skin != kNone) {
      document_.warnings.push_back(place("node", index, node.name) +
                                   ": its mesh has no joints, its skin moves nothing");
    }
    world_.add(entity, instance);
    const bool unnamed = node.parent != kNone && document_.nodes[node.parent].instance_count > 0 &&
                         index >= document_.nodes[node.parent].first_instance;
    if (const std::string& name = name_or(node, mesh.name); !name.empty() && !unnamed)
      world_.resource<SceneNames>().add("mesh", name, entity);
    add_morphs(node, mesh, entity);
    return {};
  }

  Status add_camera(std::uint32_t index, Entity entity) {
    const NodeSource& node = document_.nodes[index];
    const CameraSource& source = document_.cameras[node.camera];
    const Result<Camera> camera = import_camera(source);
    if (!camera) return fault_at(place("camera", node.camera, source.name), camera.error().message);
    world_.add(entity, *camera);
    if (const std::string& name = name_or(node, source.name); !name.empty())
      world_.resource<SceneNames>().add("camera", name, entity);
    return {};
  }

 private:
  void add_morphs(const NodeSource& node, const MeshSource& mesh, Entity entity) {
    const std::size_t targets = mesh.primitives.empty() ? 0 : mesh.primitives[0].targets.size();
    if (targets == 0) return;
    std::vector<float>& values = world_.resource<MorphWeights>().values;
    const MorphInstance morph{static_cast<std::uint32_t>(values.size()), static_cast<std::uint32_t>(targets)};
    const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
    for (std::size_t i = 0; i < targets; ++i)
      values.push_back(i < weights.size() ? static_cast<float>(weights[i]) : 0.0f);
    world_.add(entity, morph);
  }

  Document& document_;
  std::span<const std::uint32_t> joint_counts_;
  World& world_;
};

/// Bounds of all meshes at rest.
WorldBox scene_box(const Document& document, const SceneNodeOrder& nodes, const std::vector<dmat4>& worlds,
                   const std::vector<Mesh>& meshes) {
  WorldBox all;
  for (const std::uint32_t i : nodes.order) {
    if (document.nodes[i].mesh == kNone) continue;
    const WorldBox box = world_box(meshes[document.nodes[i].mesh].bounds, worlds[i]);
    if (!box.known()) continue;
    all.min = glm::min(all.min, box.min);
    all.max = glm::max(all.max, box.max);
  }
  return all;
}

/// Greatest distance of the box's corners along the view direction of a node.
double farthest_depth(const WorldBox& box, const dmat4& world_from_camera) {
  const dvec3 back(world_from_camera[2]);
  const double length = glm::length(back);
  if (!box.known() || !(length > 0.0)) return 0.0;
  const dvec3 corner = glm::mix(box.min, box.max, glm::lessThan(back, dvec3(0.0)));
  return -glm::dot(corner - dvec3(world_from_camera[3]), back) / length;
}

/// Warns of the first perspective camera that sees meshes beyond its zfar. Exporters write a zfar for every camera, so
/// one that cuts nothing off is no news.
void warn_of_zfar(Document& document, const SceneNodeOrder& nodes, const std::vector<dmat4>& worlds,
                  const WorldBox& box) {
  for (const std::uint32_t i : nodes.order) {
    if (document.nodes[i].camera == kNone) continue;
    const CameraSource& source = document.cameras[document.nodes[i].camera];
    if (source.orthographic || !(source.zfar > 0.0) || !(farthest_depth(box, worlds[i]) > source.zfar)) continue;
    document.warnings.push_back(place("camera", document.nodes[i].camera, source.name) +
                                ": its zfar is ignored, perspective cameras see to any distance");
    return;
  }
}

}  // namespace

Result<std::vector<Entity>> import_nodes(Document& document, const SceneNodeOrder& nodes,
                                         std::span<const std::uint32_t> joint_counts, World& world) {
  const Result<std::vector<dmat4>> worlds = compose_node_worlds(document, nodes);
  if (!worlds) return worlds.error();
  std::vector<Entity> entities(document.nodes.size(), kNoEntity);
  for (std::uint32_t i = 0; i < entities.size(); ++i) {
    if (!nodes.used[i]) continue;
    const NodeSource& node = document.nodes[i];
    entities[i] = world.create(SourceNode{i}, node.pose, WorldTransform{(*worlds)[i]});
    if (node.matrix) world.add(entities[i], LocalMatrix{*node.matrix});
    if (!node.name.empty()) world.resource<SceneNames>().add("node", node.name, entities[i]);
  }
  NodeImporter importer(document, joint_counts, world);
  for (std::uint32_t i = 0; i < entities.size(); ++i) {
    if (!nodes.used[i]) continue;
    const NodeSource& node = document.nodes[i];
    if (node.parent != kNone) world.add(entities[i], Parent{entities[node.parent], nodes.depth[i]});
    if (node.mesh != kNone) GLOAM_TRY(importer.add_mesh(i, entities[i]));
    if (node.camera != kNone) GLOAM_TRY(importer.add_camera(i, entities[i]));
  }
  warn_of_zfar(document, nodes, *worlds, scene_box(document, nodes, *worlds, world.resource<SceneAssets>().meshes));
  return entities;
}

}  // namespace gloam::gltf
