// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/scene/asset_use.h"

#include <algorithm>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/render/renderer_options.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"

namespace gloam {

MeshesInUse meshes_in_use(const World& world) {
  std::vector<bool> meshes(world.resource<SceneAssets>().meshes.size(), false);
  const auto use = [&](std::uint32_t mesh) {
    if (mesh < meshes.size()) meshes[mesh] = true;
  };
  world.view<const MeshInstance>().each([&](const MeshInstance& instance) { use(instance.mesh); });
  if (const PreloadedMeshes* preloaded = world.try_resource<PreloadedMeshes>())
    std::ranges::for_each(preloaded->meshes, use);
  return {std::move(meshes)};
}

void AssetUse::find_images(const SceneAssets& assets) {
  images_in_use_.clear();
  for (std::size_t m = 0; m < assets.meshes.size(); ++m) {
    if (!meshes_[m]) continue;
    for (const Primitive& primitive : assets.meshes[m].primitives) {
      if (primitive.material >= assets.materials.size()) continue;
      for (const TextureSlot* slot : texture_slots(assets.materials[primitive.material])) {
        if (slot->texture >= assets.textures.size()) continue;
        const Texture& texture = assets.textures[slot->texture];
        if (texture.image != kNone) images_in_use_.insert(key_of(texture));
      }
    }
  }
}

bool AssetUse::update(const SceneAssets& assets, MeshesInUse frame) {
  const std::array sizes = {assets.meshes.size(), assets.materials.size(), assets.textures.size()};
  const bool same_assets = version_ == assets.version && revision_ == assets.revision() && sizes_ == sizes;
  if (same_assets && !some_idle_ && frame.meshes == meshes_) return false;
  meshes_ = std::move(frame.meshes);
  meshes_.resize(assets.meshes.size(), false);
  find_images(assets);
  version_ = assets.version;
  revision_ = assets.revision();
  sizes_ = sizes;
  some_idle_ = false;

  bool changed = !same_assets;
  const std::uint32_t age = frame.ages ? 1 : 0;
  idle_.resize(meshes_.size(), kReleased);
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    std::uint32_t& idle = idle_[m];
    if (meshes_[m]) {
      changed = changed || idle == kReleased;
      idle = 0;
    } else if (idle != kReleased && (idle += age) >= kFramesUntilRelease) {
      changed = true;
      idle = kReleased;
    } else {
      some_idle_ = some_idle_ || idle != kReleased;
    }
  }
  for (auto& [key, idle] : images_) idle = images_in_use_.contains(key) ? 0 : idle + age;
  for (const ImageKey& key : images_in_use_) changed = images_.try_emplace(key, 0).second || changed;
  changed =
      std::erase_if(images_, [](const auto& image) { return image.second >= kFramesUntilRelease; }) > 0 || changed;
  some_idle_ = some_idle_ || images_.size() > images_in_use_.size();
  return changed;
}

}  // namespace gloam
