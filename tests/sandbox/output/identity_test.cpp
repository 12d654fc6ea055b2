// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/identity.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <vector>

#include "engine/scene/assets.h"
#include "engine/scene/gltf/import.h"
#include "sandbox/output/file_io.h"

namespace gloam {
namespace {

class SceneHash : public ::testing::Test {
 protected:
  SceneHash() {
    prepare_scene_world(world_);
    SceneAssets& assets = world_.resource<SceneAssets>();
    Primitive primitive;
    primitive.positions = {vec3(0.0f), vec3(1.0f)};
    primitive.morph_targets.push_back({{vec3(0.0f)}, {}});
    assets.meshes.push_back({.name = "m", .primitives = {primitive}});
    assets.images.push_back({.name = "i", .width = 1, .height = 1, .rgba = {1, 2, 3, 4}});
    assets.clips.push_back({.name = "c", .channels = {{.times = {0.0f}, .values = {0.0f}}}});
  }
  [[nodiscard]] std::string hash() const { return scene_hash("builtin:test", world_); }

  World world_;
};

TEST_F(SceneHash, is_sixteen_digits_and_the_same_twice) {
  EXPECT_EQ(hash().size(), 16u);
  EXPECT_EQ(hash(), hash());
  EXPECT_NE(hash(), scene_hash("builtin:other", world_));
}

TEST_F(SceneHash, sees_every_kind_of_content) {
  SceneAssets& assets = world_.resource<SceneAssets>();
  const std::vector<std::function<void()>> changes = {
      [&] { assets.meshes[0].primitives[0].positions[1].z = 2.0f; },
      [&] { assets.meshes[0].primitives[0].material = 3; },
      [&] { assets.meshes[0].primitives[0].morph_targets[0].positions[0].x = 1.0f; },
      [&] { assets.images[0].rgba[3] = 5; }, [&] { assets.clips[0].channels[0].values[0] = 1.0f; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const std::string before = hash();
    changes[i]();
    EXPECT_NE(hash(), before) << "change " << i;
  }
}

TEST_F(SceneHash, sees_the_text_of_the_file) {
  const std::string path = (std::filesystem::path(::testing::TempDir()) / "gloam_scene_hash.gltf").string();
  ASSERT_TRUE(write_file(path, "one").ok());
  const std::string before = scene_hash(path, world_);
  ASSERT_TRUE(write_file(path, "two").ok());
  EXPECT_NE(scene_hash(path, world_), before);
  std::filesystem::remove(path);
}

TEST(program_hash, stays_the_same) { EXPECT_EQ(program_hash(), program_hash()); }

}  // namespace
}  // namespace gloam
