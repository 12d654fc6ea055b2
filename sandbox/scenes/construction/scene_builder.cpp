// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/construction/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "engine/core/assert.h"
#include "engine/scene/resources.h"
#include "modules/shadows/components.h"

namespace gloam {

std::uint32_t SceneBuilder::add_material(const Material& material) {
  auto& materials = world_.resource<SceneAssets>().materials;
  materials.push_back(material);
  return static_cast<std::uint32_t>(materials.size() - 1);
}

std::uint32_t SceneBuilder::add_plain(const std::string& name, vec3 color, float roughness, float metallic) {
  return add_material({.name = name, .base_color = vec4(color, 1.0f), .metallic = metallic, .roughness = roughness});
}

std::uint32_t SceneBuilder::add_glow(const std::string& name, vec3 luminance) {
  return add_material({.name = name,
                       .base_color = vec4(0.02f, 0.02f, 0.02f, 1.0f),
                       .emissive = luminance,
                       .metallic = 0.0f,
                       .roughness = 1.0f});
}

std::uint32_t SceneBuilder::add_mesh(const std::string& name, Primitive shape, std::uint32_t material) {
  auto& meshes = world_.resource<SceneAssets>().meshes;
  shape.material = material;
  Mesh mesh;
  mesh.name = name;
  mesh.bounds = shape.bounds;
  mesh.primitives.push_back(std::move(shape));
  meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(meshes.size() - 1);
}

Entity SceneBuilder::add_instance(const std::string& name, std::uint32_t mesh, dvec3 position, double heading,
                                  dvec3 scale) {
  const dquat rotation(std::cos(heading * 0.5), 0.0, std::sin(heading * 0.5), 0.0);
  const Entity entity = add_node("mesh", name, {.translation = position, .rotation = rotation, .scale = scale});
  world_.add<MeshInstance>(entity, {.mesh = mesh});
  for (const Primitive& primitive : world_.resource<SceneAssets>().meshes[mesh].primitives)
    info_.triangles += primitive.indices.size() / 3;
  return entity;
}

Entity SceneBuilder::add_group(const std::string& name, dvec3 position, double heading) {
  const dquat rotation(std::cos(heading * 0.5), 0.0, std::sin(heading * 0.5), 0.0);
  return add_node("node", name, {.translation = position, .rotation = rotation});
}

Entity SceneBuilder::add_camera(const std::string& name, dvec3 eye, dvec3 target, float fov_y) {
  const Entity entity = add_node("camera", name, {.translation = eye, .rotation = rotation_towards(target - eye)});
  world_.add<Camera>(entity, {.fov_y = fov_y});
  info_.cameras.push_back(entity);
  return entity;
}

Entity SceneBuilder::add_light(const std::string& name, const Light& light, dvec3 position, dvec3 direction,
                               bool casts_shadows) {
  const Entity entity = add_node("light", name, {.translation = position, .rotation = rotation_towards(direction)});
  world_.add<Light>(entity, light);
  if (!casts_shadows) world_.add<ShadowCaster>(entity, {.enabled = false});
  return entity;
}

void SceneBuilder::add_clip(const std::string& name, Entity node, std::span<const PoseKey> keys) {
  GLOAM_ASSERT(!keys.empty() && keys.front().time_s == 0.0, "the first key of a clip is at time 0");
  const auto place = std::ranges::find(info_.node_entities, node);
  GLOAM_ASSERT(place != info_.node_entities.end(), "an animated node is one of this builder's");
  const auto index = static_cast<std::uint32_t>(place - info_.node_entities.begin());
  if (!world_.has<SourceNode>(node)) world_.add<SourceNode>(node, {.index = index});

  AnimationChannel translation{.node = index, .path = AnimationPath::translation, .width = 3};
  AnimationChannel rotation{.node = index, .path = AnimationPath::rotation, .width = 4};
  for (const PoseKey& key : keys) {
    const auto time_s = static_cast<float>(key.time_s);
    translation.times.push_back(time_s);
    rotation.times.push_back(time_s);
    const dvec3& t = key.translation;
    const dquat& r = key.rotation;
    for (const double value : {t.x, t.y, t.z}) translation.values.push_back(static_cast<float>(value));
    for (const double value : {r.x, r.y, r.z, r.w}) rotation.values.push_back(static_cast<float>(value));
  }
  AnimationClip clip{.name = name, .duration_s = translation.times.back(), .channels = {}};
  clip.channels.push_back(std::move(translation));
  clip.channels.push_back(std::move(rotation));
  world_.resource<SceneAssets>().clips.push_back(std::move(clip));
}

Entity SceneBuilder::add_node(const char* kind, const std::string& name, const LocalTransform& local) {
  const Entity entity = world_.create(local, WorldTransform{});
  world_.resource<SceneNames>().add(kind, name, entity);
  info_.node_entities.push_back(entity);
  return entity;
}

dquat rotation_towards(dvec3 direction) {
  const dvec3 back = -glm::normalize(direction);
  const dvec3 up = std::abs(back.y) > 0.999 ? dvec3(0.0, 0.0, -1.0) : dvec3(0.0, 1.0, 0.0);
  const dvec3 right = glm::normalize(glm::cross(up, back));
  return glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)));
}

}  // namespace gloam
