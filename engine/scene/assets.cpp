// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets.h"

#include <utility>

#include "engine/core/assert.h"

namespace gloam {
namespace {

std::uint64_t at_or_zero(const std::vector<std::uint64_t>& values, std::uint32_t index) {
  return index < values.size() ? values[index] : 0;
}

void put(std::vector<std::uint64_t>& values, std::uint32_t index, std::uint64_t value) {
  if (index >= values.size()) values.resize(std::size_t{index} + 1, 0);
  values[index] = value;
}

}  // namespace

const char* name_of(AssetKind kind) {
  constexpr const char* kNames[] = {"mesh", "material", "texture", "image"};
  return kNames[static_cast<std::size_t>(kind)];
}

template <class T>
std::uint32_t SceneAssets::add_to(std::vector<T>& list, AssetKind kind, T asset) {
  Changes& changes = of(kind);
  std::uint32_t index = static_cast<std::uint32_t>(list.size());
  std::erase_if(changes.free, [&](std::uint32_t place) { return place >= list.size(); });  // the list was shortened
  if (changes.free.empty()) {
    list.push_back(std::move(asset));
  } else {
    index = changes.free.back();
    changes.free.pop_back();
    list[index] = std::move(asset);
  }
  put(changes.revisions, index, ++revision_);
  return index;
}

std::uint32_t SceneAssets::add(Mesh mesh) { return add_to(meshes, AssetKind::mesh, std::move(mesh)); }
std::uint32_t SceneAssets::add(Material material) {
  return add_to(materials, AssetKind::material, std::move(material));
}
std::uint32_t SceneAssets::add(Texture texture) { return add_to(textures, AssetKind::texture, std::move(texture)); }
std::uint32_t SceneAssets::add(Image image) { return add_to(images, AssetKind::image, std::move(image)); }

std::size_t SceneAssets::count(AssetKind kind) const {
  const std::size_t counts[] = {meshes.size(), materials.size(), textures.size(), images.size()};
  return counts[static_cast<std::size_t>(kind)];
}

void SceneAssets::check_exists(AssetKind kind, std::uint32_t index) const {
  const std::string asset = std::string(name_of(kind)) + " " + std::to_string(index);
  GLOAM_ASSERT(index < count(kind), asset + " does not exist: there are " + std::to_string(count(kind)));
  GLOAM_ASSERT(!is_destroyed(kind, index), asset + " was destroyed");
}

void SceneAssets::mark_changed(AssetKind kind, std::uint32_t index) {
  check_exists(kind, index);
  put(of(kind).revisions, index, ++revision_);
}

void SceneAssets::destroy(AssetKind kind, std::uint32_t index) {
  check_exists(kind, index);
  switch (kind) {
    case AssetKind::mesh:
      meshes[index] = {};
      break;
    case AssetKind::material:
      materials[index] = {};
      break;
    case AssetKind::texture:
      textures[index] = {};
      break;
    case AssetKind::image:
      images[index] = {};
      break;
  }
  put(of(kind).revisions, index, ++revision_);
  put(of(kind).destroyed_at, index, revision_);
  of(kind).free.push_back(index);
}

bool SceneAssets::is_destroyed(AssetKind kind, std::uint32_t index) const {
  const std::uint64_t at = destroyed_at(kind, index);
  return at != 0 && at == revision(kind, index);
}

std::uint64_t SceneAssets::revision(AssetKind kind, std::uint32_t index) const {
  return at_or_zero(of(kind).revisions, index);
}

std::uint64_t SceneAssets::destroyed_at(AssetKind kind, std::uint32_t index) const {
  return at_or_zero(of(kind).destroyed_at, index);
}

}  // namespace gloam
