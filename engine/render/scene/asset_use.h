// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/scene/gpu_materials.h"
#include "engine/scene/assets.h"

namespace gloam {

/// What a frame uses.
struct MeshesInUse {
  std::vector<bool> meshes;  ///< by mesh of SceneAssets: whether a MeshInstance or PreloadedMeshes names it
  bool ages = true;          ///< the frame is no redraw
};
[[nodiscard]] MeshesInUse meshes_in_use(const World& world);

/// Which meshes and images of a world belong on the GPU: those in use, and those that were in use in the last
/// kFramesUntilRelease frames. The images in use are those that the materials of meshes in use show.
class AssetUse {
 public:
  /// Once for each frame. Returns whether the answers below may have changed.
  bool update(const SceneAssets& assets, MeshesInUse frame);

  [[nodiscard]] bool has_mesh(std::uint32_t mesh) const { return mesh < idle_.size() && idle_[mesh] != kReleased; }
  [[nodiscard]] bool has_image(const ImageKey& image) const { return images_.contains(image); }

 private:
  static constexpr std::uint32_t kReleased = ~0u;
  void find_images(const SceneAssets& assets);

  std::vector<bool> meshes_;                  ///< in use
  std::vector<std::uint32_t> idle_;           ///< by mesh: frames since it was in use, or kReleased
  std::map<ImageKey, std::uint32_t> images_;  ///< frames since it was in use
  std::set<ImageKey> images_in_use_;
  std::uint64_t version_ = 0;  ///< of SceneAssets; 0: nothing was seen
  std::uint64_t revision_ = 0;
  std::array<std::size_t, 3> sizes_{};  ///< numbers of meshes, materials and textures
  bool some_idle_ = false;
};

}  // namespace gloam
