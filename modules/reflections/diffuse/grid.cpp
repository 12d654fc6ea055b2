// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/diffuse/grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "engine/ecs/view.h"
#include "engine/math/finite.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"

namespace gloam {
namespace {

constexpr std::uint32_t kMostAlong = 256;  // cells along an axis
constexpr std::uint32_t kInsideRays = 64;
constexpr double kMostInside = 0.25, kOpen = 0.02;

using Place = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // of a cell

SurfaceBounds bounds_of(std::span<const SurfaceBounds> surfaces, double unit_m) {
  SurfaceBounds all = surfaces.front();
  for (const SurfaceBounds& one : surfaces) {
    all.least = glm::min(all.least, one.least);
    all.most = glm::max(all.most, one.most);
  }
  all.most.y = std::max(all.most.y, all.least.y + 2.0 * unit_m);
  for (int axis = 0; axis < 3; ++axis) all.most[axis] = std::max(all.most[axis], all.least[axis] + 0.1 * unit_m);
  return all;
}

glm::uvec3 counts_for(const dvec3& extent, double side) {
  glm::uvec3 counts(1u);
  for (int axis = 0; axis < 3; ++axis)
    counts[axis] =
        std::clamp(static_cast<std::uint32_t>(std::lround(std::min(extent[axis] / side, 1e6))), 1u, kMostAlong);
  return counts;
}

/// Cells of the grid that surfaces touch; more than `most` if there are more, not all of them then.
std::set<Place> touched(std::span<const SurfaceBounds> surfaces, const SurfaceBounds& all, const glm::uvec3& counts,
                        std::size_t most) {
  std::set<Place> found;
  const dvec3 cell = (all.most - all.least) / dvec3(counts);
  const auto index = [&](double at, int axis) {
    const double place = std::floor((at - all.least[axis]) / cell[axis]);
    return static_cast<std::uint32_t>(std::clamp(place, 0.0, static_cast<double>(counts[axis] - 1)));
  };
  for (const SurfaceBounds& one : surfaces) {
    for (std::uint32_t z = index(one.least.z, 2); z <= index(one.most.z, 2); ++z)
      for (std::uint32_t y = index(one.least.y, 1); y <= index(one.most.y, 1); ++y)
        for (std::uint32_t x = index(one.least.x, 0); x <= index(one.most.x, 0); ++x) {
          found.insert({z, y, x});
          if (found.size() > most) return found;
        }
  }
  return found;
}

}  // namespace

std::vector<SurfaceBounds> triangle_bounds(const World& world) {
  const auto& assets = world.resource<SceneAssets>();
  std::vector<SurfaceBounds> bounds;
  world.view<const MeshInstance, const WorldTransform>().each(
      [&](Entity, const MeshInstance& drawn, const WorldTransform& transform) {
        if (drawn.mesh >= assets.meshes.size()) return;
        for (const Primitive& primitive : assets.meshes[drawn.mesh].primitives)
          for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            SurfaceBounds one{dvec3(1e300), dvec3(-1e300)};
            for (std::size_t k = i; k < i + 3; ++k) {
              if (primitive.indices[k] >= primitive.positions.size()) continue;
              const dvec3 corner(transform.matrix * dvec4(dvec3(primitive.positions[primitive.indices[k]]), 1.0));
              one.least = glm::min(one.least, corner);
              one.most = glm::max(one.most, corner);
            }
            const bool usable = is_finite(one.least) && is_finite(one.most) && one.least.x <= one.most.x;
            if (usable && std::abs(one.least.x) < 1e200) bounds.push_back(one);
          }
      });
  return bounds;
}

std::vector<GridCell> occupied_cells(std::span<const SurfaceBounds> surfaces, std::uint32_t most, double unit_m) {
  if (surfaces.empty() || most == 0) return {};
  const SurfaceBounds all = bounds_of(surfaces, unit_m);
  const dvec3 extent = all.most - all.least;
  double side = std::max({extent.x, extent.y, extent.z});
  glm::uvec3 counts(1u);
  std::set<Place> chosen = touched(surfaces, all, counts, most);
  for (int step = 0; step < 64; ++step) {
    side *= 0.9;
    const glm::uvec3 finer = counts_for(extent, side);
    if (finer == counts) continue;
    std::set<Place> found = touched(surfaces, all, finer, most);
    if (found.size() > most) break;
    counts = finer;
    chosen = std::move(found);
  }
  const dvec3 half = 0.5 * extent / dvec3(counts);
  std::vector<GridCell> cells;
  for (const auto& [z, y, x] : chosen) {
    const dvec3 center = all.least + (2.0 * dvec3(x, y, z) + 1.0) * half;
    cells.push_back({center, half, center});
  }
  return cells;
}

double inside_share(const SceneTracer& tracer, const dvec3& point, double reach_m) {
  std::array<ShadowRay, kInsideRays> rays;
  std::array<BodyPath, kInsideRays> paths;
  for (std::uint32_t i = 0; i < kInsideRays; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / kInsideRays, radius = std::sqrt(1.0 - y * y);
    const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    rays[i].origin = vec3(point - tracer.origin());
    rays[i].direction = vec3(reach_m * dvec3(radius * std::cos(angle), y, radius * std::sin(angle)));
  }
  tracer.through_body(rays, paths);
  const auto inside = std::ranges::count_if(paths, [](const BodyPath& path) { return path.inside_m > 0.0f; });
  return static_cast<double>(inside) / kInsideRays;
}

std::vector<GridCell> open_cells(std::vector<GridCell> cells, const SceneTracer& tracer) {
  if (cells.empty()) return cells;
  SurfaceBounds all{cells.front().center, cells.front().center};
  for (const GridCell& cell : cells) {
    all.least = glm::min(all.least, cell.center - cell.half);
    all.most = glm::max(all.most, cell.center + cell.half);
  }
  const double reach_m = glm::length(all.most - all.least);
  std::erase_if(cells, [&](GridCell& cell) {
    double least = inside_share(tracer, cell.eye, reach_m);
    for (int i = 0; i < 27 && least > kOpen; ++i) {
      const dvec3 place = cell.center + 0.6 * cell.half * (dvec3(i % 3, i / 3 % 3, i / 9) - 1.0);
      const double share = inside_share(tracer, place, reach_m);
      if (share < least) least = share, cell.eye = place;
    }
    return least >= kMostInside;
  });
  return cells;
}

}  // namespace gloam
