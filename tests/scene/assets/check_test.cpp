// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets/check.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "engine/scene/assets/mesh_builder.h"

namespace gloam {
namespace {

/// A triangle with one material, texture and image.
SceneAssets sound_assets() {
  SceneAssets assets;
  Mesh mesh{.name = "leaf", .primitives = {}, .morph_weights = {}, .bounds = {}};
  Primitive& primitive = mesh.primitives.emplace_back();
  primitive.positions = {vec3(0.0f), vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f)};
  primitive.uv0 = {vec2(0.0f), vec2(1.0f, 0.0f), vec2(0.0f, 1.0f)};
  primitive.material = 0;
  assets.images.push_back({.name = "bark", .width = 1, .height = 2, .rgba = std::vector<std::uint8_t>(8, 255)});
  assets.textures.push_back({.name = "rough bark", .image = 0});
  assets.materials.push_back({.name = "wood"});
  assets.materials[0].normal_texture.texture = 0;
  complete_mesh(mesh, assets);
  assets.meshes.push_back(std::move(mesh));
  return assets;
}

TEST(AssetFault, sound_assets_have_none) {
  EXPECT_EQ(asset_fault(sound_assets()), "");
  EXPECT_EQ(asset_fault(SceneAssets{}), "");
  SceneAssets empty = sound_assets();
  empty.meshes[0].primitives[0] = {};
  empty.meshes.emplace_back();
  EXPECT_EQ(asset_fault(empty), "") << "a mesh without triangles draws nothing";
}

TEST(AssetFault, names_what_is_wrong) {
  using Break = std::function<void(SceneAssets&, Primitive&)>;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::pair<Break, const char*>> cases = {
      {[](auto&, auto& p) { p.normals.clear(); }, "primitive 0 of mesh 0 ('leaf') has no normals"},
      {[](auto&, auto& p) { p.normals.pop_back(); }, "has 2 normals for 3 positions"},
      {[](auto&, auto& p) { p.tangents.emplace_back(); }, "has 4 tangents for 3 positions"},
      {[](auto&, auto& p) { p.uv0.pop_back(); }, "has 2 texture coordinates for 3 positions"},
      {[](auto&, auto& p) { p.uv1.emplace_back(); }, "has 1 second texture coordinates for 3 positions"},
      {[](auto&, auto& p) { p.colors.emplace_back(); }, "has 1 colours for 3 positions"},
      {[](auto&, auto& p) { p.joints.resize(3); }, "has joints without weights"},
      {[](auto&, auto& p) { p.joints.resize(2), p.weights.resize(3); }, "has 2 joints for 3 positions"},
      {[](auto&, auto& p) { p.morph_targets.emplace_back().positions.resize(1); }, "has 1 offsets of a morph target"},
      {[](auto&, auto& p) { p.indices.pop_back(); }, "has 2 indices, which are no triangles"},
      {[](auto&, auto& p) { p.indices[1] = 3; }, "has the index 3 for 3 positions"},
      {[=](auto&, auto& p) { p.positions[2].y = nan; }, "has a position that is not finite"},
      {[](auto&, auto& p) { p.bounds = {}; }, "has no bounds"},
      {[=](auto&, auto& p) { p.bounds.max.x = 1.0f / 0.0f; }, "has bounds that are not finite"},
      {[](auto&, auto& p) { p.material = 1; }, "has the material 1 of 1"},
      {[](auto& a, auto&) { a.meshes[0].bounds = {}; }, "mesh 0 ('leaf') has no bounds"},
      {[](auto& a, auto&) { a.materials[0].emissive_texture.texture = 7; },
       "material 0 ('wood') has the texture 7 of 1"},
      {[](auto& a, auto&) { a.materials[0].normal_texture.uv_set = 2; },
       "material 0 ('wood') has a texture with the coordinate set 2"},
      {[](auto& a, auto&) { a.textures[0].image = 1; }, "texture 0 ('rough bark') has the image 1 of 1"},
      {[](auto& a, auto&) { a.images[0].rgba.pop_back(); }, "image 0 ('bark') has 7 bytes for 1x2 pixels of 4 bytes"},
      {[](auto& a, auto&) { a.images[0].height = 0; }, "image 0 ('bark') has no pixels"},
  };
  for (const auto& [broken, sentence] : cases) {
    SceneAssets assets = sound_assets();
    broken(assets, assets.meshes[0].primitives[0]);
    EXPECT_THAT(asset_fault(assets), testing::HasSubstr(sentence));
  }
}

}  // namespace
}  // namespace gloam
