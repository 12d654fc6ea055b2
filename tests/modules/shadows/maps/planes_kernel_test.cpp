// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/modules/shadows/support/planes.h"

// Planes of shadow maps (planes.comp) against all texels of their blocks and against planes made in double precision.

namespace gloam::test {
namespace {

using glm::dvec2;

constexpr std::uint32_t kPlaneAtlas = 512;
constexpr std::uint32_t kLargestPlaneFace = kPlaneAtlas;
constexpr std::uint32_t kPlaneBlock = GLOAM_SHADOW_PLANE_BLOCK;
constexpr std::uint32_t kCoarsestBlock = kPlaneBlock << (GLOAM_SHADOW_PLANE_LEVELS - 1);
constexpr double kNoHeight = -std::numeric_limits<double>::infinity();

/// Calls use(texel) for all texels of a square.
template <class Use>
void for_square(std::uint32_t side, const Use& use) {
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) use(uvec2(x, y));
}

/// Calls use(level, block) for all blocks of a face.
template <class Use>
void for_blocks(const PlaneFace& face, const Use& use) {
  for (std::uint32_t level = 0; level < GLOAM_SHADOW_PLANE_LEVELS; ++level)
    for_square(face.blocks(level), [&](uvec2 block) { use(level, block); });
}

/// From the middle of a square of this many texels to one of its texels.
dvec2 from_middle(uvec2 texel, std::uint32_t side) { return dvec2(texel) - 0.5 * (side - 1.0); }

double plane_depth(const dvec4& plane, dvec2 offset) { return plane.x + plane.y * offset.x + plane.z * offset.y; }

/// Bound on the rounding of a plane anywhere in its block. nearest: of the block. Planes are at most 5 · 2^level times
/// as high as the nearest depth. A level rounds fewer than ten such values to 24 bits and inherits the errors of the
/// finer levels.
double plane_rounding(double nearest, std::uint32_t level) { return std::ldexp(nearest, static_cast<int>(level) - 18); }
/// Bound on the rounding of a slope: a sum of 64 depths times at most 3.5, divided by 336.
double slope_rounding(double nearest) { return std::ldexp(nearest, -20); }
/// Bound on the rounding of a height whose slopes are rounded, too.
double height_rounding(double nearest, std::uint32_t level) {
  return std::ldexp(nearest, static_cast<int>(level) - 16);
}

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

/// Level 0: slopes by least squares (0 if a texel is empty), raised until no depth is above.
dvec4 least_squares_plane(const PlaneFace& face, uvec2 block) {
  dvec2 moments(0.0), spread(0.0);
  double nearest = 0.0;
  bool full = true;
  for_square(kPlaneBlock, [&](uvec2 texel) {
    const dvec2 offset = from_middle(texel, kPlaneBlock);
    const double depth = face.depth(block * kPlaneBlock + texel);
    moments += offset * depth;
    spread += offset * offset;
    nearest = std::max(nearest, depth);
    full = full && depth > 0.0;
  });
  const dvec2 slope = full ? moments / spread : dvec2(0.0);
  double height = kNoHeight;
  for_square(kPlaneBlock, [&](uvec2 texel) {
    const double depth = face.depth(block * kPlaneBlock + texel);
    height = std::max(height, depth - dot(slope, from_middle(texel, kPlaneBlock)));
  });
  return {height, slope, nearest};
}

/// A plane with the mean slope of four, raised until it is above all of them that are not empty. side: texels of a
/// child.
dvec4 plane_above(const dvec4 (&children)[4], std::uint32_t side) {
  dvec4 sum(0.0);
  double nearest = 0.0, height = kNoHeight;
  for (const dvec4& child : children) sum += child, nearest = std::max(nearest, child.w);
  if (nearest == 0.0) return dvec4(0.0);
  const dvec2 slope(sum.y / 4.0, sum.z / 4.0);
  for (std::uint32_t i = 0; i < 4; ++i)
    if (children[i].w > 0.0)
      for_square(side, [&](uvec2 texel) {
        const dvec2 offset = from_middle(uvec2(i % 2, i / 2) * side + texel, 2 * side);
        height = std::max(height, plane_depth(children[i], from_middle(texel, side)) - dot(slope, offset));
      });
  return {height, slope, nearest};
}

/// All levels of a face, blocks row by row.
std::vector<std::vector<dvec4>> expected_planes(const PlaneFace& face) {
  std::vector<std::vector<dvec4>> levels(GLOAM_SHADOW_PLANE_LEVELS);
  for_blocks(face, [&](std::uint32_t level, uvec2 block) {
    if (level == 0) {
      levels[0].push_back(least_squares_plane(face, block));
      return;
    }
    dvec4 children[4];
    for (std::uint32_t i = 0; i < 4; ++i) {
      const uvec2 child = block * 2u + uvec2(i % 2, i / 2);
      children[i] = levels[level - 1][child.y * face.blocks(level - 1) + child.x];
    }
    levels[level].push_back(plane_above(children, kPlaneBlock << (level - 1)));
  });
  return levels;
}

enum class Relief { flat, slanted, steps, empty, holes, noise, spike, faint, bright, saw, count };

std::uint32_t random_below(std::mt19937& random, std::uint32_t end) {
  return static_cast<std::uint32_t>(random() % end);
}
uvec2 random_below(std::mt19937& random, uvec2 end) {
  return {random_below(random, end.x), random_below(random, end.y)};
}

/// Four blocks of level 0. The planes of three fall towards the fourth, which is empty, so that the plane of level 1
/// falls below 0 there.
double saw_tooth(std::uint32_t x, std::uint32_t y) {
  if (x >= kPlaneBlock && y >= kPlaneBlock) return 0.0;
  return (2.0 * kPlaneBlock - x % kPlaneBlock - y % kPlaneBlock) / (2.0 * kPlaneBlock);
}

/// Overwrites a rectangle of a face.
void paint_relief(PlaneFace& face, uvec2 begin, uvec2 end, Relief relief, std::mt19937& random) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const uvec2 spike = begin + random_below(random, end - begin);
  const double middle = relief == Relief::faint ? 1e-6 : uniform(0.2, 0.8);
  const double reach = relief == Relief::flat ? 0.0 : 0.4 * std::min(middle, 1.0 - middle);
  const dvec2 slope = dvec2(uniform(-reach, reach), uniform(-reach, reach)) / dvec2(end - begin);
  const std::uint32_t stair = 1 + random_below(random, 11);
  for (std::uint32_t y = begin.y; y < end.y; ++y)
    for (std::uint32_t x = begin.x; x < end.x; ++x) {
      double depth = middle + dot(slope, dvec2(x, y) - 0.5 * dvec2(begin + end));
      if (relief == Relief::steps) depth = middle * (0.3 + 0.7 * ((x + 2 * y) / stair % 2));
      if (relief == Relief::noise) depth = uniform(1e-6, 1.0);
      if (relief == Relief::bright) depth = 1.0 - std::ldexp(random_below(random, 4), -24);
      if (relief == Relief::saw) depth = middle * saw_tooth(x % (2 * kPlaneBlock), y % (2 * kPlaneBlock));
      if (relief == Relief::spike && uvec2(x, y) == spike) depth = 1.0;
      if (relief == Relief::empty || (relief == Relief::holes && random_below(random, 20) == 0)) depth = 0.0;
      face.depths[std::size_t{y} * face.size + x] = static_cast<float>(depth);
    }
}

Relief any_relief(std::mt19937& random) {
  return static_cast<Relief>(random_below(random, static_cast<std::uint32_t>(Relief::count)));
}

/// One relief with rectangles of others.
PlaneFace random_face(uvec2 origin, std::uint32_t size, std::mt19937& random) {
  PlaneFace face{origin, size, std::vector<float>(std::size_t{size} * size)};
  paint_relief(face, uvec2(0), uvec2(size), any_relief(random), random);
  for (std::uint32_t left = size * size / 1024; left > 0; --left) {
    const uvec2 begin = random_below(random, uvec2(size));
    paint_relief(face, begin, min(begin + 1u + random_below(random, uvec2(40)), uvec2(size)), any_relief(random),
                 random);
  }
  return face;
}

/// Faces of many sizes that touch each other and the edges of the atlas.
std::vector<PlaneFace> random_faces(std::mt19937& random) {
  struct Place {
    std::uint32_t size;
    uvec2 origin;
  };
  const std::vector<Place> places = {{256, {0, 0}},  {256, {0, 256}}, {128, {256, 0}},  {128, {384, 128}},
                                     {64, {384, 0}}, {64, {448, 64}}, {64, {256, 192}}, {32, {448, 0}},
                                     {16, {496, 0}}, {16, {480, 16}}, {16, {256, 128}}};
  std::vector<PlaneFace> faces;
  for (const Place& place : places) faces.push_back(random_face(place.origin, place.size, random));
  PlaneFace& empty = faces[5];
  paint_relief(empty, uvec2(0), uvec2(empty.size), Relief::empty, random);
  return faces;
}

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

TEST_F(ShadowPlanes, planes_equal_those_made_in_double_precision) {
  std::mt19937 random(5);
  for (int i = 0; i < 4; ++i) {
    const auto faces = random_faces(random);
    const MadePlanes planes = made(faces);
    for (const PlaneFace& face : faces) expect_twins(face, planes);
  }
}

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
