// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/math/generators.h"
#include "tests/modules/lights/bins/z_bin_oracle.h"
#include "tests/support/property.h"

namespace gloam {
namespace {

using test::draw;
using test::draw_index;
using test::draw_length;

ZBinParams draw_params() {
  ZBinParams params;
  params.near_m = static_cast<float>(draw_length(-3.0, 1.0));
  params.far_m = params.near_m + static_cast<float>(draw_length(-3.0, 5.0));
  if (!(params.far_m > params.near_m)) params.far_m = std::nextafter(params.near_m, 1e9f);
  static constexpr std::uint32_t kCounts[] = {1, 2, 3, 20, 256, 1024};
  params.count = kCounts[draw_index(6)];
  return params;
}

/// Depths before, within and beyond the bins. Some start on a bin's edge, some have no extent.
LightDepth draw_light(const ZBinParams& params) {
  const double near_m = params.near_m;
  const double extent = static_cast<double>(params.far_m) - near_m;
  double nearest = near_m + extent * draw(0.0, draw_index(4) == 0 ? 3.0 : 1.0);
  switch (draw_index(6)) {
    case 0:
      nearest = near_m;
      break;
    case 1:
      nearest = near_m + extent / params.count * draw_index(static_cast<int>(params.count) + 2);
      break;
    default:
      break;
  }
  const double length = draw_index(6) == 0 ? 0.0 : extent * draw_length(-5.0, 0.5);
  LightDepth light;
  light.nearest = std::max(static_cast<float>(nearest), params.near_m);
  light.farthest = std::max(static_cast<float>(nearest + length), light.nearest);
  return light;
}

TEST(ZBinsHardProperties, lose_no_light_and_hold_no_stranger_in_random_scenes) {
  test::check_property(10000, [] {
    const ZBinParams params = draw_params();
    std::vector<LightDepth> lights(static_cast<std::size_t>(draw_index(40)));
    for (LightDepth& light : lights) light = draw_light(params);
    test::sort_lights(lights);
    const std::string fault = test::fault_of(test::built(lights, params), lights);
    if (!fault.empty()) RC_FAIL(fault);
  });
}

}  // namespace
}  // namespace gloam
