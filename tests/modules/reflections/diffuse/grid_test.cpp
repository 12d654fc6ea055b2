// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/diffuse/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "engine/scene/gltf/import.h"
#include "modules/accuracy/module.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

bool holds(const GridCell& cell, const dvec3& point) {
  return glm::all(glm::lessThanEqual(glm::abs(point - cell.center), cell.half * (1.0 + 1e-9) + 1e-12));
}

TEST(DiffuseGrid, cells_hold_all_surfaces_and_are_never_too_many) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-20.0, 20.0), size(0.0, 3.0);
  for (const std::uint32_t most : {1u, 2u, 5u, 24u, 100u, 256u}) {
    std::vector<SurfaceBounds> surfaces;
    for (int i = 0; i < 40; ++i) {
      const dvec3 least(place(random), 0.3 * place(random), place(random));
      surfaces.push_back({least, least + dvec3(size(random), size(random), size(random))});
    }
    const std::vector<GridCell> cells = occupied_cells(surfaces, most, 1.0);
    EXPECT_LE(cells.size(), most);
    EXPECT_GE(cells.size(), std::max(1u, most / 8)) << "it is about as fine as it may be";
    for (const SurfaceBounds& one : surfaces)
      for (int i = 0; i < 27; ++i) {
        const dvec3 point = one.least + (one.most - one.least) * (dvec3(i % 3, i / 3 % 3, i / 9) * 0.5);
        EXPECT_TRUE(std::ranges::any_of(cells, [&](const GridCell& cell) { return holds(cell, point); }));
      }
  }
}

TEST(DiffuseGrid, cells_are_about_cubes) {
  const std::vector<SurfaceBounds> hall = {{dvec3(0.0), dvec3(20.0, 4.0, 8.0)}};
  for (const GridCell& cell : occupied_cells(hall, 100, 1.0)) {
    const double longest = std::max({cell.half.x, cell.half.y, cell.half.z});
    EXPECT_LT(longest, 2.0 * std::min({cell.half.x, cell.half.y, cell.half.z}));
  }
}

TEST(DiffuseGrid, is_the_same_at_any_scale_and_place) {
  const std::vector<SurfaceBounds> metres = {{dvec3(0.0), dvec3(6.0, 3.0, 0.1)}, {dvec3(5.0, 0.0, 2.0), dvec3(9.0)}};
  const std::vector<GridCell> expected = occupied_cells(metres, 40, 1.0);
  for (const double scale : {0.01, 100.0}) {
    const dvec3 moved = dvec3(4096.0, -1024.0, 512.0) * scale;
    std::vector<SurfaceBounds> other;
    for (const SurfaceBounds& one : metres) other.push_back({scale * one.least + moved, scale * one.most + moved});
    const std::vector<GridCell> found = occupied_cells(other, 40, scale);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_LT(glm::length((found[i].center - moved) / scale - expected[i].center), 1e-6);
  }
}

TEST(DiffuseGrid, nothing_flat_or_huge_breaks_it) {
  EXPECT_TRUE(occupied_cells({}, 8, 1.0).empty());
  const std::vector<SurfaceBounds> ground = {{dvec3(-50.0, 0.0, -50.0), dvec3(50.0, 0.0, 50.0)}};
  const std::vector<GridCell> flat = occupied_cells(ground, 16, 1.0);
  ASSERT_FALSE(flat.empty());
  for (const GridCell& cell : flat) EXPECT_GT(cell.eye.y, 0.5) << "above the ground";
  const std::vector<SurfaceBounds> point = {{dvec3(1.0), dvec3(1.0)}};
  EXPECT_EQ(occupied_cells(point, 1, 1.0).size(), 1u);
  const std::vector<SurfaceBounds> far = {{dvec3(0.0), dvec3(1.0)}, {dvec3(1e9), dvec3(1e9 + 1.0)}};
  for (const GridCell& cell : occupied_cells(far, 16, 1.0)) EXPECT_TRUE(std::isfinite(cell.half.x));
}

/// A solid block of 2 m beside a hollow one with walls of 0.2 m, over a ground without thickness.
struct Blocks {
  Blocks() {
    prepare_scene_world(world);
    Material material;
    const std::uint32_t index = scene.material(material);
    const auto block = [&](const dvec3& center, const vec3& half) {
      scene.draw(scene.mesh(test::box(half, index)), glm::translate(dmat4(1.0), center));
    };
    block({-3.0, 1.0, 0.0}, vec3(1.0f));
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        dvec3 center(3.0, 1.5, 0.0);
        center[axis] += side * 1.1;
        vec3 half(1.2f);
        half[axis] = 0.1f;
        block(center, half);
      }
    const dmat4 flat = glm::rotate(dmat4(1.0), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
    scene.draw(scene.mesh(test::quad(30.0f, index)), flat);
    tracer = std::move(make_scene_tracer(world, *executor)).value();
  }
  World world;
  test::SceneMaker scene{world};
  std::unique_ptr<JobExecutor> executor = make_serial_executor();
  std::unique_ptr<SceneTracer> tracer;
};

TEST(DiffuseGrid, knows_the_inside_of_walls_from_rooms_and_open_places) {
  const Blocks blocks;
  EXPECT_EQ(inside_share(*blocks.tracer, {-3.0, 1.0, 0.0}, 50.0), 1.0) << "in the solid block";
  EXPECT_EQ(inside_share(*blocks.tracer, {3.0, 1.5, 0.0}, 50.0), 0.0) << "in the room";
  EXPECT_GT(inside_share(*blocks.tracer, {4.1, 1.5, 0.0}, 50.0), 0.9) << "in its wall";
  EXPECT_EQ(inside_share(*blocks.tracer, {0.0, 1.0, 0.0}, 50.0), 0.0) << "in the open";
  EXPECT_NEAR(inside_share(*blocks.tracer, {0.0, -1.0, 9.0}, 50.0), 0.5, 0.1) << "below the ground";
}

TEST(DiffuseGrid, moves_places_out_of_walls_and_leaves_solid_cells_out) {
  const Blocks blocks;
  const dvec3 solid(-3.0, 1.0, 0.0), wall(4.1, 1.5, 0.0);
  const std::vector<GridCell> cells =
      open_cells({{solid, dvec3(0.9), solid}, {wall, dvec3(0.5), wall}}, *blocks.tracer);
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_EQ(cells[0].center, wall);
  EXPECT_EQ(inside_share(*blocks.tracer, cells[0].eye, 50.0), 0.0);
  EXPECT_TRUE(holds(cells[0], cells[0].eye));
}

TEST(DiffuseGrid, has_the_bounds_of_all_triangles) {
  const Blocks blocks;
  const std::vector<SurfaceBounds> bounds = triangle_bounds(blocks.world);
  EXPECT_EQ(bounds.size(), 7u * 12u + 2u);
  double most = -1e9;
  for (const SurfaceBounds& one : bounds) most = std::max(most, one.most.y);
  EXPECT_NEAR(most, 2.7, 1e-6);
}

}  // namespace
}  // namespace gloam
