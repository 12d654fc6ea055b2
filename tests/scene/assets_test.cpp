// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets.h"

#include <gmock/gmock.h>

#include "engine/scene/assets/check.h"
#include "engine/scene/assets/mesh_builder.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

Mesh triangle(std::uint32_t material = kNone) {
  Mesh mesh;
  Primitive& primitive = mesh.primitives.emplace_back();
  primitive.positions = {vec3(0.0f), vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f)};
  primitive.material = material;
  complete_mesh(mesh, {});
  return mesh;
}

TEST(SceneAssets, every_change_gives_its_asset_a_higher_revision) {
  SceneAssets assets;
  assets.meshes.push_back(triangle());
  EXPECT_EQ(assets.revision(), 0u);
  EXPECT_EQ(assets.revision(AssetKind::mesh, 0), 0u) << "appended without add()";
  EXPECT_EQ(assets.add(triangle()), 1u);
  EXPECT_EQ(assets.add(Material{}), 0u);
  EXPECT_EQ(assets.revision(AssetKind::mesh, 1), 1u);
  EXPECT_EQ(assets.revision(AssetKind::material, 0), 2u);
  assets.mark_changed(AssetKind::mesh, 0);
  EXPECT_EQ(assets.revision(AssetKind::mesh, 0), 3u);
  EXPECT_EQ(assets.revision(AssetKind::mesh, 1), 1u);
  EXPECT_EQ(assets.revision(), 3u);
  EXPECT_EQ(assets.revision(AssetKind::mesh, kNone), 0u) << "an index that is in no list";
}

TEST(SceneAssets, a_destroyed_asset_leaves_a_place_that_the_next_one_takes) {
  SceneAssets assets;
  assets.add(Texture{.name = "a"});
  assets.add(Texture{.name = "b"});
  assets.add(Texture{.name = "c"});
  assets.destroy(AssetKind::texture, 1);
  EXPECT_TRUE(assets.is_destroyed(AssetKind::texture, 1));
  EXPECT_FALSE(assets.is_destroyed(AssetKind::texture, 0));
  EXPECT_EQ(assets.textures[1].name, "");
  EXPECT_EQ(assets.count(AssetKind::texture), 3u);
  EXPECT_EQ(assets.textures[2].name, "c") << "indices stay valid";
  const std::uint64_t destroyed = assets.destroyed_at(AssetKind::texture, 1);
  EXPECT_EQ(assets.add(Texture{.name = "d"}), 1u);
  EXPECT_FALSE(assets.is_destroyed(AssetKind::texture, 1));
  EXPECT_EQ(assets.destroyed_at(AssetKind::texture, 1), destroyed);
  EXPECT_EQ(assets.add(Texture{.name = "e"}), 3u);
}

TEST(SceneAssets, calls_for_assets_that_do_not_exist_are_asserted) {
  SceneAssets assets;
  assets.add(Image{"leaf", 1, 1, {1, 2, 3, 4}});
  EXPECT_ASSERT(assets.mark_changed(AssetKind::image, 1), "image 1 does not exist: there are 1");
  EXPECT_ASSERT(assets.destroy(AssetKind::mesh, 0), "mesh 0 does not exist: there are 0");
  assets.destroy(AssetKind::image, 0);
  EXPECT_ASSERT(assets.mark_changed(AssetKind::image, 0), "image 0 was destroyed");
  EXPECT_ASSERT(assets.destroy(AssetKind::image, 0), "image 0 was destroyed");
}

TEST(SceneAssets, references_to_destroyed_assets_are_faults_until_the_place_is_taken_again) {
  SceneAssets assets;
  const std::uint32_t image = assets.add(Image{"bark", 1, 1, {1, 2, 3, 4}});
  const std::uint32_t texture = assets.add(Texture{.name = "rough", .image = image});
  Material wood{.name = "wood"};
  wood.base_color_texture.texture = texture;
  const std::uint32_t material = assets.add(wood);
  assets.add(triangle(material));
  EXPECT_EQ(asset_fault(assets), "");
  const std::uint64_t before = assets.revision();
  assets.destroy(AssetKind::image, image);
  EXPECT_EQ(asset_fault_since(assets, before), "texture 0 ('rough') has the image 0, which was destroyed");
  EXPECT_EQ(asset_fault(assets), asset_fault_since(assets, before));
  assets.add(Image{"moss", 1, 1, {1, 2, 3, 4}});
  EXPECT_EQ(asset_fault_since(assets, before), "");
  assets.destroy(AssetKind::texture, texture);
  EXPECT_EQ(asset_fault_since(assets, before), "material 0 ('wood') has the texture 0, which was destroyed");
  assets.materials[material].base_color_texture.texture = kNone;
  assets.destroy(AssetKind::material, material);
  EXPECT_EQ(asset_fault_since(assets, before), "primitive 0 of mesh 0 has the material 0, which was destroyed");
  EXPECT_EQ(asset_fault_since(assets, assets.revision()), "") << "nothing has changed since";
}

TEST(SceneAssets, only_what_has_changed_is_checked) {
  SceneAssets assets;
  assets.add(triangle());
  assets.add(triangle());
  const std::uint64_t before = assets.revision();
  assets.meshes[0].primitives[0].normals.clear();
  assets.meshes[1].primitives[0].indices[0] = 9;
  assets.mark_changed(AssetKind::mesh, 1);
  EXPECT_EQ(asset_fault_since(assets, before), "primitive 0 of mesh 1 has the index 9 for 3 positions");
}

}  // namespace
}  // namespace gloam
