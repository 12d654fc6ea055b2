// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gpu/device.h"
#include "shaders/lights/lights_shared.h"
#include "tests/modules/lights/lists/find_lights_scene.h"

namespace gloam::test {

/// Results of the kernels for a view; each kernel reads those of the one before. Buffers are initialised with
/// kUntouched.
struct FoundLights {
  static constexpr std::uint32_t kUntouched = 0xA5A5A5A5u;
  std::vector<std::uint32_t> group_masks;
  std::vector<uvec2> tile_lists;
  std::vector<std::uint32_t> early_lists;
  shaders::LightCounters counters{};

  [[nodiscard]] std::uint32_t approx_count(std::uint32_t tile) const { return tile_lists[tile].y >> 16; }
  [[nodiscard]] std::uint32_t accurate_count(std::uint32_t tile) const { return tile_lists[tile].y & 0xFFFFu; }
  [[nodiscard]] bool has_list(std::uint32_t tile) const { return tile_lists[tile].x != GLOAM_NO_SLOT; }
  /// The lights of a tile's list, in the stored order.
  [[nodiscard]] std::vector<std::uint32_t> list(std::uint32_t tile) const {
    std::vector<std::uint32_t> lights;
    for (std::uint32_t i = 0; i < accurate_count(tile); ++i) {
      const std::uint32_t entry = tile_lists[tile].x + i;
      lights.push_back(early_lists[entry / 3] >> entry % 3 * 10 & 0x3FFu);
    }
    return lights;
  }
  /// The lights of a group mask.
  [[nodiscard]] std::vector<std::uint32_t> group(std::uint32_t index) const {
    const std::uint32_t* words = &group_masks[std::size_t{index} * GLOAM_MASK_WORDS];
    std::vector<std::uint32_t> lights;
    for (std::uint32_t i = 0; i < GLOAM_MAX_LOCAL_LIGHTS; ++i)
      if ((words[0] >> i / 32 & 1u) != 0 && (words[1 + i / 32] >> i % 32 & 1u) != 0) lights.push_back(i);
    return lights;
  }
};

/// Runs the kernels of shaders/lights that find lights. Any error fails the test.
class FindLights {
 public:
  /// `rows`: rows of 8 threads per workgroup of the accurate search; 0: the shader's default.
  explicit FindLights(gpu::Device& device, std::uint32_t rows = 0);
  ~FindLights();
  FindLights(const FindLights&) = delete;
  FindLights& operator=(const FindLights&) = delete;

  [[nodiscard]] FoundLights approximate(const SearchedScene& scene);
  /// Runs both shaders, which must agree: one thread per pixel or per few pixels, and one thread per tile.
  void accurate(const SearchedScene& scene, FoundLights& found);
  /// Fills counters.culling_errors.
  void check(const SearchedScene& scene, FoundLights& found);
  [[nodiscard]] FoundLights all(const SearchedScene& scene) {
    FoundLights found = approximate(scene);
    accurate(scene, found);
    check(scene, found);
    return found;
  }

 private:
  void run_accurate(gpu::PipelineHandle pipeline, uvec2 workgroups, const SearchedScene& scene, FoundLights& found);

  gpu::Device& device_;
  gpu::PipelineHandle approx_;
  gpu::PipelineHandle accurate_;
  gpu::PipelineHandle accurate_tiles_;
  gpu::PipelineHandle check_;
  gpu::SamplerHandle sampler_;
};

}  // namespace gloam::test
