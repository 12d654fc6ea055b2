// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/face_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "modules/shadows/atlas/face_casters.h"

namespace gloam {
namespace {

constexpr std::uint32_t kLeastPartial = 64;     // texels of a face's side; smaller faces are drawn whole
constexpr std::uint64_t kRegionCost = 64 * 64;  // texels that cost as much as one more region
constexpr double kWholeShare = 0.75;  // share of a face; when regions cover more, the whole face costs no more
constexpr double kMargin = 2.0;       // texels of margin at each side
constexpr double kClipShare = 0.5;    // share of the near plane's depth; nothing nearer is drawn

/// Bounds of points in a face, in units of its half extent, x to the right and y upward.
struct FaceBounds {
  glm::dvec2 low = glm::dvec2(std::numeric_limits<double>::infinity());
  glm::dvec2 high = glm::dvec2(-std::numeric_limits<double>::infinity());
  void grow(const glm::dvec2& place) {
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
};

/// The corners of a box in a face's axes: right, up, forward.
std::array<dvec3, 8> corners_along(const ShadowFace& face, const CasterBox& box) {
  const dvec3 right(face.right), up(face.up), forward(face.forward);
  std::array<dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const dvec3 corner((i & 1) == 0 ? box.low.x : box.high.x, (i & 2) == 0 ? box.low.y : box.high.y,
                       (i & 4) == 0 ? box.low.z : box.high.z);
    corners[i] = {glm::dot(right, corner), glm::dot(up, corner), glm::dot(forward, corner)};
  }
  return corners;
}

FaceBounds orthographic_bounds(const ShadowFace& face, const std::array<dvec3, 8>& corners) {
  FaceBounds bounds;
  for (const dvec3& corner : corners) bounds.grow(glm::dvec2(corner) / static_cast<double>(face.half_extent_m));
  return bounds;
}

/// Bounds of the part of the box beyond kClipShare of the near plane.
FaceBounds perspective_bounds(const ShadowFace& face, const std::array<dvec3, 8>& corners) {
  FaceBounds bounds;
  const double near = kClipShare * static_cast<double>(face.clip_m());
  const auto grow = [&](const dvec3& point) {
    bounds.grow(glm::dvec2(point) / (point.z * static_cast<double>(face.tan_half)));
  };
  for (std::size_t i = 0; i < 8; ++i) {
    const dvec3& corner = corners[i];
    if (corner.z >= near) grow(corner);
    for (const std::size_t axis : {1u, 2u, 4u}) {
      const dvec3& other = corners[i ^ axis];
      if ((corner.z >= near) == (other.z >= near) || (i & axis) != 0) continue;
      dvec3 crossing = corner + (other - corner) * ((near - corner.z) / (other.z - corner.z));
      crossing.z = near;
      grow(crossing);
    }
  }
  return bounds;
}

std::uint32_t texel_down(double place, std::uint32_t size) {
  const double texel = std::floor(place / kRegionStep) * kRegionStep;
  return static_cast<std::uint32_t>(std::clamp(texel, 0.0, static_cast<double>(size)));
}

std::uint32_t texel_up(double place, std::uint32_t size) {
  const double texel = std::ceil(place / kRegionStep) * kRegionStep;
  return static_cast<std::uint32_t>(std::clamp(texel, 0.0, static_cast<double>(size)));
}

TexelRect joined(const TexelRect& a, const TexelRect& b) {
  return {glm::min(a.begin, b.begin), glm::max(a.end, b.end)};
}

bool overlap(const TexelRect& a, const TexelRect& b) {
  return a.begin.x < b.end.x && b.begin.x < a.end.x && a.begin.y < b.end.y && b.begin.y < a.end.y;
}

/// Cost of joining two regions, in texels; −∞ when they overlap and must be joined.
double growth(const TexelRect& a, const TexelRect& b) {
  if (overlap(a, b)) return -std::numeric_limits<double>::infinity();
  return static_cast<double>(joined(a, b).texels()) - static_cast<double>(a.texels() + b.texels() + kRegionCost);
}

/// Joins the two regions with the least cost, if that saves something or there are too many. Returns false when nothing
/// was joined.
bool join_two(std::vector<TexelRect>& regions) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t first = 0, second = 0;
  for (std::size_t a = 0; a < regions.size(); ++a)
    for (std::size_t b = a + 1; b < regions.size(); ++b)
      if (const double cost = growth(regions[a], regions[b]); cost < least) least = cost, first = a, second = b;
  if (second == 0 || (least > 0.0 && regions.size() <= kMostRegions)) return false;
  regions[first] = joined(regions[first], regions[second]);
  regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(second));
  return true;
}

}  // namespace

TexelRect whole_face(const ShadowFace& face) { return {uvec2(0), uvec2(face.square.size)}; }

TexelRect covered_texels(const ShadowFace& face, const dvec3& low, const dvec3& high) {
  return covered_texels(face, CasterBox{low, high});
}

TexelRect covered_texels(const ShadowFace& face, const CasterBox& box) {
  if (!box.known()) return whole_face(face);
  const CasterBox relative = relative_box(face.origin, box);
  const std::array<dvec3, 8> corners = corners_along(face, relative);
  const bool perspective = face.tan_half > 0.0f;
  const FaceBounds bounds = perspective ? perspective_bounds(face, corners) : orthographic_bounds(face, corners);
  if (!(bounds.low.x <= bounds.high.x)) return {};  // the whole box is behind the light
  const std::uint32_t size = face.square.size;
  const double half = 0.5 * size;
  const glm::dvec2 low(half + half * bounds.low.x - kMargin, half - half * bounds.high.y - kMargin);
  const glm::dvec2 high(half + half * bounds.high.x + kMargin, half - half * bounds.low.y + kMargin);
  if (!(glm::length(low) < 1e15 && glm::length(high) < 1e15)) return whole_face(face);  // NaN or infinity
  return {{texel_down(low.x, size), texel_down(low.y, size)}, {texel_up(high.x, size), texel_up(high.y, size)}};
}

std::vector<TexelRect> covered_regions(const ShadowFace& face, std::span<const CasterBox> boxes) {
  const FaceVolume volume = face_volume(face);
  const auto limit = static_cast<std::uint64_t>(kWholeShare * static_cast<double>(whole_face(face).texels()));
  std::vector<TexelRect> regions;
  for (const CasterBox& box : boxes) {
    if (!may_see(volume, box)) continue;
    const TexelRect covered = covered_texels(face, box);
    if (covered.empty()) continue;
    if (face.square.size < kLeastPartial) return {whole_face(face)};
    regions.push_back(covered);
    while (join_two(regions)) {
    }
    std::uint64_t texels = 0;
    for (const TexelRect& region : regions) texels += region.texels();
    if (texels > limit) return {whole_face(face)};
  }
  return regions;
}

}  // namespace gloam
