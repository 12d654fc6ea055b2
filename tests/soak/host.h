// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/gpu/vulkan/startup/features.h"
#include "engine/jobs/executor.h"
#include "engine/render/renderer.h"
#include "tests/soak/own_blocks.h"
#include "tests/soak/plan.h"
#include "tests/support/counted_memory.h"

namespace gloam::soak {

/// Live bytes: given and not taken back, as hooks of the functions that give and take have seen it.
struct LiveBytes {
  std::int64_t heap = 0;         ///< operator new, of gloam and this program
  std::int64_t libraries = 0;    ///< operator new, of shared libraries
  std::int64_t driver_heap = 0;  ///< VkAllocationCallbacks
  std::int64_t device = 0;       ///< vkAllocateMemory
};

/// A program that draws a world in one or two views. The world holds a built-in scene, and meshes and lamps that come
/// and go. Fails by exceptions: there is nothing that a soak could do about an error.
class Host {
 public:
  /// Without a usable device, has_device() is false, and nothing else may be called.
  explicit Host(bool validate);
  ~Host();

  /// At first frames wait for pipelines. Meshes and images are uploaded in the background in any case.
  void set_readiness(Readiness readiness) { readiness_ = readiness; }
  /// Brings the world, the views and the knobs to a state, from whatever they are.
  void show(const State& state);
  /// Loads the scene of the state again.
  void reload();
  /// Draws the frames of a step.
  void draw(const Step& step);
  /// Draws until all assets and pipelines of the state are there.
  void complete();
  /// Lets the state settle, so that its pictures no longer depend on what was before: completes it; releases the views,
  /// because places and sizes of their shadow maps follow from those of earlier frames; sets the clock back to 0, which
  /// starts simulations again; and draws a fixed number of frames.
  void settle();
  /// The pictures of the drawn views, as bytes that can be compared.
  [[nodiscard]] std::vector<std::uint8_t> pictures();
  /// Measures the heap after the state has settled. Then releases the world and the views, and measures what the driver
  /// has given: a world's buffers keep room for what was there once, so they do not count. show() brings a state back.
  [[nodiscard]] LiveBytes live_bytes();
  [[nodiscard]] std::uint64_t validation_messages() const { return owner_->validation_messages(); }
  [[nodiscard]] bool has_device() const { return device_ != nullptr; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }

 private:
  /// Entities and assets of a streamed mesh.
  struct Streamed {
    Entity entity;
    std::uint32_t mesh = 0, material = 0, texture = 0, image = 0;
  };
  void load_scene(const std::string& scene);
  void unload_scene();
  void add_mesh(std::uint32_t number);
  void remove_mesh(const Streamed& streamed);
  Entity add_lamp(std::uint32_t number);
  [[nodiscard]] dmat4 place_of(std::uint32_t number) const;
  void set_knobs();
  void draw_frame(double turn, bool cut, Readiness readiness);

  std::shared_ptr<gpu::Device> owner_;  ///< of the VkDevice, with the validation messages
  gpu::vulkan::Features features_;
  test::CallWatch watch_;
  test::CountingCallbacks callbacks_;
  std::unique_ptr<OwnBlocks> blocks_;
  std::unique_ptr<JobExecutor> executor_ = make_pool_executor(2);
  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<World> world_;
  std::vector<ViewSettings> cameras_;  ///< of the scene, as posed at the time 0
  std::map<std::uint32_t, Streamed> meshes_;
  std::map<std::uint32_t, Entity> lamps_;
  State state_;
  Readiness readiness_ = Readiness::wait;
  double time_s_ = 0.0;
  std::uint64_t frames_ = 0;
};

}  // namespace gloam::soak
