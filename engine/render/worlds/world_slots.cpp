// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/worlds/world_slots.h"

#include <span>
#include <string>

#include "engine/ecs/view.h"

namespace gloam {

std::uint64_t world_id(const World& world) {
  const WorldSlot* slot = world.try_resource<WorldSlot>();
  GLOAM_ASSERT(slot != nullptr, "a world must be prepared by the renderer that draws it (Renderer::prepare_world)");
  return slot->id;
}

void WorldSlots::take(World& world, std::uint64_t frames) {
  const auto token = std::make_shared<const WorldToken>();
  worlds_[next_id_] = token;
  world.set_resource(WorldSlot{.id = next_id_++, .frames = frames, .renderer = token_, .token = token});
}

void WorldSlots::take_over(World& world) {
  const WorldSlot* slot = world.try_resource<WorldSlot>();
  if (slot != nullptr && slot->renderer.expired()) take(world, slot->frames);
}

bool WorldSlots::has(const World& world) const {
  const WorldSlot* slot = world.try_resource<WorldSlot>();
  return slot != nullptr && slot->renderer.lock() == token_;
}

const WorldSlot& WorldSlots::slot_of(const World& world) const {
  const WorldSlot* slot = world.try_resource<WorldSlot>();
  GLOAM_ASSERT(slot != nullptr, "a world must be prepared by the renderer that draws it (Renderer::prepare_world)");
  GLOAM_ASSERT(slot->renderer.lock() == token_,
               "the world was prepared by another renderer: each renderer draws the worlds that it has prepared");
  return *slot;
}

GpuScene& WorldSlots::scene_of(const World& world) {
  std::unique_ptr<GpuScene>& scene = scenes_[slot_of(world).id];
  if (scene == nullptr) scene = std::make_unique<GpuScene>(device_, pipelines_, uploads_);
  return *scene;
}

std::optional<Oversight> WorldSlots::find_absent_mesh(const World& world) {
  const SceneAssets& assets = world.resource<SceneAssets>();
  const std::size_t meshes = assets.meshes.size();
  CheckedInstances& checked = checked_[slot_of(world).id];
  if (meshes < checked.meshes || assets.revision() != checked.revision) checked.tick = 0;
  checked.meshes = meshes;
  checked.revision = assets.revision();
  std::optional<Oversight> absent;
  const auto check = [&](std::span<const Entity> entities, std::span<const MeshInstance> instances) {
    for (std::size_t i = 0; i < instances.size() && !absent; ++i) {
      const std::uint32_t mesh = instances[i].mesh;
      const bool destroyed = mesh < meshes && assets.is_destroyed(AssetKind::mesh, mesh);
      if (mesh < meshes && !destroyed) continue;
      absent = Oversight{entities[i], "has a MeshInstance of mesh " + std::to_string(mesh) +
                                          (destroyed ? ", which was destroyed: it is not drawn"
                                                     : ", and SceneAssets has " + std::to_string(meshes) +
                                                           " meshes: it is not drawn")};
    }
  };
  checked.tick = world.view<const MeshInstance>().changed_since<const MeshInstance>(checked.tick, check);
  return absent;
}

std::vector<std::uint64_t> WorldSlots::lost() const {
  std::vector<std::uint64_t> ids;
  for (const auto& [id, token] : worlds_)
    if (token.expired()) ids.push_back(id);
  return ids;
}

void WorldSlots::release(std::uint64_t id) {
  scenes_.erase(id);
  checked_.erase(id);
}

void WorldSlots::remove(std::uint64_t id) {
  release(id);
  worlds_.erase(id);
}

}  // namespace gloam
