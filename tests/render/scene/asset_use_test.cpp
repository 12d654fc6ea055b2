// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Meshes and images are on the GPU while something uses them, and for some frames after.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/render/scene/scene_changes.h"

namespace gloam::test {
namespace {

class SceneInUse : public SceneChanges {
 protected:
  /// A megabyte of vertices and a megabyte of texels that nothing uses, in many parts.
  SceneInUse() {
    for (int i = 0; i < 20; ++i) {
      Material material;
      material.base_color_texture.texture =
          maker_.texture(128, 128, std::vector<std::uint8_t>(128 * 128 * 4, static_cast<std::uint8_t>(i)), true);
      large_.push_back(maker_.mesh(test::round_ball(1.0f, 64, 32, maker_.material(material))));
    }
    use({});
  }
  void use(const std::vector<std::uint32_t>& meshes) {
    in_use_ = MeshesInUse{std::vector<bool>(assets().meshes.size(), false)};
    for (const std::uint32_t mesh : meshes) in_use_->meshes[mesh] = true;
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) frame();
  }
  [[nodiscard]] std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const gpu::ModuleMemory& memory : device_->memory()) sum += memory.bytes;
    return sum;
  }
  [[nodiscard]] bool is_there(std::uint32_t mesh) const { return !scene_->meshes()[mesh].empty(); }
  /// Expects that a mesh in use has the bytes of one that was uploaded alone.
  void expect_whole(std::uint32_t mesh) {
    GpuScene fresh(*device_, pipelines_);
    ASSERT_TRUE(fresh.sync(assets(), *executor_).ok());
    ASSERT_TRUE(is_there(mesh));
    const GpuPrimitive &a = scene_->meshes()[mesh][0], &b = fresh.meshes()[mesh][0];
    ASSERT_EQ(a.vertex_count, b.vertex_count);
    EXPECT_EQ(read<vec3>(scene_->positions(), a.first_vertex, a.vertex_count),
              read<vec3>(fresh.positions(), b.first_vertex, b.vertex_count));
    EXPECT_EQ(read<std::uint32_t>(scene_->surfaces(), a.first_vertex * 6ull, a.vertex_count * 6ull),
              read<std::uint32_t>(fresh.surfaces(), b.first_vertex * 6ull, b.vertex_count * 6ull));
    EXPECT_EQ(read<std::uint32_t>(scene_->indices(), a.first_index, a.index_count),
              read<std::uint32_t>(fresh.indices(), b.first_index, b.index_count));
  }

  std::vector<std::uint32_t> large_;
};

TEST_F(SceneInUse, holds_nothing_that_is_not_in_use) {
  start();
  const std::uint64_t none = bytes();
  EXPECT_LT(none, 64u << 10);
  use({meshes_[1]});
  frame();
  EXPECT_GT(copied_bytes(*device_, "scene.positions"), 0u);
  EXPECT_EQ(count_of(*device_, "copy_rows_to_image"), 4u) << "the mips of one image";
  for (const std::uint32_t mesh : {meshes_[0], meshes_[2], large_[0]}) EXPECT_FALSE(is_there(mesh));
  expect_whole(meshes_[1]);
  frame();
  EXPECT_EQ(copied_bytes(*device_, "scene."), 0u) << "once";
}

TEST_F(SceneInUse, gives_memory_back_after_120_frames_and_comes_again) {
  use({meshes_[0]});
  start();
  frames(4);
  const std::uint64_t least = bytes();
  std::vector<std::uint32_t> all = large_;
  all.push_back(meshes_[0]);
  use(all);
  frames(4);
  const std::uint64_t most = bytes();
  EXPECT_GT(most, least + (2u << 20));
  use({meshes_[0], large_[7]});
  frames(118);
  EXPECT_EQ(bytes(), most);
  EXPECT_TRUE(is_there(large_[3]));
  frames(8);
  EXPECT_FALSE(is_there(large_[3]));
  const std::uint64_t one = bytes();
  EXPECT_LT(one, least + (most - least) / 8) << "buffers and images have shrunk";
  expect_whole(meshes_[0]);
  expect_whole(large_[7]);
  use({large_[3], meshes_[0]});
  frame();
  expect_whole(large_[3]);
  expect_whole(large_[7]);
  expect_whole(meshes_[0]);
}

TEST_F(SceneInUse, keeps_what_comes_and_goes_from_frame_to_frame) {
  use({meshes_[0]});
  start();
  use({meshes_[1]});
  frames(2);
  for (int i = 0; i < 300; ++i) {
    use({meshes_[i % 2]});
    frame();
    ASSERT_EQ(copied_bytes(*device_, "scene.") + count_of(*device_, "copy_rows_to_image"), 0u) << i;
  }
}

TEST_F(SceneInUse, ages_with_frames_and_not_with_redraws) {
  use({meshes_[0]});
  start();
  use({});
  in_use_->ages = false;
  frames(300);
  EXPECT_TRUE(is_there(meshes_[0]));
  in_use_->ages = true;
  frames(121);
  EXPECT_FALSE(is_there(meshes_[0]));
}

TEST_F(SceneInUse, in_the_background_what_is_out_of_use_before_it_has_come_goes_when_it_has) {
  use({meshes_[0]});
  start({.background = true, .budget = 1024});
  settle();
  use({meshes_[0], large_[0], large_[1]});
  frames(2);
  EXPECT_GT(scene_->pending(), 0u);
  use({meshes_[0]});
  frames(1500);
  settle();
  frames(2);
  EXPECT_FALSE(is_there(large_[0]));
  EXPECT_FALSE(is_there(large_[1]));
  expect_whole(meshes_[0]);
}

TEST_F(SceneInUse, a_changed_material_brings_its_image) {
  use({meshes_[0]});
  start();
  frame();
  assets().materials[materials_[0]].base_color_texture.texture = textures_[2];
  assets().mark_changed(AssetKind::material, materials_[0]);
  frame();
  EXPECT_EQ(count_of(*device_, "copy_rows_to_image"), 4u);
  assets().materials[materials_[0]].base_color_texture.texture = textures_[0];
  assets().mark_changed(AssetKind::material, materials_[0]);
  frame();
  EXPECT_EQ(count_of(*device_, "copy_rows_to_image"), 0u) << "it is still there";
}

}  // namespace
}  // namespace gloam::test
