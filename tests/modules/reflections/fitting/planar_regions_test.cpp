// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/planar_regions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/modules/reflections/fitting/fit_scene.h"

namespace gloam {
namespace {

using Meshes = std::vector<FitTriangles>;

std::size_t open_edges(const WeldedFaces& faces) {
  std::size_t open = 0;
  for (const auto& across : faces.neighbors) open += static_cast<std::size_t>(std::ranges::count(across, ~0u));
  return open;
}

std::vector<PlanarRegion> grow(const Meshes& meshes) {
  return grow_planar_regions(weld_faces(meshes, kWeld_m), RegionTolerance());
}

TEST(WeldedFaces, join_vertices_of_different_instances) {
  const Meshes apart = {test::wall(0.0, 0.0, 1.0, 1.0), test::wall(1.0, 0.0005, 1.0, 1.0)};
  EXPECT_EQ(open_edges(weld_faces(apart, kWeld_m)), 6u);
  EXPECT_EQ(open_edges(weld_faces(apart, 1e-4)), 8u) << "half a millimetre is too far";
}

TEST(WeldedFaces, join_vertices_far_from_the_origin_and_on_both_sides_of_zero) {
  for (const double x : {-1.0, 0.0, 12345.678, -99999.5}) {
    const Meshes apart = {test::wall(x, 0.0, 1.0, 1.0), test::wall(x + 1.0004, -0.0004, 1.0, 1.0)};
    EXPECT_EQ(open_edges(weld_faces(apart, kWeld_m)), 6u) << x;
  }
}

TEST(WeldedFaces, leave_out_degenerate_and_unusable_triangles) {
  FitTriangles mesh = test::wall(0.0, 0.0, 1.0, 1.0);
  mesh.positions.push_back({test::kNaN, 0.0, 0.0});
  mesh.positions.push_back({0.0, std::numeric_limits<double>::infinity(), 0.0});
  mesh.positions.push_back({1e300, 0.0, 0.0});
  mesh.positions.push_back({2.0, 0.0, 0.0});
  mesh.indices.insert(mesh.indices.end(), {0, 1, 4, 0, 5, 1, 6, 0, 1, 0, 0, 1, 0, 1, 7});
  EXPECT_EQ(weld_faces(Meshes{mesh}, kWeld_m).faces.size(), 2u);
}

TEST(WeldedFaces, are_none_without_triangles) {
  EXPECT_TRUE(weld_faces({}, kWeld_m).faces.empty());
  EXPECT_TRUE(weld_faces(Meshes(3), kWeld_m).faces.empty());
}

TEST(WeldedFaces, keep_a_mesh_that_is_there_twice) {
  const FitTriangles room = test::box(dvec3(0.0), dvec3(4.0, 3.0, 5.0), true);
  const WeldedFaces twice = weld_faces(Meshes{room, room}, kWeld_m);
  EXPECT_EQ(twice.positions.size(), 8u);
  EXPECT_EQ(twice.faces.size(), 24u);
}

TEST(PlanarRegions, of_a_box_are_its_six_sides) {
  const std::vector<PlanarRegion> regions = grow({test::box(dvec3(0.0), dvec3(4.0, 3.0, 5.0))});
  ASSERT_EQ(regions.size(), 6u);
  double area = 0.0;
  for (const PlanarRegion& region : regions) {
    EXPECT_EQ(region.faces.size(), 2u);
    area += region.area_m2;
  }
  EXPECT_NEAR(area, 2.0 * (12.0 + 15.0 + 20.0), 1e-9);
}

TEST(PlanarRegions, hold_every_face_once) {
  const Meshes meshes = {test::sphere(2.0), test::box(dvec3(3.0), dvec3(4.0))};
  const WeldedFaces faces = weld_faces(meshes, kWeld_m);
  std::vector<int> held(faces.faces.size(), 0);
  for (const PlanarRegion& region : grow_planar_regions(faces, RegionTolerance()))
    for (const std::uint32_t face : region.faces) ++held[face];
  EXPECT_TRUE(std::ranges::all_of(held, [](int count) { return count == 1; }));
}

TEST(PlanarRegions, grow_over_bumps_within_the_tolerance) {
  FitTriangles bumpy = test::rectangle(dvec3(0.0), {8.0, 0.0, 0.0}, {0.0, 8.0, 0.0}, 16);
  for (std::size_t i = 0; i < bumpy.positions.size(); ++i) bumpy.positions[i].z = i % 3 == 0 ? 0.04 : 0.0;
  EXPECT_EQ(grow({bumpy}).size(), 1u);
  for (dvec3& p : bumpy.positions) p.z *= 20.0;
  EXPECT_GT(grow({bumpy}).size(), 8u);
}

TEST(PlanarRegions, share_a_plane_although_they_are_apart) {
  const Meshes meshes = {test::wall(0.0, 0.0, 3.0, 2.0), test::wall(50.0, 0.0, 3.0, 2.0, 0.05),
                         test::wall(0.0, 0.0, 3.0, 2.0, 1.0)};
  const WeldedFaces faces = weld_faces(meshes, kWeld_m);
  const auto grown = grow_planar_regions(faces, RegionTolerance());
  EXPECT_EQ(grown.size(), 3u);
  const auto joined = join_coplanar(faces, grown, RegionTolerance());
  ASSERT_EQ(joined.size(), 2u);
  EXPECT_NEAR(joined[0].area_m2, 12.0, 1e-9);
  EXPECT_NEAR(joined[0].offset_m, 0.025, 1e-9);
}

TEST(PlanarRegions, are_bounded_in_number_and_the_largest_are_kept) {
  Meshes meshes;
  for (std::size_t i = 0; i < kMostGroups + 100; ++i)
    meshes.push_back(test::wall(0.0, 0.0, 1.0, 2.0 - 1e-4 * static_cast<double>(i), static_cast<double>(i)));
  const WeldedFaces faces = weld_faces(meshes, kWeld_m);
  const auto joined = join_coplanar(faces, grow_planar_regions(faces, RegionTolerance()), RegionTolerance());
  ASSERT_EQ(joined.size(), kMostGroups);
  EXPECT_NEAR(joined.front().area_m2, 2.0, 1e-9);
  EXPECT_GT(joined.back().area_m2, 2.0 - 1e-4 * static_cast<double>(kMostGroups));
}

TEST(PlanarRegions, that_face_apart_are_not_joined) {
  FitTriangles back = test::wall(0.0, 0.0, 3.0, 2.0);
  std::ranges::reverse(back.indices);
  const Meshes meshes = {test::wall(0.0, 0.0, 3.0, 2.0), back};
  const WeldedFaces faces = weld_faces(meshes, kWeld_m);
  EXPECT_EQ(join_coplanar(faces, grow_planar_regions(faces, RegionTolerance()), RegionTolerance()).size(), 2u);
}

}  // namespace
}  // namespace gloam
