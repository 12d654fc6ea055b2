// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/systems.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/assert.h"
#include "engine/ecs/world.h"
#include "engine/scene/assets.h"
#include "engine/scene/posing/morphing.h"
#include "engine/scene/posing/skinning.h"

namespace gloam {
namespace {

constexpr std::size_t kChannelsPerJob = 64;
constexpr std::size_t kInstancesPerJob = 4;

/// Reads the SourceNode components again if rows were added, moved or marked as changed.
void refresh_nodes(const View<const SourceNode>& sources, SceneNodes& nodes) {
  bool changed = false;
  nodes.seen =
      sources.changed_since<const SourceNode>(nodes.seen, [&](std::span<const SourceNode>) { changed = true; });
  if (!changed) return;
  nodes.entities.clear();
  sources.each([&](Entity entity, const SourceNode& source) {
    if (source.index >= nodes.entities.size()) nodes.entities.resize(source.index + 1, kNoEntity);
    nodes.entities[source.index] = entity;
  });
  ++nodes.version;
}

void set_pose(LocalTransform& pose, AnimationPath path, std::span<const double> value) {
  switch (path) {
    case AnimationPath::translation:
      pose.translation = dvec3(value[0], value[1], value[2]);
      break;
    case AnimationPath::rotation:
      pose.rotation = dquat(value[3], value[0], value[1], value[2]);
      break;
    case AnimationPath::scale:
      pose.scale = dvec3(value[0], value[1], value[2]);
      break;
    case AnimationPath::weights:
      break;
  }
}

struct SkinnedInstance {
  Entity entity;
  std::uint32_t skin = 0;
};

std::vector<SkinnedInstance> skinned_instances(const View<const MeshInstance>& instances) {
  std::vector<SkinnedInstance> skinned;
  instances.each([&](Entity entity, const MeshInstance& instance) {
    if (instance.skin != kNone) skinned.push_back({entity, instance.skin});
  });
  std::ranges::sort(skinned, {}, [](const SkinnedInstance& s) { return s.entity.index; });
  return skinned;
}

dmat4 world_or(const View<const WorldTransform>& worlds, Entity entity, const dmat4& otherwise) {
  const WorldTransform* world = worlds.try_get<const WorldTransform>(entity);
  return world != nullptr ? world->matrix : otherwise;
}

}  // namespace

std::string absent_mesh(Entity entity, std::uint32_t mesh, std::size_t meshes) {
  return text_of(entity) + " names mesh " + std::to_string(mesh) + ", and SceneAssets has " + std::to_string(meshes) +
         " meshes";
}

void add_scene_systems(Schedule& schedule) {
  schedule.add_system("animation", "engine", Stage::world, &animation_system);
  schedule.add_system("transforms", "engine", Stage::world, &transform_system);
  schedule.add_system("camera_poses", "engine", Stage::world, &camera_pose_system);
  schedule.add_system("joint_matrices", "engine", Stage::world, &joint_system);
  schedule.add_system("morph_weights", "engine", Stage::world, &morph_system);
}

void animation_system(View<const SourceNode> sources, View<LocalTransform> poses, Resource<const SceneAssets> assets,
                      Resource<const SceneClock> clock, Resource<SceneNodes> nodes,
                      Resource<AnimationBindings> bindings, JobExecutor& jobs) {
  refresh_nodes(sources, *nodes);
  if (bindings->nodes_version != nodes->version || bindings->assets_version != assets->version) {
    bind_animations(assets->clips, *nodes, *bindings);
    bindings->nodes_version = nodes->version;
    bindings->assets_version = assets->version;
  }
  // Channels of the same node write different members of its pose, so they may run at the same time.
  jobs.parallel_for(bindings->poses.size(), kChannelsPerJob, [&](JobRange range) {
    for (const AnimationBinding& binding : std::span(bindings->poses).subspan(range.begin, range.end - range.begin)) {
      LocalTransform* pose = poses.try_get<LocalTransform>(binding.entity);
      if (pose == nullptr) continue;
      const AnimationClip& clip = assets->clips[binding.clip];
      const AnimationChannel& channel = clip.channels[binding.channel];
      std::array<double, 4> value{};
      GLOAM_ASSERT(channel.width == (channel.path == AnimationPath::rotation ? 4u : 3u),
                   "a pose channel is 3 or 4 wide");
      const std::span<double> used(value.data(), channel.width);
      sample_channel(channel, looped_time(clock->time_s, double{clip.duration_s}), used);
      set_pose(*pose, channel.path, used);
      poses.mark_changed<LocalTransform>(binding.entity);
    }
  });
}

void camera_pose_system(View<const Camera, const WorldTransform> cameras, Resource<CameraPoses> poses) {
  std::vector<CameraPoses::Row> rows;  // without cameras that are gone
  cameras.each([&](Entity entity, const Camera&, const WorldTransform& world) {
    if (const std::optional<dmat4> pose = rigid_pose(world.matrix))
      rows.push_back({entity, *pose});
    else if (const dmat4* last = poses->find(entity))
      rows.push_back({entity, *last});
  });
  std::ranges::sort(rows, {}, [](const CameraPoses::Row& row) { return row.camera.index; });
  poses->rows = std::move(rows);
}

void joint_system(View<const MeshInstance> instances, View<const WorldTransform> worlds,
                  Resource<const SceneAssets> assets, Resource<const SceneNodes> nodes, Resource<JointMatrices> joints,
                  JobExecutor& jobs) {
  const std::vector<SkinnedInstance> skinned = skinned_instances(instances);
  joints->ranges.clear();
  std::uint32_t total = 0;
  for (const SkinnedInstance& instance : skinned) {
    GLOAM_ASSERT(instance.skin < assets->skins.size(), text_of(instance.entity) + " names skin " +
                                                           std::to_string(instance.skin) + ", and SceneAssets has " +
                                                           std::to_string(assets->skins.size()) + " skins");
    const auto count = static_cast<std::uint32_t>(assets->skins[instance.skin].joint_nodes.size());
    joints->ranges.push_back({.instance = instance.entity, .first = total, .count = count});
    total += count;
  }
  joints->matrices.resize(total);

  jobs.parallel_for(skinned.size(), kInstancesPerJob, [&](JobRange range) {
    std::vector<dmat4> joint_worlds;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Skin& skin = assets->skins[skinned[i].skin];
      const dmat4 instance_world = world_or(worlds, skinned[i].entity, dmat4(1.0));
      joint_worlds.clear();
      for (const std::uint32_t node : skin.joint_nodes)
        joint_worlds.push_back(world_or(worlds, nodes->find(node), instance_world));
      JointMatrices::Range& out = joints->ranges[i];
      const auto matrices = std::span(joints->matrices).subspan(out.first, out.count);
      const SkinPlacement placement = place_joints(joint_worlds, skin.inverse_bind, instance_world, matrices);
      out.origin = placement.origin;
      out.mirrored = placement.mirrored;
    }
  });
}

void morph_system(View<const MeshInstance, MorphInstance> instances, Resource<const SceneAssets> assets,
                  Resource<const SceneClock> clock, Resource<const AnimationBindings> bindings,
                  Resource<MorphWeights> weights) {
  std::vector<std::pair<Entity, MorphRow>> rows;
  instances.each([&](Entity entity, const MeshInstance& mesh, MorphInstance& instance) {
    GLOAM_ASSERT(mesh.mesh < assets->meshes.size(), absent_mesh(entity, mesh.mesh, assets->meshes.size()));
    rows.push_back({entity, {.instance = &instance, .mesh = &assets->meshes[mesh.mesh]}});
  });
  std::ranges::sort(rows, {}, [](const auto& row) { return row.first.index; });
  std::vector<MorphRow> ordered;
  ordered.reserve(rows.size());
  for (const auto& row : rows) ordered.push_back(row.second);
  if (lay_out_morph_weights(ordered, weights->values)) instances.mark_changed<MorphInstance>();

  std::vector<double> sampled;
  for (const AnimationBinding& binding : bindings->weights) {
    const MorphInstance* instance = instances.try_get<MorphInstance>(binding.entity);
    if (instance == nullptr) continue;
    const AnimationClip& clip = assets->clips[binding.clip];
    const AnimationChannel& channel = clip.channels[binding.channel];
    sampled.assign(channel.width, 0.0);
    sample_channel(channel, looped_time(clock->time_s, double{clip.duration_s}), sampled);
    const std::size_t count = std::min<std::size_t>(channel.width, instance->count);
    for (std::size_t i = 0; i < count; ++i) weights->values[instance->first + i] = static_cast<float>(sampled[i]);
  }
}

}  // namespace gloam
