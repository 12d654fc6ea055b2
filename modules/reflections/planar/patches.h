// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Surfaces whose heights differ by at most this many scene_unit()s count as one plane.
inline constexpr double kPlaneThickness = 0.02;

/// A horizontal, up-facing mirror-like part of a mesh instance.
struct MirrorPatch {
  dvec3 min = dvec3(0.0);  ///< bounds in the world; max.y − min.y ≤ kPlaneThickness scene_unit()s
  dvec3 max = dvec3(0.0);
  double height_m = 0.0;    ///< mean by area
  double mirrors_m2 = 0.0;  ///< area, weighted by how much of a mirror the material is; > 0
};

/// The patches of a world, a resource of it.
class MirrorPatches {
 public:
  /// Brings the patches up to date. Instances are looked at again when their transform, their mesh, one of its
  /// materials or the version of SceneAssets has changed; those that are skinned or morphed have no patches.
  void update(const World& world);
  [[nodiscard]] std::span<const MirrorPatch> all() const { return all_; }
  /// The number of instances that updates have looked at.
  [[nodiscard]] std::uint64_t searched() const { return searched_; }

 private:
  struct Instance {
    Entity entity = kNoEntity;
    std::uint32_t mesh = 0;
    dmat4 world_from_mesh = dmat4(1.0);
    std::vector<MirrorPatch> patches;
  };
  /// Finds out which meshes have changed and which are mirrors. Returns whether patches may differ.
  [[nodiscard]] bool update_meshes(const SceneAssets& assets);

  double unit_ = 1.0;                  ///< scene_unit() of the last update
  std::uint64_t version_ = 0;          ///< of SceneAssets; 0: none
  std::uint64_t revision_ = 0;         ///< of SceneAssets
  std::vector<std::uint8_t> mirrors_;  ///< by mesh: 1 if it has a mirror-like material
  std::vector<std::uint8_t> changed_;  ///< by mesh: 1 if its patches must be found again, in the last update
  std::vector<Instance> instances_;    ///< in the order of the last update
  std::vector<MirrorPatch> all_;
  std::uint64_t searched_ = 0;
};

}  // namespace gloam
