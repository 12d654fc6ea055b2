// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/planes_twin.h"

#include <algorithm>
#include <limits>

namespace gloam {
namespace {

constexpr double kNoHeight = -std::numeric_limits<double>::infinity();

/// Level 0: slopes by least squares (0 if a texel is empty), raised until no depth is above.
dvec4 least_squares_plane(const PlaneFace& face, uvec2 block) {
  glm::dvec2 moments(0.0), spread(0.0);
  double nearest = 0.0;
  bool full = true;
  for_square(kPlaneBlock, [&](uvec2 texel) {
    const glm::dvec2 offset = from_middle(texel, kPlaneBlock);
    const double depth = face.depth(block * kPlaneBlock + texel);
    moments += offset * depth;
    spread += offset * offset;
    nearest = std::max(nearest, depth);
    full = full && depth > 0.0;
  });
  const glm::dvec2 slope = full ? moments / spread : glm::dvec2(0.0);
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
  const glm::dvec2 slope(sum.y / 4.0, sum.z / 4.0);
  for (std::uint32_t i = 0; i < 4; ++i)
    if (children[i].w > 0.0)
      for_square(side, [&](uvec2 texel) {
        const glm::dvec2 offset = from_middle(uvec2(i % 2, i / 2) * side + texel, 2 * side);
        height = std::max(height, plane_depth(children[i], from_middle(texel, side)) - dot(slope, offset));
      });
  return {height, slope, nearest};
}

/// Four blocks of level 0. The planes of three fall towards the fourth, which is empty, so that the plane of level 1
/// falls below 0 there.
double saw_tooth(std::uint32_t x, std::uint32_t y) {
  if (x >= kPlaneBlock && y >= kPlaneBlock) return 0.0;
  return (2.0 * kPlaneBlock - x % kPlaneBlock - y % kPlaneBlock) / (2.0 * kPlaneBlock);
}

Relief any_relief(std::mt19937& random) {
  return static_cast<Relief>(random_below(random, static_cast<std::uint32_t>(Relief::count)));
}

}  // namespace

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

void paint_relief(PlaneFace& face, uvec2 begin, uvec2 end, Relief relief, std::mt19937& random) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const uvec2 spike = begin + random_below(random, end - begin);
  const double middle = relief == Relief::faint ? 1e-6 : uniform(0.2, 0.8);
  const double reach = relief == Relief::flat ? 0.0 : 0.4 * std::min(middle, 1.0 - middle);
  const glm::dvec2 slope = glm::dvec2(uniform(-reach, reach), uniform(-reach, reach)) / glm::dvec2(end - begin);
  const std::uint32_t stair = 1 + random_below(random, 11);
  for (std::uint32_t y = begin.y; y < end.y; ++y)
    for (std::uint32_t x = begin.x; x < end.x; ++x) {
      double depth = middle + dot(slope, glm::dvec2(x, y) - 0.5 * glm::dvec2(begin + end));
      if (relief == Relief::steps) depth = middle * (0.3 + 0.7 * ((x + 2 * y) / stair % 2));
      if (relief == Relief::noise) depth = uniform(1e-6, 1.0);
      if (relief == Relief::bright) depth = 1.0 - std::ldexp(random_below(random, 4), -24);
      if (relief == Relief::saw) depth = middle * saw_tooth(x % (2 * kPlaneBlock), y % (2 * kPlaneBlock));
      if (relief == Relief::spike && uvec2(x, y) == spike) depth = 1.0;
      if (relief == Relief::empty || (relief == Relief::holes && random_below(random, 20) == 0)) depth = 0.0;
      face.depths[std::size_t{y} * face.size + x] = static_cast<float>(depth);
    }
}

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

}  // namespace gloam
