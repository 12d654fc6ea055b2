// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/module.h"
#include "engine/render/scene/gpu_scene.h"
#include "engine/render/worlds/world_id.h"

namespace gloam {

/// Live as long as a renderer, and as a world that a renderer has prepared.
struct RendererToken {};
struct WorldToken {};

/// World resource: the renderer that draws the world, and the world's number there.
struct WorldSlot {
  std::uint64_t id = 0;  ///< world_id()
  /// Frames drawn so far, without those that were given up or drew a frame again. Counted per world, so that pictures
  /// of one world do not depend on others.
  std::uint64_t frames = 0;
  std::weak_ptr<const RendererToken> renderer;  ///< that has prepared the world
  std::shared_ptr<const WorldToken> token;
};

/// The worlds that a renderer has prepared: their numbers and their assets on the GPU.
class WorldSlots {
 public:
  WorldSlots(gpu::Device& device, Pipelines& pipelines, const AssetUploadOptions& uploads)
      : device_(device), pipelines_(pipelines), uploads_(uploads) {}
  WorldSlots(const WorldSlots&) = delete;
  WorldSlots& operator=(const WorldSlots&) = delete;

  /// Gives the world a new number and no drawn frames.
  void add(World& world) { take(world, 0); }
  /// Takes over a world whose renderer has ended; its count of frames goes on. Does nothing to other worlds.
  void take_over(World& world);
  /// Whether this renderer has prepared the world.
  [[nodiscard]] bool has(const World& world) const;
  /// Asserts that this renderer has prepared the world.
  [[nodiscard]] const WorldSlot& slot_of(const World& world) const;

  /// The world's assets on the GPU; created by the first call. Asserts like slot_of.
  [[nodiscard]] GpuScene& scene_of(const World& world);
  [[nodiscard]] bool has_scene(std::uint64_t id) const { return scenes_.contains(id); }
  /// The first MeshInstance, changed since the last call for this world, whose mesh does not exist.
  [[nodiscard]] std::optional<Oversight> find_absent_mesh(const World& world);

  /// The numbers of worlds that were destroyed and not removed, in ascending order.
  [[nodiscard]] std::vector<std::uint64_t> lost() const;
  /// Frees the world's assets on the GPU and what was noted of it. If it is drawn again, they are created again.
  void release(std::uint64_t id);
  /// Releases a world for good: lost() does not name it any more.
  void remove(std::uint64_t id);

 private:
  /// Mesh instances that need no check: those that have not changed since a tick, for a number and a state of meshes.
  struct CheckedInstances {
    Tick tick = 0;
    std::size_t meshes = 0;
    std::uint64_t revision = 0;  ///< SceneAssets::revision()
  };
  void take(World& world, std::uint64_t frames);

  gpu::Device& device_;
  Pipelines& pipelines_;
  AssetUploadOptions uploads_;
  std::shared_ptr<const RendererToken> token_ = std::make_shared<const RendererToken>();
  std::uint64_t next_id_ = 1;
  std::map<std::uint64_t, std::weak_ptr<const WorldToken>> worlds_;
  std::map<std::uint64_t, std::unique_ptr<GpuScene>> scenes_;
  std::map<std::uint64_t, CheckedInstances> checked_;
};

}  // namespace gloam
