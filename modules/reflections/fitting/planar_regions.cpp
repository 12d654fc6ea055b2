// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/planar_regions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "engine/core/hash.h"
#include "engine/math/finite.h"
#include "engine/scene/assets/topology.h"

namespace gloam {
namespace {

constexpr std::uint32_t kNoFace = ~0u;
constexpr double kFarthest_m = 1e7;
constexpr double kLeastRegion_m2 = 1e-4;

bool is_usable(const dvec3& p) { return is_finite(p) && glm::length(p) <= kFarthest_m; }

/// Joins points. Cells have twice the weld distance as their side, so points near a point are in eight cells at most.
class PointWelder {
 public:
  explicit PointWelder(double weld_m) : weld_m_(weld_m) {}

  /// The first point within the weld distance; `point` itself if there is none.
  std::uint32_t add(const dvec3& point) {
    const Cell low = cell_of(point - dvec3(weld_m_));
    const Cell high = cell_of(point + dvec3(weld_m_));
    std::uint32_t nearest = kNoFace;
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) nearest = std::min(nearest, near_in({x, y, z}, point));
    if (nearest != kNoFace) return nearest;
    const auto index = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
    const auto [entry, added] = first_in_.try_emplace(cell_of(point), index);
    next_.push_back(added ? kNoFace : entry->second);
    entry->second = index;
    return index;
  }
  [[nodiscard]] const std::vector<dvec3>& points() const { return points_; }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const {
      return static_cast<std::size_t>(Hasher().value(cell[0]).value(cell[1]).value(cell[2]).digest());
    }
  };
  [[nodiscard]] Cell cell_of(const dvec3& p) const {
    Cell cell{};
    for (int i = 0; i < 3; ++i)
      cell[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor(p[i] / (2.0 * weld_m_)));
    return cell;
  }
  [[nodiscard]] std::uint32_t near_in(const Cell& cell, const dvec3& point) const {
    const auto found = first_in_.find(cell);
    std::uint32_t nearest = kNoFace;
    if (found == first_in_.end()) return nearest;
    for (std::uint32_t at = found->second; at != kNoFace; at = next_[at])
      if (glm::length(points_[at] - point) <= weld_m_) nearest = std::min(nearest, at);
    return nearest;
  }

  double weld_m_;
  std::vector<dvec3> points_;
  std::vector<std::uint32_t> next_;  // the next point of the cell
  std::unordered_map<Cell, std::uint32_t, CellHash> first_in_;
};

/// Appends a face. normal: its direction if rounding leaves it no area.
void add_face(const std::array<std::uint32_t, 3>& corners, const std::array<std::uint32_t, 3>& neighbors,
              const dvec3& normal, bool both, WeldedFaces& welded) {
  constexpr double kLeastArea_m2 = 1e-12;
  const dvec3& a = welded.positions[corners[0]];
  const dvec3 cross = glm::cross(welded.positions[corners[1]] - a, welded.positions[corners[2]] - a);
  const double length = glm::length(cross);
  welded.faces.push_back(corners);
  welded.normals.push_back(length > 2.0 * kLeastArea_m2 ? cross / length : normal);
  welded.areas_m2.push_back(std::max(0.5 * length, kLeastArea_m2));
  welded.neighbors.push_back(neighbors);
  welded.double_sided.push_back(both ? 1 : 0);
}

bool has_area(const WeldedFaces& welded, const std::array<std::uint32_t, 3>& c) {
  const dvec3& a = welded.positions[c[0]];
  const dvec3 ab = welded.positions[c[1]] - a, ac = welded.positions[c[2]] - a;
  return glm::length(glm::cross(ab, ac)) > 1e-9 * glm::length(ab) * glm::length(ac);
}

/// A plane that follows the faces added to it, weighted by area.
class GrowingPlane {
 public:
  void add(const dvec3& normal, const dvec3& center, double area_m2) {
    area_m2_ += area_m2;
    normal_sum_ += normal * area_m2;
    center_sum_ += center * area_m2;
    normal_ = glm::normalize(normal_sum_);
    offset_ = glm::dot(normal_, center_sum_ / area_m2_);
  }
  [[nodiscard]] const dvec3& normal() const { return normal_; }
  [[nodiscard]] double offset() const { return offset_; }
  [[nodiscard]] double area_m2() const { return area_m2_; }
  [[nodiscard]] bool contains(const WeldedFaces& faces, std::uint32_t face, const RegionTolerance& tolerance) const {
    if (glm::dot(faces.normals[face], normal_) < tolerance.cos_angle) return false;
    return is_near(faces, face, tolerance.distance_m);
  }
  [[nodiscard]] bool is_near(const WeldedFaces& faces, std::uint32_t face, double distance_m) const {
    for (std::size_t i = 0; i < 3; ++i)
      if (std::abs(glm::dot(normal_, faces.corner(face, i)) - offset_) > distance_m) return false;
    return true;
  }

 private:
  dvec3 normal_sum_ = dvec3(0.0);
  dvec3 center_sum_ = dvec3(0.0);
  double area_m2_ = 0.0;
  dvec3 normal_ = dvec3(0.0, 1.0, 0.0);
  double offset_ = 0.0;
};

dvec3 center_of(const WeldedFaces& faces, std::uint32_t face) {
  return (faces.corner(face, 0) + faces.corner(face, 1) + faces.corner(face, 2)) / 3.0;
}

PlanarRegion region_of(const GrowingPlane& plane, std::vector<std::uint32_t> members) {
  return {
      .normal = plane.normal(), .offset_m = plane.offset(), .area_m2 = plane.area_m2(), .faces = std::move(members)};
}

dvec3 center_of(const WeldedFaces& faces, const PlanarRegion& region) {
  dvec3 sum(0.0);
  for (const std::uint32_t face : region.faces) sum += center_of(faces, face) * faces.areas_m2[face];
  return sum / region.area_m2;
}

/// Groups of regions with one plane each. Normals and offsets stand apart because most groups are refused by them.
class CoplanarGroups {
 public:
  CoplanarGroups(const WeldedFaces& faces, const RegionTolerance& tolerance) : faces_(faces), tolerance_(tolerance) {}

  /// Adds the region to the first group whose plane it shares, else to a group of its own if there is room for one.
  void add(const PlanarRegion& region) {
    const dvec3 center = center_of(faces_, region);
    std::size_t group = find(region, center);
    if (group == planes_.size()) {
      if (group == kMostGroups) return;
      planes_.emplace_back();
      normals_.emplace_back();
      offsets_.emplace_back();
      members_.emplace_back();
    }
    planes_[group].add(region.normal, center, region.area_m2);
    normals_[group] = planes_[group].normal();
    offsets_[group] = planes_[group].offset();
    members_[group].insert(members_[group].end(), region.faces.begin(), region.faces.end());
  }
  [[nodiscard]] std::vector<PlanarRegion> regions() {
    std::vector<PlanarRegion> joined;
    for (std::size_t i = 0; i < planes_.size(); ++i) joined.push_back(region_of(planes_[i], std::move(members_[i])));
    return joined;
  }

 private:
  [[nodiscard]] std::size_t find(const PlanarRegion& region, const dvec3& center) const {
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      if (glm::dot(region.normal, normals_[i]) < tolerance_.cos_angle) continue;
      if (std::abs(glm::dot(normals_[i], center) - offsets_[i]) > tolerance_.distance_m) continue;
      const auto is_near = [&](std::uint32_t face) { return planes_[i].is_near(faces_, face, tolerance_.distance_m); };
      if (std::ranges::all_of(region.faces, is_near)) return i;
    }
    return normals_.size();
  }

  const WeldedFaces& faces_;
  const RegionTolerance& tolerance_;
  std::vector<GrowingPlane> planes_;
  std::vector<dvec3> normals_;
  std::vector<double> offsets_;
  std::vector<std::vector<std::uint32_t>> members_;
};

}  // namespace

WeldedFaces weld_faces(std::span<const FitTriangles> instances, double weld_m) {
  PointWelder welder(weld_m);
  std::vector<std::uint32_t> indices;
  std::vector<std::uint8_t> both;
  for (const FitTriangles& instance : instances) {
    std::vector<std::uint32_t> welded_of(instance.positions.size(), kNoFace);
    for (std::size_t v = 0; v < instance.positions.size(); ++v)
      if (is_usable(instance.positions[v])) welded_of[v] = welder.add(instance.positions[v]);
    for (std::size_t i = 0; i + 2 < instance.indices.size(); i += 3) {
      const std::array corners{welded_of[instance.indices[i]], welded_of[instance.indices[i + 1]],
                               welded_of[instance.indices[i + 2]]};
      if (std::ranges::any_of(corners, [](std::uint32_t corner) { return corner == kNoFace; })) continue;
      indices.insert(indices.end(), corners.begin(), corners.end());
      both.push_back(instance.double_sided ? 1 : 0);
    }
  }
  WeldedFaces welded;
  welded.positions = welder.points();
  // Positions relative to the first vertex keep their precision as floats. They are only compared for equality.
  std::vector<vec3> relative;
  relative.reserve(welded.positions.size());
  for (const dvec3& p : welded.positions) relative.emplace_back(p - welded.positions.front());
  const Topology topology = build_topology(relative, indices);
  std::vector<std::uint8_t> kept(both.size(), 0);
  for (std::size_t f = 0; f < topology.faces.size(); ++f) {
    const std::size_t source = topology.source_faces[f];
    kept[source] = 1;
    add_face({indices[3 * source], indices[3 * source + 1], indices[3 * source + 2]}, topology.neighbors[f],
             dvec3(topology.face_normals[f]), both[source] != 0, welded);
  }
  // Faces that the half-edge mesh refuses, e.g. the third face on an edge, grow alone.
  for (std::size_t source = 0; source < both.size(); ++source) {
    const std::array corners{indices[3 * source], indices[3 * source + 1], indices[3 * source + 2]};
    if (kept[source] == 0 && has_area(welded, corners))
      add_face(corners, {kNoFace, kNoFace, kNoFace}, dvec3(0.0, 1.0, 0.0), both[source] != 0, welded);
  }
  return welded;
}

std::vector<PlanarRegion> grow_planar_regions(const WeldedFaces& faces, const RegionTolerance& tolerance) {
  std::vector<std::uint32_t> seeds(faces.faces.size());
  std::iota(seeds.begin(), seeds.end(), 0u);
  std::ranges::stable_sort(seeds,
                           [&](std::uint32_t a, std::uint32_t b) { return faces.areas_m2[a] > faces.areas_m2[b]; });
  std::vector<std::uint8_t> taken(faces.faces.size(), 0);
  std::vector<PlanarRegion> regions;
  for (const std::uint32_t seed : seeds) {
    if (taken[seed] != 0) continue;
    GrowingPlane plane;
    std::vector<std::uint32_t> members;
    const auto take = [&](std::uint32_t face) {
      taken[face] = 1;
      members.push_back(face);
      plane.add(faces.normals[face], center_of(faces, face), faces.areas_m2[face]);
    };
    take(seed);
    for (std::size_t at = 0; at < members.size(); ++at)
      for (const std::uint32_t next : faces.neighbors[members[at]])
        if (next != kNoFace && taken[next] == 0 && plane.contains(faces, next, tolerance)) take(next);
    regions.push_back(region_of(plane, std::move(members)));
  }
  return regions;
}

std::vector<PlanarRegion> join_coplanar(const WeldedFaces& faces, std::span<const PlanarRegion> regions,
                                        const RegionTolerance& tolerance) {
  std::vector<std::uint32_t> order;
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (regions[i].area_m2 >= kLeastRegion_m2) order.push_back(static_cast<std::uint32_t>(i));
  std::ranges::stable_sort(order,
                           [&](std::uint32_t a, std::uint32_t b) { return regions[a].area_m2 > regions[b].area_m2; });
  CoplanarGroups groups(faces, tolerance);
  for (const std::uint32_t index : order) groups.add(regions[index]);
  return groups.regions();
}

}  // namespace gloam
