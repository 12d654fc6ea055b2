// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Copies to the GPU when single assets change. The bytes that end up in buffers and images are compared with those of a
// scene that was uploaded as a whole.
#include "engine/render/scene/gpu_scene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/gpu/image_size.h"
#include "tests/render/scene/scene_changes.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

TEST_F(SceneChanges, a_changed_colour_copies_the_constants_of_one_material) {
  start();
  assets().materials[materials_[1]].base_color = vec4(0.25f);
  assets().mark_changed(AssetKind::material, materials_[1]);
  frame();
  EXPECT_EQ(copied_bytes(*device_, ""), 256u);
  EXPECT_EQ(copied_bytes(*device_, "scene.materials"), 256u);
  frame();
  EXPECT_EQ(copied_bytes(*device_, ""), 0u);
  expect_as_new();
}

TEST_F(SceneChanges, a_changed_mesh_copies_its_streams_and_keeps_the_others) {
  start();
  const gpu::BufferHandle positions = scene_->positions();
  const GpuPrimitive other = scene_->meshes()[meshes_[0]][0];
  const std::uint64_t content = scene_->meshes()[meshes_[2]][0].content;
  assets().meshes[meshes_[2]].primitives[0].positions[5] *= 1.5f;
  assets().mark_changed(AssetKind::mesh, meshes_[2]);
  frame();
  const GpuPrimitive& changed = scene_->meshes()[meshes_[2]][0];
  EXPECT_NE(changed.content, content) << "what is cached of it is made again";
  EXPECT_EQ(copied_bytes(*device_, "scene.surfaces") / sizeof(PackedSurface), changed.vertex_count);
  EXPECT_EQ(scene_->meshes()[meshes_[0]][0].content, other.content);
  EXPECT_EQ(scene_->meshes()[meshes_[0]][0].first_vertex, other.first_vertex);
  EXPECT_NE(scene_->positions(), positions) << "the first change needs more room than a full upload leaves";
  expect_as_new();
  const gpu::BufferHandle grown = scene_->positions();
  for (int i = 0; i < 20; ++i) {
    assets().meshes[meshes_[2]].primitives[0].positions[5].y += 0.1f;
    assets().mark_changed(AssetKind::mesh, meshes_[2]);
    frame();
  }
  EXPECT_EQ(scene_->positions(), grown) << "places are used again";
  expect_as_new();
}

TEST_F(SceneChanges, added_and_destroyed_assets_leave_no_trace_in_the_others) {
  start();
  std::mt19937 engine(3);
  const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
  std::vector<std::uint32_t> living = meshes_;
  for (int step = 0; step < 60; ++step) {
    if (random() % 2 == 0 && living.size() > 1) {
      std::swap(living[random() % living.size()], living.back());
      assets().destroy(AssetKind::mesh, living.back());
      living.pop_back();
    } else {
      Primitive ball = test::round_ball(0.5f, 4 + random() % 30, 3 + random() % 20, materials_[random() % 3]);
      Mesh mesh;
      mesh.bounds = ball.bounds;
      mesh.primitives.push_back(std::move(ball));
      living.push_back(assets().add(std::move(mesh)));
    }
    if (random() % 3 != 0) frame();
    ASSERT_FALSE(HasFatalFailure());
  }
  frame();
  expect_as_new();
  for (const std::uint32_t mesh : living) assets().destroy(AssetKind::mesh, mesh);
  frame();
  EXPECT_FALSE(scene_->has_smooth_shading());
  for (const auto& primitives : scene_->meshes()) EXPECT_TRUE(primitives.empty());
}

TEST_F(SceneChanges, a_changed_image_is_copied_once_for_each_use_and_other_materials_keep_their_sets) {
  start();
  const auto other = scene_->material(materials_[0]).set;
  const auto own = scene_->material(materials_[1]).set;
  Image& image = assets().images[assets().textures[textures_[1]].image];
  image = {"larger", 16, 4, std::vector<std::uint8_t>(256, 9)};
  assets().mark_changed(AssetKind::image, assets().textures[textures_[1]].image);
  frame();
  EXPECT_EQ(count_of(*device_, "copy_rows_to_image"), 5u) << "16x4 texels have five mips";
  EXPECT_EQ(copied_bytes(*device_, ""), 0u);
  EXPECT_EQ(scene_->material(materials_[0]).set, other);
  EXPECT_NE(scene_->material(materials_[1]).set, own);
  expect_as_new();
}

TEST_F(SceneChanges, a_changed_sampler_copies_nothing) {
  start();
  const auto own = scene_->material(materials_[1]).set;
  assets().textures[textures_[1]].wrap_u = WrapMode::repeat;
  assets().mark_changed(AssetKind::texture, textures_[1]);
  frame();
  EXPECT_NE(scene_->material(materials_[1]).set, own);
  EXPECT_EQ(count_of(*device_, "copy_rows_to_image") + copied_bytes(*device_, ""), 0u);
}

TEST_F(SceneChanges, destroyed_images_give_their_memory_back) {
  start();
  const auto bytes = [&] {
    std::uint64_t sum = 0;
    for (const gpu::ModuleMemory& memory : device_->memory()) sum += memory.bytes;
    return sum;
  };
  frame();
  const std::uint64_t before = bytes();
  const std::uint32_t image = assets().add(Image{"big", 256, 256, std::vector<std::uint8_t>(256 * 256 * 4)});
  const std::uint32_t texture = assets().add(Texture{.name = "big", .image = image});
  for (int i = 0; i < 4; ++i) frame();
  EXPECT_GE(bytes(), before + 256 * 256 * 4);
  assets().destroy(AssetKind::texture, texture);
  assets().destroy(AssetKind::image, image);
  for (int i = 0; i < 4; ++i) frame();
  EXPECT_EQ(bytes(), before);
}

TEST_F(SceneChanges, assets_that_were_appended_are_found_and_a_shorter_list_is_uploaded_as_a_whole) {
  start();
  assets().materials.emplace_back();
  Mesh mesh;
  mesh.primitives.push_back(test::quad(1.0f, static_cast<std::uint32_t>(assets().materials.size() - 1)));
  mesh.bounds = mesh.primitives[0].bounds;
  assets().meshes.push_back(mesh);
  frame();
  EXPECT_LT(copied_bytes(*device_, "scene.frames"), 200u);
  expect_as_new();
  assets().meshes.pop_back();
  frame();
  EXPECT_EQ(scene_->meshes().size(), 3u);
  expect_as_new();
}

TEST_F(SceneChanges, what_is_wrong_with_a_changed_asset_is_asserted) {
  start();
  assets().meshes[meshes_[0]].primitives[0].normals.clear();
  assets().mark_changed(AssetKind::mesh, meshes_[0]);
  EXPECT_ASSERT(static_cast<void>(scene_->sync(assets(), *executor_)), "primitive 0 of mesh 0 has no normals");
}

TEST_F(SceneChanges, a_destroyed_material_that_a_mesh_still_has_is_asserted) {
  start();
  assets().destroy(AssetKind::material, materials_[1]);
  EXPECT_ASSERT(static_cast<void>(scene_->sync(assets(), *executor_)),
                "primitive 0 of mesh 1 has the material 1, which was destroyed");
}

TEST_F(SceneChanges, copies_of_a_frame_that_was_given_up_are_made_again) {
  start();
  assets().meshes[meshes_[2]].primitives[0].positions[5] *= 1.5f;
  assets().mark_changed(AssetKind::mesh, meshes_[2]);
  assets().materials[materials_[1]].double_sided = true;
  assets().mark_changed(AssetKind::material, materials_[1]);
  frame(false);
  frame();
  expect_as_new();
}

TEST_F(SceneChanges, in_the_background_a_frame_copies_no_more_than_its_budget_and_shows_what_is_complete) {
  constexpr std::uint64_t kBudget = 4096;
  start({.background = true, .budget = kBudget});
  const std::uint32_t before = scene_->meshes()[meshes_[0]][0].vertex_count;
  Primitive ball = test::round_ball(2.0f, 64, 32, materials_[0]);
  assets().meshes[meshes_[0]].primitives[0] = ball;
  assets().mark_changed(AssetKind::mesh, meshes_[0]);
  Image& image = assets().images[assets().textures[textures_[2]].image];
  image = {"larger", 64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 7)};
  assets().mark_changed(AssetKind::image, assets().textures[textures_[2]].image);
  int frames = 0, frames_with_the_old_mesh = 0;
  std::uint64_t rows = 0;
  do {
    frame();
    EXPECT_LE(copied_bytes(*device_, "") + copied_rows_bytes(*device_), kBudget);
    rows += count_of(*device_, "copy_rows_to_image");
    frames_with_the_old_mesh += scene_->meshes()[meshes_[0]][0].vertex_count == before ? 1 : 0;
    ASSERT_LT(++frames, 100000);
  } while (scene_->pending() > 0);
  const std::uint64_t bytes = 64 * 33 * 20 + 64 * 64 * 4;
  EXPECT_GE(static_cast<std::uint64_t>(frames), bytes / kBudget);
  EXPECT_GT(frames_with_the_old_mesh, 10);
  EXPECT_GE(rows, 4u) << "the largest mip takes four frames";
  expect_as_new();
}

TEST_F(SceneChanges, in_the_background_nothing_destroyed_is_shown_in_the_place_of_what_follows_it) {
  start({.background = true, .budget = 64});
  const std::uint32_t image = assets().textures[textures_[1]].image;
  const auto set = scene_->material(materials_[1]).set;
  assets().destroy(AssetKind::mesh, meshes_[1]);
  Mesh box;
  box.primitives.push_back(test::box(vec3(1.0f), materials_[1]));
  box.bounds = box.primitives[0].bounds;
  ASSERT_EQ(assets().add(std::move(box)), meshes_[1]);
  assets().destroy(AssetKind::image, image);
  ASSERT_EQ(assets().add(Image{"other", 32, 32, std::vector<std::uint8_t>(4096, 80)}), image);
  frame();
  EXPECT_TRUE(scene_->meshes()[meshes_[1]].empty()) << "the ball is gone, the box is not complete";
  EXPECT_NE(scene_->material(materials_[1]).set, set) << "white takes the place of the image";
  EXPECT_GT(scene_->pending(), 0u);
  settle();
  ASSERT_EQ(scene_->meshes()[meshes_[1]].size(), 1u);
  expect_as_new();
}

TEST_F(SceneChanges, in_the_background_the_last_of_many_changes_wins) {
  start({.background = true, .budget = 2000});
  std::mt19937 engine(11);
  const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
  for (int step = 0; step < 200; ++step) {
    const std::uint32_t mesh = meshes_[random() % 3];
    const bool exists = !assets().is_destroyed(AssetKind::mesh, mesh);
    if (random() % 4 == 0 && exists) {
      assets().destroy(AssetKind::mesh, mesh);
    } else if (random() % 2 == 0) {
      Primitive ball = test::round_ball(1.0f, 4 + random() % 20, 3 + random() % 9, materials_[random() % 3]);
      Mesh changed;
      changed.bounds = ball.bounds;
      changed.primitives.push_back(std::move(ball));
      if (exists) {
        assets().meshes[mesh] = std::move(changed);
        assets().mark_changed(AssetKind::mesh, mesh);
      } else {
        static_cast<void>(assets().add(std::move(changed)));
      }
    }
    frame();
    ASSERT_FALSE(HasFatalFailure());
  }
  settle();
  expect_as_new();
}

TEST_F(SceneChanges, what_is_destroyed_in_any_frame_of_its_upload_is_not_copied_further) {
  for (const std::uint64_t budget : {256u, 1024u, 1u << 20}) {
    for (int frames = 0; frames < 9; ++frames) {
      SCOPED_TRACE(std::to_string(frames) + " frames with a budget of " + std::to_string(budget));
      start({.background = true, .budget = budget});
      const std::uint32_t image = assets().add(Image{"late", 16, 16, std::vector<std::uint8_t>(1024, 9)});
      const std::uint32_t texture = assets().add(Texture{.name = "late", .image = image});
      Primitive ball = test::round_ball(1.0f, 8, 4, materials_[0]);
      Mesh mesh{.name = "late", .primitives = {ball}, .morph_weights = {}, .bounds = ball.bounds};
      const std::uint32_t late = assets().add(std::move(mesh));
      for (int i = 0; i < frames; ++i) {
        frame();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      assets().destroy(AssetKind::texture, texture);
      assets().destroy(AssetKind::image, image);
      assets().destroy(AssetKind::mesh, late);
      settle();
      ASSERT_FALSE(HasFatalFailure());
      EXPECT_TRUE(device_->faults().empty());
      expect_as_new();
    }
  }
}

TEST_F(SceneChanges, an_image_that_lost_its_texture_during_its_upload_is_uploaded_for_the_next_texture) {
  const auto bytes = [&] {
    std::uint64_t sum = 0;
    for (const gpu::ModuleMemory& memory : device_->memory()) sum += memory.bytes;
    return sum;
  };
  for (int frames = 1; frames < 8; ++frames) {
    SCOPED_TRACE(frames);
    start({.background = true, .budget = 4096});
    settle();
    for (int i = 0; i < 4; ++i) frame();
    const std::uint64_t before = bytes();
    const std::uint32_t image = assets().add(Image{"late", 64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 9)});
    std::uint32_t texture = assets().add(Texture{.name = "first", .image = image});
    for (int i = 0; i < frames; ++i) {
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    assets().destroy(AssetKind::texture, texture);
    settle();
    for (int i = 0; i < 4; ++i) frame();
    EXPECT_EQ(bytes(), before) << "an image that no texture shows takes no memory";
    texture = assets().add(Texture{.name = "second", .image = image});
    std::uint64_t rows = 0;
    do {
      frame();
      rows += copied_rows_bytes(*device_);
    } while (scene_->pending() > 0 && !HasFatalFailure());
    EXPECT_EQ(rows, gpu::image_bytes(texture_image_desc("late", 64, 64, false)));
    assets().destroy(AssetKind::texture, texture);
    assets().destroy(AssetKind::image, image);
  }
}

TEST_F(SceneChanges, a_scene_that_ends_while_assets_are_packed_waits_for_nothing_and_leaks_nothing) {
  start({.background = true, .budget = 64});
  const std::uint64_t bytes = device_->memory().empty() ? 0 : 1;
  for (const std::uint32_t mesh : meshes_) assets().mark_changed(AssetKind::mesh, mesh);
  frame();
  frame();
  scene_.reset();
  for (const gpu::ModuleMemory& memory : device_->memory())
    if (memory.module == "engine") {
      EXPECT_LE(memory.bytes, bytes << 20);
    }
}

TEST_F(SceneChanges, a_material_that_becomes_cut_out_gives_its_casters_another_content) {
  start();
  const std::uint64_t before = scene_->material(materials_[0]).content;
  assets().materials[materials_[0]].alpha_mode = AlphaMode::mask;
  assets().mark_changed(AssetKind::material, materials_[0]);
  frame();
  EXPECT_NE(scene_->material(materials_[0]).content, before);
  const std::uint64_t masked = scene_->material(materials_[0]).content;
  assets().mark_changed(AssetKind::image, assets().textures[textures_[0]].image);
  frame();
  EXPECT_NE(scene_->material(materials_[0]).content, masked) << "its alpha may have changed with the image";
}

}  // namespace
}  // namespace gloam::test
