// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "modules/shadows/reference/kernel_checks.h"
#include "tests/modules/shadows/support/planes.h"

// Planes of shadow maps (planes.comp) against all texels of their blocks and against planes made in double precision.

namespace gloam::test {
namespace {

using glm::dvec2;

constexpr std::uint32_t kLargestPlaneFace = kPlaneAtlas;
constexpr std::uint32_t kCoarsestBlock = kPlaneBlock << (GLOAM_SHADOW_PLANE_LEVELS - 1);

/// Remembers the largest error in units of its tolerance.
class WorstError {
 public:
  void add(double error, double tolerance, const PlaneFace& face, std::uint32_t level, uvec2 block) {
    const double ratio = std::isnan(error) ? std::numeric_limits<double>::infinity()
                         : error <= 0.0    ? 0.0
                                           : error / tolerance;
    if (ratio <= ratio_) return;
    ratio_ = ratio;
    error_ = error;
    where_ = "face of " + std::to_string(face.size) + " at " + std::to_string(face.origin.x) + ", " +
             std::to_string(face.origin.y) + ": level " + std::to_string(level) + ", block " + std::to_string(block.x) +
             ", " + std::to_string(block.y);
  }
  void expect_within_tolerance(const char* what) const {
    EXPECT_LE(ratio_, 1.0) << what << ": " << where_ << ", error " << error_;
  }

 private:
  double ratio_ = 0.0;
  double error_ = 0.0;
  std::string where_;
};

class ShadowPlanes : public KernelTest {
 protected:
  /// Draws the faces and makes all their planes.
  static MadePlanes made(const std::vector<PlaneFace>& faces, std::uint32_t atlas = kPlaneAtlas,
                         gpu::Format format = gpu::Format::r32_float) {
    PlaneImages images(device(), atlas, format);
    images.draw(faces);
    images.make(faces);
    return images.read();
  }
  /// No depth of a block is above its plane, and w is the greatest depth. Empty texels count in level 0 only: a slanted
  /// plane of a coarser level may fall below 0 there.
  /// fetch_rounding: relative error of depths that the kernel fetches.
  static void expect_bounds(const PlaneFace& face, const MadePlanes& made, double fetch_rounding = 0.0) {
    WorstError above, nearest_depth;
    for_blocks(face, [&](std::uint32_t level, uvec2 block) {
      const dvec4 plane = made.plane(face, level, block);
      const std::uint32_t side = kPlaneBlock << level;
      double nearest = 0.0;
      for_square(side, [&](uvec2 texel) {
        const double depth = face.depth(block * side + texel);
        const double excess = depth - plane_depth(plane, from_middle(texel, side));
        nearest = std::max(nearest, depth);
        if (level == 0 || depth > 0.0) above.add(excess, plane_rounding(plane.w, level), face, level, block);
      });
      nearest_depth.add(std::abs(plane.w - nearest), fetch_rounding * nearest, face, level, block);
    });
    above.expect_within_tolerance("a depth is above its plane");
    nearest_depth.expect_within_tolerance("w is not the greatest depth");
  }
  static void expect_twins(const PlaneFace& face, const MadePlanes& made) {
    const auto expected = expected_planes(face);
    WorstError height, slope;
    for_blocks(face, [&](std::uint32_t level, uvec2 block) {
      const dvec4 twin = expected[level][block.y * face.blocks(level) + block.x];
      const dvec4 error = abs(made.plane(face, level, block) - twin);
      height.add(error.x, height_rounding(twin.w, level), face, level, block);
      slope.add(error.y, slope_rounding(twin.w), face, level, block);
      slope.add(error.z, slope_rounding(twin.w), face, level, block);
    });
    height.expect_within_tolerance("height");
    slope.expect_within_tolerance("slope");
  }
};

TEST_F(ShadowPlanes, no_depth_is_above_its_planes_and_w_is_the_nearest) {
  std::mt19937 random(1);
  int empty = 0, partly = 0, full = 0;
  for (int i = 0; i < 4; ++i) {
    const auto faces = random_faces(random);
    const MadePlanes planes = made(faces);
    for (const PlaneFace& face : faces) {
      expect_bounds(face, planes);
      for_square(face.blocks(0), [&](uvec2 block) {
        int occupied = 0;
        for_square(kPlaneBlock, [&](uvec2 texel) { occupied += face.depth(block * kPlaneBlock + texel) > 0.0; });
        ++(occupied == 0 ? empty : occupied < 64 ? partly : full);
      });
    }
  }
  EXPECT_GT(std::min({empty, partly, full}), 500) << "the faces must hold blocks of all three kinds";
}

TEST_F(ShadowPlanes, planes_of_level_0_touch_a_depth) {
  std::mt19937 random(2);
  const auto faces = random_faces(random);
  const MadePlanes planes = made(faces);
  WorstError gap;
  for (const PlaneFace& face : faces)
    for_square(face.blocks(0), [&](uvec2 block) {
      const dvec4 plane = planes.plane(face, 0, block);
      double least = std::numeric_limits<double>::infinity();
      for_square(kPlaneBlock, [&](uvec2 texel) {
        const double depth = face.depth(block * kPlaneBlock + texel);
        least = std::min(least, plane_depth(plane, from_middle(texel, kPlaneBlock)) - depth);
      });
      gap.add(least, plane_rounding(plane.w, 0), face, 0, block);
    });
  gap.expect_within_tolerance("a plane is above all depths");
}

TEST_F(ShadowPlanes, planes_of_coarser_levels_bound_and_touch_the_finer_ones) {
  std::mt19937 random(3);
  const auto faces = random_faces(random);
  const MadePlanes planes = made(faces);
  WorstError above, gap;
  for (const PlaneFace& face : faces)
    for_blocks(face, [&](std::uint32_t level, uvec2 block) {
      if (level == 0) return;
      const dvec4 plane = planes.plane(face, level, block);
      const std::uint32_t side = kPlaneBlock << (level - 1);
      double least = std::numeric_limits<double>::infinity();
      for_square(2 * side, [&](uvec2 texel) {
        const dvec4 child = planes.plane(face, level - 1, block * 2u + texel / side);
        const double under = plane_depth(child, from_middle(texel % side, side));
        if (child.w > 0.0) least = std::min(least, plane_depth(plane, from_middle(texel, 2 * side)) - under);
      });
      if (plane.w == 0.0) least = plane == dvec4(0.0) ? 0.0 : 1.0;
      above.add(-least, plane_rounding(plane.w, level), face, level, block);
      gap.add(least, plane_rounding(plane.w, level), face, level, block);
    });
  above.expect_within_tolerance("a plane is below a finer one");
  gap.expect_within_tolerance("a plane is above all finer ones");
}

TEST_F(ShadowPlanes, a_single_slanted_surface_has_its_own_slopes_and_tight_planes_at_all_levels) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (const double middle : {1e-5, 0.01, 0.5, 0.9}) {
    std::vector<PlaneFace> faces = random_faces(random);
    std::vector<dvec2> slopes;
    for (PlaneFace& face : faces) {
      const double reach = 0.9 * std::min(middle, 1.0 - middle) / face.size;
      slopes.emplace_back(part(random) * reach, part(random) * reach);
      for_square(face.size, [&](uvec2 texel) {
        face.depths[std::size_t{texel.y} * face.size + texel.x] =
            static_cast<float>(middle + dot(slopes.back(), from_middle(texel, face.size)));
      });
    }
    const MadePlanes planes = made(faces);
    WorstError slope, excess;
    for (std::size_t i = 0; i < faces.size(); ++i)
      for_blocks(faces[i], [&](std::uint32_t level, uvec2 block) {
        const dvec4 plane = planes.plane(faces[i], level, block);
        const dvec2 error = abs(dvec2(plane.y, plane.z) - slopes[i]);
        slope.add(error.x, slope_rounding(plane.w), faces[i], level, block);
        slope.add(error.y, slope_rounding(plane.w), faces[i], level, block);
        const std::uint32_t side = kPlaneBlock << level;
        for_square(side, [&](uvec2 texel) {
          const double gap = plane_depth(plane, from_middle(texel, side)) - faces[i].depth(block * side + texel);
          excess.add(gap, height_rounding(plane.w, level), faces[i], level, block);
        });
      });
    slope.expect_within_tolerance("slope");
    excess.expect_within_tolerance("a plane is above its surface");
  }
}

// Hard case: selftest.planes
TEST_F(ShadowPlanes, planes_equal_those_made_in_double_precision) {
  std::mt19937 random(5);
  for (int i = 0; i < 4; ++i) {
    const auto faces = random_faces(random);
    const MadePlanes planes = made(faces);
    for (const PlaneFace& face : faces) expect_twins(face, planes);
  }
}

TEST_F(ShadowPlanes, hold_in_the_self_test) { expect_holds(shadow_kernel_checks()); }

TEST_F(ShadowPlanes, a_face_as_large_as_the_atlas_has_all_planes) {
  std::mt19937 random(6);
  const std::vector<PlaneFace> faces = {random_face(uvec2(0), kLargestPlaneFace, random)};
  const MadePlanes planes = made(faces);
  expect_bounds(faces[0], planes);
  expect_twins(faces[0], planes);
}

TEST_F(ShadowPlanes, sixteen_bits_give_planes_of_rounded_depths) {
  std::mt19937 random(7);
  auto faces = random_faces(random);
  const MadePlanes planes = made(faces, kPlaneAtlas, gpu::Format::r16_unorm);
  for (PlaneFace& face : faces) {
    for (float& depth : face.depths) depth = static_cast<float>(std::lround(depth * 65535.0f)) / 65535.0f;
    expect_bounds(face, planes, std::ldexp(1.0, -23));  // devices may multiply by a rounded 1 / 65535
    expect_twins(face, planes);
  }
}

TEST_F(ShadowPlanes, a_large_atlas_has_planes_up_to_its_edge) {
  std::mt19937 random(9);
  const std::vector<PlaneFace> faces = {random_face({2048, 0}, 2048, random)};
  expect_bounds(faces[0], made(faces, 4096));
}

/// Marks the planes that must be written for a part. Those whose depths all belong to it must equal the planes of the
/// whole face.
void expect_part(const PlanePart& part, const MadePlanes& planes, const MadePlanes& all, std::vector<bool>& named) {
  int different = 0;
  for_blocks(*part.face, [&](std::uint32_t level, uvec2 block) {
    // The coarser levels are made together, for whole blocks of the last one.
    const std::uint32_t unit = level == 0 ? kPlaneBlock : kCoarsestBlock, side = kPlaneBlock << level;
    const uvec2 at = block * side;
    if (any(lessThan(at / unit, part.begin / unit)) || any(greaterThan(at / unit, (part.end - 1u) / unit))) return;
    named[planes.index(*part.face, level, block)] = true;
    if (level > 0 && (any(lessThan(at, part.begin)) || any(greaterThan(at + side, part.end)))) return;
    different += planes.plane(*part.face, level, block) != all.plane(*part.face, level, block);
  });
  EXPECT_EQ(different, 0) << "part of a face of " << part.face->size;
}

TEST_F(ShadowPlanes, only_planes_of_the_named_parts_are_written) {
  std::mt19937 random(8);
  const auto faces = random_faces(random);
  // Single blocks, edges inside blocks, more than a workgroup, faces smaller than a block of the last level.
  const std::vector<PlanePart> parts = {{&faces[0], {16, 24}, {24, 32}},    {&faces[0], {77, 5}, {131, 70}},
                                        {&faces[0], {64, 192}, {256, 256}}, {&faces[2], {127, 127}, {128, 128}},
                                        {&faces[3], {0, 0}, {64, 64}},      {&faces[7], {8, 0}, {16, 32}},
                                        {&faces[8], {0, 8}, {8, 16}},       {&faces[1], {64, 0}, {65, 256}}};
  PlaneImages images(device(), kPlaneAtlas);
  images.draw(faces);
  images.make(parts);
  const MadePlanes planes = images.read(), all = made(faces);
  std::vector<bool> named(planes.texels.size());
  for (const PlanePart& part : parts) expect_part(part, planes, all, named);
  int missing = 0, foreign = 0;
  for (std::size_t i = 0; i < named.size(); ++i) {
    const bool written = planes.texels[i] != PlaneImages::kUnwritten;
    missing += named[i] && !written;
    foreign += written && !named[i];
  }
  EXPECT_EQ(missing, 0);
  EXPECT_EQ(foreign, 0) << "planes outside the named parts were written";
}

TEST_F(ShadowPlanes, a_part_that_changes_updates_all_planes_above_it) {
  std::mt19937 random(10);
  auto faces = random_faces(random);
  PlaneImages images(device(), kPlaneAtlas);
  images.draw(faces);
  images.make(faces);
  std::vector<PlanePart> parts;
  for (PlaneFace& face : faces) {
    const uvec2 begin = random_below(random, uvec2(face.size));
    const uvec2 end = min(begin + 1u + random_below(random, uvec2(90)), uvec2(face.size));
    paint_relief(face, begin, end, parts.size() % 3 == 0 ? Relief::empty : Relief::noise, random);
    parts.push_back({&face, begin, end});
  }
  images.draw(faces);
  images.make(parts);
  EXPECT_EQ(images.read().texels, made(faces).texels);
}

}  // namespace
}  // namespace gloam::test
