// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/diffuse/neighbourhood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "modules/reflections/bake/probe_map.h"
#include "modules/reflections/relighting/light_states.h"

// The oracle averages over directions all around in double precision, by the distances of the same scene.

namespace gloam {
namespace {

constexpr double kSky = std::numeric_limits<double>::infinity();
using Distances = std::function<double(const dvec3& direction)>;
using Light = std::function<float(const dvec3& direction)>;

ProbeNeighbourhood seen(const Distances& distance, const Light& unlit, float sky = 1.0f) {
  std::vector<CapturedSurface> surfaces;
  std::vector<vec3> light;
  for (std::uint32_t y = 0; y < kProbeCells; ++y)
    for (std::uint32_t x = 0; x < kProbeCells; ++x) {
      const dvec3 d(probe_map_direction((vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) /
                                        static_cast<float>(kProbeCells)));
      const double far = distance(d);
      surfaces.push_back(far == kSky ? CapturedSurface{} : CapturedSurface{vec3(far * d), vec3(-d)});
      light.emplace_back(unlit(d));
    }
  return probe_neighbourhood(surfaces, light, vec3(sky));
}

double harmonic_mean(const Distances& distance) {
  constexpr int kCount = 200000;
  double sum = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / kCount, radius = std::sqrt(1.0 - y * y);
    const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    sum += 1.0 / distance({radius * std::cos(angle), y, radius * std::sin(angle)});
  }
  return kCount / sum;
}

/// From the middle of a box.
Distances room(const dvec3& half) {
  return [half](const dvec3& d) {
    const dvec3 each = half / glm::max(glm::abs(d), dvec3(1e-12));
    return std::min({each.x, each.y, each.z});
  };
}

float dark(const dvec3&) { return 0.0f; }
float bright(const dvec3&) { return 1.0f; }

TEST(ProbeNeighbourhood, of_a_closed_room_has_no_sky_whatever_its_shape_and_lamps) {
  for (const dvec3 half : {dvec3(2.0, 1.5, 3.0), dvec3(1.0, 1.0, 1.0), dvec3(1.5, 1.2, 4.0)}) {
    const ProbeNeighbourhood found = seen(room(half), dark);
    EXPECT_EQ(found.open, 0.0f);
    const double expected = harmonic_mean(room(half));
    EXPECT_NEAR(found.reach, expected, 0.02 * expected);
    EXPECT_EQ(seen(room(half), bright).open, 0.0f) << "walls that shine are near";
  }
}

TEST(ProbeNeighbourhood, at_a_wall_of_a_dark_hall_has_no_sky) {
  // Far walls without light of their own are no sky, whatever lamps light them.
  const Distances hall = [](const dvec3& d) { return d.x < 0.0 ? 0.5 / -d.x : 60.0; };
  EXPECT_EQ(seen(hall, dark).open, 0.0f);
  EXPECT_EQ(seen(hall, bright).open, 1.0f) << "a painted sky";
  EXPECT_NEAR(seen(hall, [](const dvec3&) { return 0.02f; }).open, 0.08f, 0.01f) << "a gloomy one";
}

TEST(ProbeNeighbourhood, on_open_ground_reaches_twice_the_height_under_sky_and_painted_sky) {
  for (const double dome : {kSky, 1000.0}) {
    const Distances field = [dome](const dvec3& d) { return d.y < 0.0 ? std::min(2.0 / -d.y, dome) : dome; };
    const ProbeNeighbourhood found = seen(field, bright);
    EXPECT_EQ(found.open, 1.0f);
    // 2 h = 4 m: the mean of cos / h over the hemisphere is 1 / 2 h. A cell is 11.25° wide, so the ground of up to
    // 5.7° below the horizon may count as sky: a tenth of the hemisphere with hardly any of the closeness.
    EXPECT_GT(found.reach, 3.6f);
    EXPECT_LT(found.reach, 4.0f);
  }
}

TEST(ProbeNeighbourhood, with_a_window_is_open_in_proportion) {
  const Distances walls = room(dvec3(2.0, 1.5, 3.0));
  const auto windowed = [&](const dvec3& d) { return d.x > 0.95 ? kSky : walls(d); };  // 2.5 % of all directions
  EXPECT_NEAR(seen(windowed, dark).open, 0.025 / 0.125, 0.06);
}

TEST(ProbeNeighbourhood, that_is_all_sky_has_no_end) {
  const ProbeNeighbourhood found = seen([](const dvec3&) { return kSky; }, bright);
  EXPECT_EQ(found.open, 1.0f);
  EXPECT_EQ(found.reach, std::numeric_limits<float>::infinity());
}

TEST(ProbeNeighbourhood, under_a_black_sky_is_finite) {
  const Distances field = [](const dvec3& d) { return d.y < 0.0 ? 2.0 / -d.y : 1000.0; };
  EXPECT_EQ(seen(field, dark, 0.0f).open, 1.0f);
}

TEST(ProbeNeighbourhood, without_surfaces_holds_everywhere) {
  EXPECT_EQ(probe_neighbourhood({}, {}, vec3(1.0f)).open, 0.0f);
}

TEST(ProbeNeighbourhood, that_touches_a_surface_is_finite) {
  const ProbeNeighbourhood found = seen([](const dvec3& d) { return d.x < 0.0 ? 0.0 : kSky; }, dark);
  EXPECT_GE(found.reach, 0.0f);
  EXPECT_TRUE(std::isfinite(found.reach));
  EXPECT_EQ(found.open, 1.0f);
}

}  // namespace
}  // namespace gloam
