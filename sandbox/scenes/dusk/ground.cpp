// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "modules/grass/components.h"
#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/dusk/images.h"
#include "sandbox/scenes/dusk/parts.h"

namespace gloam {
namespace {

constexpr double kLawnCell = 0.4;  // of the lawn's grid
constexpr double kPathHalfWidth = 0.85;
constexpr double kDenseX = 10.5;                         // west of it, where people walk, grass is denser
constexpr float kDensity = 260.0f, kFarDensity = 60.0f;  // blades/m²
constexpr double kFilm_m = 0.005;                        // height of a puddle's surface above the ground

double distance_to_path(double x, double z) {
  double least = 1e9;
  const std::vector<glm::dvec2>& path = lawn_path();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const glm::dvec2 a = path[i], along = path[i + 1] - a, to(x - a.x, z - a.y);
    const double t = glm::clamp(glm::dot(to, along) / glm::dot(along, along), 0.0, 1.0);
    least = std::min(least, glm::length(to - t * along));
  }
  return least;
}

/// A flat rectangle that faces up, with texture coordinates and tangents for setts_images(). size: of a sett, 1 as
/// they are.
Primitive setts_shape(glm::dvec2 min, glm::dvec2 max, float size) {
  Primitive out;
  for (const glm::dvec2& corner :
       {glm::dvec2(min.x, max.y), glm::dvec2(max.x, max.y), glm::dvec2(max.x, min.y), glm::dvec2(min.x, min.y)}) {
    out.positions.emplace_back(corner.x, 0.0, corner.y);
    out.normals.emplace_back(0.0f, 1.0f, 0.0f);
    out.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
    out.uv0.emplace_back(vec2(corner) / (size * kSettsSide_m));
    out.bounds.grow(out.positions.back());
  }
  out.indices = {0, 1, 2, 0, 2, 3};
  return out;
}

void add_paving(Dusk& dusk) {
  SceneBuilder& builder = dusk.builder();
  const auto block = [&](const std::string& name, std::uint32_t material, dvec3 min, dvec3 max) {
    builder.add_instance(name, builder.add_mesh(name, box_shape(vec3(max - min)), material),
                         {0.5 * (min.x + max.x), min.y, 0.5 * (min.z + max.z)});
  };
  builder.add_instance(
      "setts",
      builder.add_mesh("setts", setts_shape({kDuskKerbX, kDuskNorthZ}, {kDuskFootwayX, kDuskSouthZ}, 1.0f),
                       dusk.materials.setts),
      dvec3(0.0));
  const std::uint32_t kerb = dusk.street.materials.kerb, paving = dusk.materials.paving;
  const double y = kDuskPavementY, z0 = kDuskNorthZ, z1 = kDuskSouthZ;
  block("kerb", kerb, {kDuskKerbX - 0.2, -0.3, z0}, {kDuskKerbX, y, z1});
  block("pavement", paving, {kDuskFacadeX - 0.3, -0.3, z0}, {kDuskKerbX - 0.2, y, z1});
  block("kerb", kerb, {kDuskFootwayX, -0.3, z0}, {kDuskFootwayX + 0.2, y, z1});
  block("footway", paving, {kDuskFootwayX + 0.2, -0.3, z0}, {kDuskLawnX, y, z1});
  block("south yard", paving, {kDuskLawnX, -0.3, kDuskLawnSouthZ}, {kDuskLawnEastX + 2.0, y, z1});
  block("north yard", paving, {kDuskLawnX, -0.3, z0}, {kDuskLawnEastX + 2.0, y, kDuskLawnNorthZ});
  // Slabs on the blocks: setts of more than three times the size.
  const auto slabs = [&](const char* name, glm::dvec2 min, glm::dvec2 max) {
    const std::uint32_t mesh = builder.add_mesh(name, setts_shape(min, max, 3.4f), dusk.materials.slabs);
    const Entity entity = builder.add_instance(name, mesh, {0.0, y + 0.003, 0.0});
    dusk.world().get<MeshInstance>(entity).casts_shadows = false;
  };
  slabs("slabs left", {kDuskFacadeX, z0}, {kDuskKerbX - 0.2, z1});
  slabs("slabs right", {kDuskFootwayX + 0.2, z0}, {kDuskLawnX, z1});
}

enum class LawnPart { dense, sparse, bare };

/// One part of the lawn's grid.
Primitive lawn_shape(LawnPart part) {
  Primitive out;
  const int columns = static_cast<int>((kDuskLawnEastX - kDuskLawnX) / kLawnCell);
  const int rows = static_cast<int>((kDuskLawnSouthZ - kDuskLawnNorthZ) / kLawnCell) + 1;
  const auto corner = [&](int column, int row) {
    const double x = kDuskLawnX + (kDuskLawnEastX - kDuskLawnX) * column / columns;
    const double z = kDuskLawnNorthZ + (kDuskLawnSouthZ - kDuskLawnNorthZ) * row / rows;
    return glm::dvec2(x, z);
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const glm::dvec2 middle = 0.5 * (corner(column, row) + corner(column + 1, row + 1));
      const bool is_clear =
          distance_to_path(middle.x, middle.y) < kPathHalfWidth - 0.08 ||
          glm::length(middle - glm::dvec2(kDuskBandstand.x, kDuskBandstand.z)) < kDuskBandstandRadius + 0.1;
      const LawnPart here = is_clear ? LawnPart::bare : (middle.x < kDenseX ? LawnPart::dense : LawnPart::sparse);
      if (here != part) continue;
      const auto first = static_cast<std::uint32_t>(out.positions.size());
      for (const auto& [c, r] : {std::pair(column, row), {column, row + 1}, {column + 1, row + 1}, {column + 1, row}}) {
        const glm::dvec2 at = corner(c, r);
        const double h = lawn_height(at.x, at.y), step = 0.05;
        const double dx = (lawn_height(at.x + step, at.y) - h) / step, dz = (lawn_height(at.x, at.y + step) - h) / step;
        out.positions.emplace_back(at.x, h, at.y);
        out.normals.emplace_back(glm::normalize(dvec3(-dx, 1.0, -dz)));
        out.bounds.grow(out.positions.back());
      }
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) out.indices.push_back(first + i);
    }
  }
  return out;
}

/// The path as a ribbon on the lawn.
Primitive path_shape() {
  Primitive out;
  const std::vector<glm::dvec2>& path = lawn_path();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const glm::dvec2 along = glm::normalize(path[std::min(i + 1, path.size() - 1)] - path[i == 0 ? 0 : i - 1]);
    const glm::dvec2 across(-along.y, along.x);
    for (int k = -2; k <= 2; ++k) {
      const double half = kPathHalfWidth + 0.07 * std::sin(2.1 * static_cast<double>(i) + k);
      const glm::dvec2 at = path[i] + across * (0.5 * k * half);
      out.positions.emplace_back(at.x, lawn_height(at.x, at.y) + (std::abs(k) == 2 ? -0.02 : 0.025), at.y);
      out.normals.emplace_back(0.0f, 1.0f, 0.0f);
      const auto number = static_cast<std::uint32_t>(5 * static_cast<int>(i) + k + 2);
      out.colors.emplace_back(vec3(0.72f + 0.4f * dusk_scatter(number, 1u)), 1.0f);
      out.bounds.grow(out.positions.back());
    }
    if (i == 0) continue;
    const auto first = static_cast<std::uint32_t>(5 * (i - 1));
    for (std::uint32_t k = 0; k < 4; ++k)
      out.indices.insert(out.indices.end(),
                         {first + k, first + k + 1, first + k + 6, first + k, first + k + 6, first + k + 5});
  }
  return out;
}

void add_lawn(Dusk& dusk) {
  SceneBuilder& builder = dusk.builder();
  for (const LawnPart part : {LawnPart::dense, LawnPart::sparse}) {
    const std::uint32_t mesh = builder.add_mesh("lawn", lawn_shape(part), dusk.materials.soil);
    const Entity lawn = builder.add_instance(part == LawnPart::dense ? "lawn" : "far lawn", mesh, dvec3(0.0));
    dusk.world().get<MeshInstance>(lawn).casts_shadows = false;
    dusk.world().add<GrassSurface>(lawn, {.density = part == LawnPart::dense ? kDensity : kFarDensity,
                                          .height_m = vec2(0.17f, 0.05f),
                                          .width_m = 0.008f,
                                          .max_distance_m = 30.0f});
  }
  builder.add_instance("bare soil", builder.add_mesh("bare soil", lawn_shape(LawnPart::bare), dusk.materials.soil),
                       dvec3(0.0));
  const Entity path =
      builder.add_instance("path", builder.add_mesh("path", path_shape(), dusk.materials.gravel), dvec3(0.0));
  dusk.world().get<MeshInstance>(path).casts_shadows = false;
  dusk.world().add<Wind>(builder.add_group("wind", dvec3(0.0)), {.velocity = vec3(1.7f, 0.0f, 0.8f), .gust = 0.4f});
}

/// A flat star-shaped sheet that faces up. seed changes its bays.
Primitive pool_shape(vec2 radius, float seed) {
  constexpr std::uint32_t kCorners = 72;
  Primitive sheet;
  sheet.positions.emplace_back(0.0f);
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    const float turn = 2.0f * kPi * static_cast<float>(i) / static_cast<float>(kCorners);
    const float reach = 0.78f + 0.13f * std::sin(2.0f * turn + seed) + 0.09f * std::sin(3.0f * turn + 2.3f * seed) +
                        0.05f * std::sin(5.0f * turn + 4.1f * seed) + 0.03f * std::sin(9.0f * turn + 1.7f * seed) +
                        0.025f * std::sin(14.0f * turn + 3.1f * seed) + 0.02f * std::sin(23.0f * turn + seed);
    sheet.positions.emplace_back(reach * radius.x * std::cos(turn), 0.0f, -reach * radius.y * std::sin(turn));
  }
  sheet.normals.assign(sheet.positions.size(), vec3(0.0f, 1.0f, 0.0f));
  for (std::uint32_t i = 0; i < kCorners; ++i)
    for (const std::uint32_t corner : {0u, 1u + i, 1u + (i + 1u) % kCorners}) sheet.indices.push_back(corner);
  for (const vec3& position : sheet.positions) sheet.bounds.grow(position);
  return sheet;
}

/// Fallen leaves on setts, pavement and path.
void add_fallen_leaves(Dusk& dusk) {
  Model leaves;
  constexpr std::array<vec3, 4> kColors = {
      {{0.42f, 0.20f, 0.04f}, {0.30f, 0.10f, 0.03f}, {0.46f, 0.30f, 0.06f}, {0.20f, 0.11f, 0.05f}}};
  for (std::uint32_t i = 0; i < 420; ++i) {
    const float far = dusk_scatter(i, 1u), around = dusk_scatter(i, 2u);
    const double x = glm::mix(kDuskKerbX + 0.1, kDuskLawnX - 0.1, std::sqrt(static_cast<double>(around)));
    const double z = glm::mix(12.0, -20.0, static_cast<double>(far));
    if (std::abs(x - kDuskFootwayX) < 0.16) continue;
    const double y = x > kDuskFootwayX ? kDuskPavementY : 0.0;
    const float turn = 6.3f * dusk_scatter(i, 3u), size = 0.035f + 0.035f * dusk_scatter(i, 4u);
    const vec3 at(x, y + 0.008, z), u(size * std::cos(turn), 0.004f, size * std::sin(turn));
    const vec3 v(-0.55f * u.z, 0.012f * dusk_scatter(i, 6u), 0.55f * u.x);
    leaves.quad(kColors[i % kColors.size()], at - u, at + v, at + u, at - v);
  }
  const std::vector<glm::dvec2>& path = lawn_path();
  for (std::uint32_t i = 0; i < 160; ++i) {
    const glm::dvec2 middle =
        path[static_cast<std::size_t>(dusk_scatter(i, 21u) * static_cast<float>(path.size() - 1))];
    const double x = middle.x + 2.2 * (static_cast<double>(dusk_scatter(i, 22u)) - 0.5);
    const double z = middle.y + 1.6 * (static_cast<double>(dusk_scatter(i, 23u)) - 0.5);
    const float turn = 6.3f * dusk_scatter(i, 24u), size = 0.035f + 0.03f * dusk_scatter(i, 25u);
    const vec3 at(x, lawn_height(x, z) + 0.035, z), u(size * std::cos(turn), 0.006f, size * std::sin(turn));
    const vec3 v(-0.55f * u.z, 0.012f, 0.55f * u.x);
    leaves.quad(kColors[i % kColors.size()], at - u, at + v, at + u, at - v);
  }
  const Entity entity = add_dusk_model(dusk, "fallen leaves", leaves, dusk.materials.matt, dvec3(0.0));
  dusk.world().get<MeshInstance>(entity).casts_shadows = false;
}

}  // namespace

double lawn_height(double x, double z) {
  const double inward = glm::clamp((x - kDuskLawnX - 0.3) / 2.5, 0.0, 1.0);
  const double waves = 0.09 * std::sin(0.55 * x + 0.4) * std::cos(0.42 * z) + 0.05 * std::sin(0.9 * z - 0.7 * x);
  return kDuskPavementY + inward * inward * (3.0 - 2.0 * inward) * (0.12 + waves);
}

const std::vector<glm::dvec2>& lawn_path() {
  static const std::vector<glm::dvec2> path = [] {
    // Points of a Catmull-Rom spline; the first and the last one only give its directions.
    constexpr std::array<glm::dvec2, 9> kPoints = {{{3.0, 3.2},
                                                    {5.0, 2.9},
                                                    {6.9, 1.9},
                                                    {8.1, -0.9},
                                                    {8.6, -4.4},
                                                    {8.5, -8.0},
                                                    {7.2, -10.9},
                                                    {5.0, -12.0},
                                                    {3.0, -12.2}}};
    std::vector<glm::dvec2> points;
    for (std::size_t i = 1; i + 2 < kPoints.size(); ++i) {
      const glm::dvec2 a = kPoints[i - 1], b = kPoints[i], c = kPoints[i + 1], d = kPoints[i + 2];
      for (int step = 0; step < 8; ++step) {
        const double t = step / 8.0;
        points.push_back(0.5 *
                         (2.0 * b + t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))));
      }
    }
    points.push_back(kPoints[kPoints.size() - 2]);
    return points;
  }();
  return path;
}

void add_dusk_ground(Dusk& dusk) {
  add_paving(dusk);
  add_lawn(dusk);
  add_fallen_leaves(dusk);
  // Fields beyond the houses, up to the sky's dome.
  const vec2 disc[] = {{140.0f, 0.0f}, {0.0f, 0.0f}};
  const Entity fields = dusk.builder().add_instance(
      "fields", dusk.builder().add_mesh("fields", turned_shape(disc, 32), dusk.materials.soil), {0.0, -0.4, 0.0});
  dusk.world().get<MeshInstance>(fields).casts_shadows = false;
}

void add_dusk_puddles(Dusk& dusk) {
  struct Pool {
    double x, z;
    vec2 radius;
    bool is_on_pavement = false;
  };
  constexpr Pool kPools[] = {
      {-0.2, 4.5, {2.2f, 1.25f}},        {1.9, 2.6, {1.2f, 0.8f}},       {-2.3, 2.4, {0.8f, 1.1f}},
      {0.1, -1.6, {1.5f, 1.2f}},         {-0.9, -4.6, {0.9f, 1.5f}},     {1.0, -6.8, {1.3f, 1.7f}},
      {-1.4, -9.8, {1.7f, 1.5f}},        {1.4, -13.4, {1.4f, 1.9f}},     {-0.8, -17.8, {1.9f, 2.0f}},
      {1.0, -23.6, {1.7f, 2.2f}},        {2.4, 7.0, {0.8f, 1.2f}},       {-1.8, 9.2, {1.2f, 1.3f}},
      {-4.7, -1.2, {0.55f, 1.1f}, true}, {-4.5, 5.6, {0.5f, 1.2f}, true}};
  int count = 0;
  for (const Pool& pool : kPools) {
    const std::string name = "puddle " + std::to_string(count++);
    const std::uint32_t mesh =
        dusk.builder().add_mesh(name, pool_shape(pool.radius, 1.9f * static_cast<float>(count)), dusk.materials.water);
    const Entity entity = dusk.builder().add_instance(
        name, mesh, {pool.x, (pool.is_on_pavement ? kDuskPavementY : 0.0) + kFilm_m, pool.z});
    dusk.world().get<MeshInstance>(entity).casts_shadows = false;
  }
}

}  // namespace gloam
