// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/closed_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace gloam {
namespace {

struct Soup {
  std::vector<vec3> positions;
  std::vector<std::uint32_t> indices;

  /// A quad with vertices of its own, counter-clockwise.
  void quad(vec3 a, vec3 b, vec3 c, vec3 d) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c, d});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) indices.push_back(first + i);
  }
  void box(vec3 low, vec3 high) {
    const vec3 l = low, h = high;
    quad({l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
    quad({h.x, l.y, l.z}, {l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z});
    quad({h.x, l.y, h.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z});
    quad({l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z});
    quad({l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z}, {l.x, h.y, l.z});
    quad({l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
  }
  [[nodiscard]] bool closed() const { return is_closed_surface(positions, indices); }
};

TEST(ClosedSurface, a_box_of_separate_quads_is_one) {
  Soup soup;
  soup.box(vec3(-1.0f), vec3(1.0f, 2.0f, 3.0f));
  EXPECT_TRUE(soup.closed());
  soup.box(vec3(100.0f), vec3(101.0f));
  EXPECT_TRUE(soup.closed()) << "two boxes";
  soup.indices.insert(soup.indices.end(), {0u, 0u, 1u});
  EXPECT_TRUE(soup.closed()) << "a triangle without area has no edges";
}

TEST(ClosedSurface, a_box_that_lacks_a_triangle_is_none) {
  Soup whole;
  whole.box(vec3(-1.0f), vec3(1.0f));
  for (std::size_t i = 0; i < whole.indices.size(); i += 3) {
    Soup soup = whole;
    soup.indices.erase(soup.indices.begin() + static_cast<std::ptrdiff_t>(i),
                       soup.indices.begin() + static_cast<std::ptrdiff_t>(i + 3));
    EXPECT_FALSE(soup.closed()) << i;
    soup = whole;
    std::swap(soup.indices[i], soup.indices[i + 1]);
    EXPECT_FALSE(soup.closed()) << "turned triangle " << i;
  }
}

TEST(ClosedSurface, a_box_that_shows_its_inside_is_none) {
  Soup soup;
  soup.box(vec3(-1.0f), vec3(1.0f));
  std::reverse(soup.indices.begin(), soup.indices.end());
  EXPECT_FALSE(soup.closed());
}

TEST(ClosedSurface, sheets_and_nothing_are_none) {
  Soup soup;
  EXPECT_FALSE(soup.closed());
  soup.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  EXPECT_FALSE(soup.closed());
  soup.quad({0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0});
  EXPECT_FALSE(soup.closed()) << "both sides of a sheet enclose no volume";
}

TEST(ClosedSurface, a_seam_that_gapes_by_a_rounding_error_is_open) {
  Soup soup;
  soup.box(vec3(-1.0f), vec3(1.0f));
  soup.positions[0].x = std::nextafter(soup.positions[0].x, 0.0f);
  EXPECT_FALSE(soup.closed());
  soup.positions[0].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(soup.closed());
}

}  // namespace
}  // namespace gloam
