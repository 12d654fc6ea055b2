// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "modules/closeups/compose/transfer.h"
#include "modules/shadows/atlas/face_regions.h"
#include "shaders/closeups/shaders.h"
#include "shaders/shadows/maps/mips_shared.h"
#include "tests/modules/closeups/compose/transfer_cases.h"
#include "tests/modules/shadows/support/maps.h"
#include "tests/support/kernel.h"

namespace gloam::test {
namespace {

constexpr std::uint32_t kMap = 512;
constexpr std::uint32_t kStandard = 256;  // side of the image of standard faces

/// An area of a pair's face.
struct Area {
  glm::dvec2 low = glm::dvec2(1e30);
  glm::dvec2 high = glm::dvec2(-1e30);
  bool ahead = true;
};

/// Model of transfer.comp in double precision, computed from the faces instead of the shader's constants.
class Twin {
 public:
  Twin(const TransferCase& pair, const std::vector<float>& depths) : pair_(pair), depths_(depths) {}

  /// Bounds of a transferred texel: rounding decides which texels at the border of an area belong to it.
  struct Bounds {
    double low = 0.0;
    double high = 0.0;
  };
  [[nodiscard]] Bounds bounds(std::uint32_t x, std::uint32_t y) const {
    const Area area = area_of(x, y);
    if (!area.ahead) return {};
    const glm::dvec2 sides = area.high - area.low;
    Bounds found{1e30, 0.0};
    for (const double off : {-0.01, 0.01}) {
      const std::uint32_t level = transfer_level(vec2(sides + off), pair_.from.square.size);
      for (const double rim : {-1e-3, 1e-3}) {
        const double depth = nearest(area, {x + 0.5, y + 0.5}, 0.5 + 1.0 / 64.0 + rim, level < 2 ? 0 : level);
        found = {std::min(found.low, depth), std::max(found.high, depth)};
      }
    }
    return found;
  }

 private:
  [[nodiscard]] Area area_of(std::uint32_t x, std::uint32_t y) const {
    Area area;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const bool perspective = pair_.to.tan_half > 0.0f;
      const dvec3 point = unproject(pair_.to, x + (i & 1), y + (i >> 1), perspective ? 1.0 : 0.0);
      const auto seen = project(pair_.from, point);
      area.ahead = area.ahead && seen.has_value();
      if (!seen) continue;
      area.low = glm::min(area.low, glm::dvec2(seen->x, seen->y));
      area.high = glm::max(area.high, glm::dvec2(seen->x, seen->y));
    }
    return area;
  }
  /// Nearest depth of the mip's texels whose centres are within `reach` of the standard texel's centre; if there is
  /// none, of the texel at the centre of the area.
  [[nodiscard]] double nearest(const Area& area, const glm::dvec2& texel, double reach, std::uint32_t mip) const {
    const double texels = 1u << mip;
    const int side = static_cast<int>(pair_.from.square.size >> mip);
    const auto clamped = [&](const glm::dvec2& at) {
      return glm::clamp(glm::ivec2(glm::floor(at / texels)), glm::ivec2(0), glm::ivec2(side - 1));
    };
    const glm::ivec2 first = clamped(area.low - 0.01), last = clamped(area.high + 0.01);
    double found = 0.0;
    bool any = false;
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const bool perspective = pair_.from.tan_half > 0.0f;
        const dvec3 point = unproject(pair_.from, (x + 0.5) * texels, (y + 0.5) * texels, perspective ? 1.0 : 0.0);
        const auto seen = project(pair_.to, point);
        if (!seen || std::max(std::abs(seen->x - texel.x), std::abs(seen->y - texel.y)) > reach) continue;
        any = true;
        found = std::max(found, standard_depth(x, y, mip));
      }
    const glm::dvec2 middle = 0.5 * (area.low + area.high);
    const glm::ivec2 at = glm::ivec2(glm::floor(middle / texels));
    if (any || std::min(at.x, at.y) < 0 || std::max(at.x, at.y) >= side) return found;
    return standard_depth(at.x, at.y, mip, middle / texels - 0.5);
  }
  [[nodiscard]] double standard_depth(int x, int y, std::uint32_t mip) const {
    return standard_depth(x, y, mip, glm::dvec2(x, y));
  }
  /// The depth of a mip texel, placed at `at` (in texels of the mip).
  [[nodiscard]] double standard_depth(int x, int y, std::uint32_t mip, const glm::dvec2& at) const {
    const int block = 1 << mip, side = static_cast<int>(pair_.from.square.size);
    double depth = 0.0;
    for (int i = 0; i < block * block; ++i)
      depth = std::max(depth,
                       static_cast<double>(
                           depths_[static_cast<std::size_t>((y * block + i / block) * side + x * block + i % block)]));
    if (depth == 0.0) return 0.0;
    const bool perspective = pair_.from.tan_half > 0.0f;
    const double along = perspective ? pair_.from.near_m / depth : (1.0 - depth) * pair_.from.far_m;
    const auto seen = project(pair_.to, unproject(pair_.from, (at.x + 0.5) * block, (at.y + 0.5) * block, along));
    if (!seen) return 0.0;
    if (seen->depth > 1.0) return perspective ? 0.0 : 1.0;
    return std::max(seen->depth, 0.0);
  }

  const TransferCase& pair_;
  const std::vector<float>& depths_;
};

class CloseupTransferKernel : public KernelTest {
 protected:
  [[nodiscard]] std::vector<float> transferred(const TransferCase& pair, const ShadowMaps& maps,
                                               const TexelRect& texels, std::uint32_t depth_bits = ~0u) {
    Kernel kernel(device(), shaders::closeups::transfer_comp);
    prepare(kernel, pair, maps, texels, depth_bits);
    kernel.output_image(3, gpu::Format::r32_float, kStandard, kStandard);
    run(kernel, texels);
    return face_of(kernel.read<float>(3), pair.to.square);
  }
  /// Transfers to an atlas of 16 bits.
  [[nodiscard]] std::vector<std::uint16_t> transferred_steps(const TransferCase& pair, const ShadowMaps& maps,
                                                             const TexelRect& texels) {
    Kernel kernel(device(), shaders::closeups::transfer_r16_comp);
    prepare(kernel, pair, maps, texels, ~0u);
    kernel.output_image(3, gpu::Format::r16_unorm, kStandard, kStandard);
    run(kernel, texels);
    return face_of(kernel.read<std::uint16_t>(3), pair.to.square);
  }
  static void prepare(Kernel& kernel, const TransferCase& pair, const ShadowMaps& maps, const TexelRect& texels,
                      std::uint32_t depth_bits) {
    shaders::CloseupTransfer constants = transfer_constants(pair.from, kMap, pair.to, texels);
    constants.depth_bits = depth_bits;
    kernel.input(0, std::vector{constants});
    kernel.sampled_image(1, maps.atlas_image());
    kernel.sampled_image(2, maps.pyramid_image());
  }
  static void run(Kernel& kernel, const TexelRect& texels) {
    const uvec2 extent = texels.end - texels.begin;
    kernel.run((extent.x + 7) / 8, (extent.y + 7) / 8);
  }
  /// The texels of one face in the image of standard faces. Checks that no other texel was written.
  template <class Texel>
  [[nodiscard]] static std::vector<Texel> face_of(const std::vector<Texel>& image, const AtlasSquare& square) {
    std::vector<Texel> face;
    std::size_t beside = 0;
    for (std::uint32_t i = 0; i < kStandard * kStandard; ++i) {
      const uvec2 at(i % kStandard, i / kStandard);
      const bool inside = at.x - square.origin.x < square.size && at.y - square.origin.y < square.size;
      if (inside)
        face.push_back(image[i]);
      else
        beside += is_untouched(image[i]) ? 0 : 1;
    }
    EXPECT_EQ(beside, 0u);
    return face;
  }
  static bool is_untouched(std::uint16_t steps) { return steps == 0; }
  static bool is_untouched(float value) {
    std::uint32_t word = 0;
    std::memcpy(&word, &value, sizeof(word));
    return word == Kernel::kUntouched;
  }
  [[nodiscard]] static std::vector<float> random_depths(TransferDice& dice, std::uint32_t size) {
    const std::uint32_t empty = dice.word() % 100;
    std::vector<float> depths(std::size_t{size} * size);
    for (float& depth : depths) depth = dice.word() % 100 < empty ? 0.0f : static_cast<float>(dice.between(0.1, 1.0));
    return depths;
  }
};

TEST_F(CloseupTransferKernel, texels_hold_the_nearest_of_what_they_cover) {
  TransferDice dice(3);
  std::size_t held = 0, empty = 0;
  for (int round = 0; round < 24; ++round) {
    TransferCase pair = dice.pair(round % 2 == 0);
    pair.to.square.origin = uvec2(pair.to.square.size, 0);
    const std::vector<float> depths = random_depths(dice, pair.from.square.size);
    ShadowMaps maps(device(), kMap);
    maps.add_face(depths, pair.from.square.origin, pair.from.square.size);
    const std::uint32_t side = pair.to.square.size;
    const TexelRect texels{uvec2(side / 8), uvec2(side)};
    const std::vector<float> found = transferred(pair, maps, texels);
    const Twin twin(pair, depths);
    for (std::uint32_t i = 0; i < side * side; ++i) {
      const uvec2 at(i % side, i / side);
      if (std::min(at.x, at.y) < texels.begin.x) {
        EXPECT_TRUE(is_untouched(found[i])) << "beside the part";
        continue;
      }
      const Twin::Bounds bounds = twin.bounds(at.x, at.y);
      const double depth = is_untouched(found[i]) ? 0.0 : static_cast<double>(found[i]);
      EXPECT_GE(depth, bounds.low * (1.0 - 2e-5) - 2e-6) << round << " at " << at.x << ',' << at.y;
      EXPECT_LE(depth, bounds.high * (1.0 + 2e-5) + 2e-6) << round << " at " << at.x << ',' << at.y;
      ++(depth > 0.0 ? held : empty);
    }
  }
  EXPECT_GT(held, 1000u);
  EXPECT_GT(empty, 1000u);
}

TEST_F(CloseupTransferKernel, depths_are_held_as_the_atlas_holds_them) {
  TransferDice dice(4);
  std::size_t held = 0;
  for (int round = 0; round < 6; ++round) {
    TransferCase pair = dice.pair(round % 2 == 0);
    pair.to.square.origin = uvec2(128, pair.to.square.size);
    ShadowMaps maps(device(), kMap);
    maps.add_face(random_depths(dice, pair.from.square.size), pair.from.square.origin, pair.from.square.size);
    const TexelRect texels = whole_face(pair.to);
    const std::vector<float> all = transferred(pair, maps, texels);
    const std::vector<float> without = transferred(pair, maps, texels, ~GLOAM_SHADOW_FREE_BITS);
    const std::vector<std::uint16_t> steps = transferred_steps(pair, maps, texels);
    for (std::size_t i = 0; i < all.size(); ++i) {
      ASSERT_EQ(is_untouched(all[i]), is_untouched(without[i]));
      if (is_untouched(all[i])) {
        EXPECT_EQ(steps[i], 0u);
        continue;
      }
      EXPECT_EQ(std::bit_cast<std::uint32_t>(without[i]),
                std::bit_cast<std::uint32_t>(all[i]) & ~GLOAM_SHADOW_FREE_BITS);
      EXPECT_EQ(static_cast<float>(steps[i]), std::floor(all[i] * 65535.0f + 0.5f));
      ++held;
    }
  }
  EXPECT_GT(held, 500u);
}

TEST_F(CloseupTransferKernel, fifteen_by_thirty_seven_texels_are_read_at_level_three) {
  // One texel of the standard face covers 15 × 37 texels in the middle of the pair's face. A single near point probes
  // which texels are read.
  TransferCase pair = TransferDice(1).pair(false);
  pair.to.right = pair.from.right;
  pair.to.up = pair.from.up;
  pair.to.origin = pair.from.origin;
  pair.to.square.size = 16;
  pair.from.square.size = 256;
  shaders::CloseupTransfer t = transfer_constants(pair.from, kMap, pair.to, whole_face(pair.to));
  t.row_u = vec3(15.0f, 0.0f, 40.0f);
  t.row_v = vec3(0.0f, 37.0f, 56.0f);
  t.back_u = vec3(1.0f, 0.0f, -40.0f) / 15.0f;
  t.back_v = vec3(0.0f, 1.0f, -56.0f) / 37.0f;
  t.begin = uvec2(0);
  t.end = uvec2(1);
  const auto looks_at = [&](uvec2 texel) {
    std::vector<float> depths(256 * 256, 0.0f);
    depths[texel.y * 256 + texel.x] = 0.9f;
    ShadowMaps maps(device(), kMap);
    maps.add_face(depths, pair.from.square.origin, 256);
    Kernel kernel(device(), shaders::closeups::transfer_comp);
    kernel.input(0, std::vector{t});
    kernel.sampled_image(1, maps.atlas_image());
    kernel.sampled_image(2, maps.pyramid_image());
    kernel.output_image(3, gpu::Format::r32_float, 16, 16);
    kernel.run(1);
    return !is_untouched(kernel.read<float>(3)[0]);
  };
  // 40…55 × 56…93: at level 3, texels 5…6 × 7…11, each of eight texels.
  for (const uvec2 inside : {uvec2(40, 56), uvec2(55, 56), uvec2(47, 95), uvec2(55, 95)})
    EXPECT_TRUE(looks_at(inside)) << inside.x << ',' << inside.y;
  for (const uvec2 outside : {uvec2(39, 60), uvec2(56, 60), uvec2(47, 55), uvec2(47, 96)})
    EXPECT_FALSE(looks_at(outside)) << outside.x << ',' << outside.y;
}

}  // namespace
}  // namespace gloam::test
