// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/scene/assets/topology.h"
#include "tests/scene/assets/topology_oracle.h"
#include "tests/support/property.h"

namespace gloam {
namespace {

TEST(TopologyProperties, random_triangle_soups_equal_brute_force) {
  test::check_property(300, [] {
    // Few positions and many triangles: shared edges, third faces, bow ties, degenerate and duplicate faces all occur.
    const int side = *rc::gen::inRange(2, 5);
    const auto coordinate = [&] { return *rc::gen::element(-0.0f, 0.0f, 1.0f, static_cast<float>(side)); };
    std::vector<vec3> positions;
    const int count = *rc::gen::inRange(3, 24);
    for (int i = 0; i < count; ++i) positions.emplace_back(coordinate(), coordinate(), coordinate());
    std::vector<std::uint32_t> indices;
    const int faces = *rc::gen::inRange(0, 40);
    for (int i = 0; i < 3 * faces; ++i) indices.push_back(static_cast<std::uint32_t>(*rc::gen::inRange(0, count)));
    test::expect_as_brute_force(positions, indices);
    RC_ASSERT(!testing::Test::HasFailure());
  });
}

TEST(TopologyProperties, grids_with_copied_vertices_become_one_surface) {
  test::check_property(50, [] {
    const auto width = static_cast<std::uint32_t>(*rc::gen::inRange(1, 9));
    std::vector<vec3> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y < width; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const auto& [dx, dy] : {std::pair{0u, 0u}, {1u, 0u}, {1u, 1u}, {0u, 1u}})
          positions.emplace_back(static_cast<float>(x + dx), static_cast<float>(y + dy), 0.0f);
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) indices.push_back(first + corner);
      }
    }
    const Topology topology = build_topology(positions, indices);
    RC_ASSERT(topology.positions.size() == std::size_t{(width + 1) * (width + 1)});
    RC_ASSERT(topology.refused_faces == 0u);
    std::uint32_t borders = 0;
    for (const auto& across : topology.neighbors)
      borders += static_cast<std::uint32_t>(std::ranges::count(across, ~0u));
    RC_ASSERT(borders == 4 * width);
  });
}

}  // namespace
}  // namespace gloam
