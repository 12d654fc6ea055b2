// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/recording/device.h"
#include "engine/render/scene/gpu_scene.h"
#include "engine/scene/gltf/import.h"
#include "tests/support/render_scene.h"

namespace gloam::test {

/// Bytes that were copied from staging memory to buffers whose name starts with `target`, in the last frame. Contents
/// that a larger buffer takes over do not count.
[[nodiscard]] inline std::uint64_t copied_bytes(const gpu::RecordingDevice& device, const std::string& target) {
  std::uint64_t bytes = 0;
  for (const gpu::RecordedCommand& command : device.commands()) {
    if (command.name != "copy_buffer" || command.text.find("'upload ring'") == std::string::npos) continue;
    if (command.text.find("> '" + target) == std::string::npos) continue;
    const std::size_t comma = command.text.rfind(", ");
    std::uint64_t count = 0;
    std::from_chars(command.text.data() + comma + 2, command.text.data() + command.text.size(), count);
    bytes += count;
  }
  return bytes;
}

/// Bytes that were copied to mips of an image of 64x64 texels in the last frame.
[[nodiscard]] inline std::uint64_t copied_rows_bytes(const gpu::RecordingDevice& device) {
  std::uint64_t bytes = 0;
  for (const gpu::RecordedCommand& command : device.commands()) {
    const std::size_t mip = command.text.find(" mip "), rows = command.text.rfind('+');
    if (command.name != "copy_rows_to_image") continue;
    bytes += std::stoull(command.text.substr(rows + 1)) * 4 * (64u >> std::stoul(command.text.substr(mip + 5)));
  }
  return bytes;
}

[[nodiscard]] inline std::size_t count_of(const gpu::RecordingDevice& device, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::count(device.commands(), name, &gpu::RecordedCommand::name));
}

class SceneChanges : public ::testing::Test {
 protected:
  SceneChanges() {
    prepare_scene_world(world_);
    for (int i = 0; i < 3; ++i) {
      textures_.push_back(
          maker_.texture(8, 8, std::vector<std::uint8_t>(256, static_cast<std::uint8_t>(40 * i)), true));
      Material material;
      material.base_color_texture.texture = textures_.back();
      materials_.push_back(maker_.material(material));
      meshes_.push_back(maker_.mesh(test::round_ball(1.0f + static_cast<float>(i), 16, 8, materials_.back())));
    }
  }
  void TearDown() override {
    scene_.reset();
    EXPECT_TRUE(device_->faults().empty()) << device_->faults().front();
  }
  SceneAssets& assets() { return maker_.assets(); }
  void start(const AssetUploadOptions& options = {}) {
    scene_ = std::make_unique<GpuScene>(*device_, pipelines_, options);
    frame();
  }
  /// A frame that is given up if `submitted` is false.
  void frame(bool submitted = true) {
    const Status synced = scene_->sync(assets(), *executor_, in_use_);
    ASSERT_TRUE(synced.ok()) << synced.error().message;
    device_->forget_commands();
    auto commands = device_->begin_frame();
    ASSERT_TRUE(commands.ok());
    graph_.begin();
    ASSERT_TRUE(scene_->stage(assets()).ok());
    scene_->add_pass(graph_);
    ASSERT_TRUE(graph_.compile().ok());
    graph_.execute(**commands);
    if (submitted) {
      ASSERT_TRUE(device_->submit_frame().ok());
      scene_->commit_frame();
    } else {
      ASSERT_TRUE(device_->abandon_frame().ok());
      scene_->give_up_frame();
    }
  }
  /// Frames until everything is shown.
  void settle() {
    for (int frames = 0; frames < 100000; ++frames) {
      frame();
      if (HasFatalFailure() || scene_->pending() == 0) return;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    FAIL() << "changes are left";
  }
  template <class T>
  std::vector<T> read(gpu::BufferHandle buffer, std::uint64_t first, std::uint64_t count) {
    const std::uint64_t size = count * sizeof(T);
    const gpu::BufferHandle copy = device_
                                       ->create_buffer({.name = "copy",
                                                        .size = size,
                                                        .usage = gpu::BufferUsage::transfer_target,
                                                        .memory = gpu::MemoryKind::readback})
                                       .value();
    gpu::CommandList& commands = *device_->begin_frame().value();
    using Streams = MeshStreams;
    const gpu::BufferBarrier before{buffer, Streams::kAccess, gpu::Access::transfer_read, Streams::kAlso, 0};
    const gpu::BufferBarrier after{buffer, gpu::Access::transfer_read, Streams::kAccess, 0, Streams::kAlso};
    const gpu::BufferBarrier written{copy, gpu::Access::transfer_write, gpu::Access::host_read};
    commands.barrier({&before, 1}, {});
    commands.copy_buffer(buffer, first * sizeof(T), copy, 0, size);
    commands.barrier({&after, 1}, {});
    commands.barrier({&written, 1}, {});
    EXPECT_TRUE(device_->submit_frame().ok());
    std::vector<T> values(count);
    std::memcpy(values.data(), device_->mapped(copy).data(), size);
    device_->destroy(copy);
    return values;
  }
  /// Expects the vertices, indices and materials of another scene that is uploaded anew.
  void expect_as_new() {
    GpuScene fresh(*device_, pipelines_);
    ASSERT_TRUE(fresh.sync(assets(), *executor_).ok());
    ASSERT_EQ(scene_->meshes().size(), fresh.meshes().size());
    for (std::size_t m = 0; m < fresh.meshes().size(); ++m) {
      ASSERT_EQ(scene_->meshes()[m].size(), fresh.meshes()[m].size()) << "mesh " << m;
      for (std::size_t p = 0; p < fresh.meshes()[m].size(); ++p) {
        const GpuPrimitive &a = scene_->meshes()[m][p], &b = fresh.meshes()[m][p];
        EXPECT_EQ(a.material, b.material);
        ASSERT_EQ(a.vertex_count, b.vertex_count);
        ASSERT_EQ(a.index_count, b.index_count);
        EXPECT_EQ(read<vec3>(scene_->positions(), a.first_vertex, a.vertex_count),
                  read<vec3>(fresh.positions(), b.first_vertex, b.vertex_count))
            << "mesh " << m;
        EXPECT_EQ(read<std::uint32_t>(scene_->indices(), a.first_index, a.index_count),
                  read<std::uint32_t>(fresh.indices(), b.first_index, b.index_count))
            << "mesh " << m;
      }
    }
    for (std::uint32_t m = 0; m < assets().materials.size(); ++m) {
      EXPECT_EQ(scene_->material(m).features, fresh.material(m).features);
      EXPECT_TRUE(scene_->material(m).set);
    }
    EXPECT_EQ(scene_->has_smooth_shading(), fresh.has_smooth_shading());
  }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  std::unique_ptr<JobExecutor> executor_ = make_serial_executor();
  Pipelines pipelines_{*device_};
  FrameGraph graph_{*device_};
  World world_;
  test::SceneMaker maker_{world_};
  std::vector<std::uint32_t> textures_, materials_, meshes_;
  std::optional<MeshesInUse> in_use_;  ///< none: all
  std::unique_ptr<GpuScene> scene_;
};

}  // namespace gloam::test
