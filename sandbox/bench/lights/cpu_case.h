// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/module.h"
#include "engine/scene/components.h"
#include "engine/schedule/schedule.h"

namespace gloam::bench {

/// Lights in front of a camera with a field of view of 60°, 1 to 100 m away, half of them point and half spot lights,
/// in several archetypes.
struct LightCpuScene {
  std::uint32_t lights = 1024;
  std::uint32_t width = 3840;
  std::uint32_t height = 2160;
  float least_radius_m = 1.0f;
  float greatest_radius_m = 5.0f;
};

/// The light systems of the CPU, as a renderer runs them, on a world where every light and the camera move every frame.
class LightCpuCase {
 public:
  explicit LightCpuCase(const LightCpuScene& scene);

  /// Sets a knob of the module lights, which must exist: "lights.tile_bound" ("rect", "row_interval", "cone") or
  /// "lights.z_bins" ("256" … "4096").
  void set_knob(const char* name, const char* value);
  /// Moves lights and camera to the next pose of a repeating sequence. Every case has the same poses, so that hashes
  /// repeat.
  void move();
  /// Runs all light systems: world and view stage.
  void run(JobExecutor& executor);

  [[nodiscard]] std::size_t bytes_written() const;
  [[nodiscard]] double lights_per_tile() const;
  /// Hash of tile masks and zBins.
  [[nodiscard]] std::uint64_t hash() const;

 private:
  struct Moment {
    std::vector<dmat4> lights;
    dmat4 camera;
  };
  LightCpuScene scene_;
  std::unique_ptr<Module> module_;
  KnobRegistry knobs_;
  Schedule schedule_;
  World world_;
  std::vector<Entity> entities_;
  std::vector<Moment> moments_;
  std::size_t next_ = 0;
};

}  // namespace gloam::bench
