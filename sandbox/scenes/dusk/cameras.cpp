// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <vector>

#include "modules/depth_of_field/components.h"
#include "sandbox/scenes/dusk/parts.h"
#include "sandbox/scenes/dusk/scene.h"

namespace gloam {
namespace {

/// A place of the camera of the walk, and a point that it looks at from there.
struct Stop {
  dvec3 eye, target;
};
// Up the street between fire and stalls, across to the lawn, and back along its path.
constexpr std::array<Stop, 14> kStops = {{{{1.6, 1.60, 3.6}, {-1.2, 1.5, -5.0}},
                                          {{1.1, 1.60, 1.2}, {-1.2, 1.5, -8.0}},
                                          {{-0.3, 1.60, -1.4}, {-1.0, 1.5, -11.0}},
                                          {{-1.8, 1.58, -4.2}, {-0.6, 1.5, -13.0}},
                                          {{-1.3, 1.58, -7.6}, {2.6, 1.5, -16.0}},
                                          {{0.9, 1.60, -10.6}, {8.6, 1.4, -15.0}},
                                          {{3.4, 1.66, -12.1}, {12.0, 1.4, -11.0}},
                                          {{6.2, 1.72, -11.5}, {13.0, 1.4, -7.5}},
                                          {{8.0, 1.76, -9.2}, {12.8, 1.2, -2.0}},
                                          {{8.6, 1.80, -5.6}, {9.6, 1.2, 3.0}},
                                          {{8.35, 1.78, -1.8}, {6.0, 1.3, 7.0}},
                                          {{7.3, 1.74, 1.3}, {-0.5, 1.4, 5.5}},
                                          {{5.2, 1.70, 2.9}, {-4.0, 1.5, 2.5}},
                                          {{2.8, 1.64, 4.1}, {-4.5, 1.5, -3.0}}}};

dvec3 spline_point(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d, double t) {
  return 0.5 * (2.0 * b + t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a))));
}

/// The pose at a share of the stops, 0…1; it repeats.
Stop stop_at(double share) {
  const double place = (share - std::floor(share)) * kStops.size();
  const auto first = static_cast<std::size_t>(place);
  const auto stop = [&](std::size_t i) -> const Stop& {
    return kStops[(first + i + kStops.size() - 1) % kStops.size()];
  };
  const double t = place - std::floor(place);
  return {spline_point(stop(0).eye, stop(1).eye, stop(2).eye, stop(3).eye, t),
          spline_point(stop(0).target, stop(1).target, stop(2).target, stop(3).target, t)};
}

void add_walk(Dusk& dusk) {
  constexpr int kKeys = 300;
  constexpr int kSamples = 1400;  // of the way's length, for an even speed
  std::vector<double> lengths = {0.0};
  for (int i = 1; i <= kSamples; ++i)
    lengths.push_back(lengths.back() + glm::length(stop_at(static_cast<double>(i) / kSamples).eye -
                                                   stop_at(static_cast<double>(i - 1) / kSamples).eye));
  std::vector<PoseKey> keys;
  std::size_t sample = 0;
  for (int i = 0; i <= kKeys; ++i) {
    const double length = lengths.back() * i / kKeys;
    while (sample + 2 < lengths.size() && lengths[sample + 1] < length) ++sample;
    const double within = (length - lengths[sample]) / (lengths[sample + 1] - lengths[sample]);
    const Stop stop = stop_at((static_cast<double>(sample) + within) / kSamples);
    dquat rotation = rotation_towards(stop.target - stop.eye);
    if (!keys.empty() && glm::dot(rotation, keys.back().rotation) < 0.0) rotation = -rotation;
    keys.push_back({kDuskWalk_s * i / kKeys, stop.eye, rotation});
  }
  const Entity camera = dusk.builder().add_camera("walk", kStops[0].eye, kStops[0].target, 0.92f);
  dusk.builder().add_clip("walk", camera, keys);
}

}  // namespace

void add_dusk_cameras(Dusk& dusk) {
  SceneBuilder& builder = dusk.builder();
  builder.add_camera("square", {0.75, 1.45, 9.3}, {0.4, 2.0, -6.0}, 0.86f);
  const Entity stall = builder.add_camera("stall", {-1.35, 1.50, 0.75}, {2.85, 1.36, -1.95}, 0.42f);
  dusk.world().add<DepthOfField>(stall, {.focus_m = 5.0f, .f_number = 0.42f, .bokeh = Bokeh::round});
  builder.add_camera("lawn", {5.9, 0.85, 5.3}, {10.9, 1.6, -7.0}, 0.80f);
  add_walk(dusk);
}

}  // namespace gloam
