// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/light_sources.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/modules/reflections/bake/bake_world.h"

namespace gloam {
namespace {

using test::moved;

Light lamp(float candela) {
  Light light;
  light.intensity = candela;
  light.range_m = 100.0f;
  return light;
}

struct ProxyLights : testing::Test {
  test::BakeWorld base;
  PlacedProxy proxy;

  ProxyLights() {
    IbrProxy quad;
    quad.size_m = vec2(2.0f, 1.0f);
    EXPECT_EQ(place_proxy(kNoEntity, quad, dmat4(1.0), proxy), ProxyPlacement::placed);
  }
  std::vector<CapturedProxyLight> chosen(const std::string& names) {
    auto lights = proxy_lights(base.world, proxy, names, light_sources(base.world));
    EXPECT_TRUE(lights.ok());
    return lights.ok() ? *lights : std::vector<CapturedProxyLight>();
  }
};

TEST_F(ProxyLights, are_those_that_reach_the_front_with_shares_of_the_illuminance) {
  const Entity near = base.light("near", lamp(9.0f), moved(0, 0, 30));
  base.light("behind", lamp(900.0f), moved(0, 0, -3));
  const Entity twice = base.light("twice", lamp(18.0f), moved(0, 0, 30));
  Light spot = lamp(1000.0f);
  spot.kind = LightKind::spot;
  spot.outer_angle = 0.3f;
  base.light("spot that looks away", spot, moved(0, 0, 3) * glm::rotate(dmat4(1.0), 1.5, dvec3(0, 1, 0)));
  Light short_range = lamp(1000.0f);
  short_range.range_m = 2.0f;
  base.light("too far", short_range, moved(0, 0, 3));
  base.light("not a number", lamp(std::numeric_limits<float>::quiet_NaN()), moved(0, 0, 3));
  const std::vector<CapturedProxyLight> lights = chosen("");
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0].light, near);
  EXPECT_EQ(lights[1].light, twice);
  EXPECT_NEAR(lights[0].weight, 1.0 / 3.0, 1e-5);
  EXPECT_NEAR(lights[1].weight, 2.0 / 3.0, 1e-5);
}

TEST_F(ProxyLights, that_are_named_count_also_where_they_do_not_reach) {
  base.light("other", lamp(9.0f), moved(0, 0, 3));
  const Entity front = base.light("front", lamp(9.0f), moved(0, 0, 3));
  const Entity back = base.light("back", lamp(9.0f), moved(0, 0, -3));
  const std::vector<CapturedProxyLight> lights = chosen("back, front");
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0].light, front);
  EXPECT_EQ(lights[1].light, back);
  EXPECT_FLOAT_EQ(lights[0].weight + lights[1].weight, 1.0f);
  EXPECT_NEAR(lights[1].weight, 0.01, 1e-3);
  const std::vector<CapturedProxyLight> unreached = chosen("back");
  ASSERT_EQ(unreached.size(), 1u);
  EXPECT_EQ(unreached[0].weight, 1.0f);
}

TEST_F(ProxyLights, with_an_unknown_name_are_an_error) {
  EXPECT_FALSE(proxy_lights(base.world, proxy, "absent", light_sources(base.world)).ok());
}

TEST_F(ProxyLights, illuminance_follows_the_inverse_square_cosine_window_and_cone) {
  Light spot = lamp(50.0f);
  spot.kind = LightKind::spot;
  spot.inner_angle = 0.2f;
  spot.outer_angle = 0.6f;
  spot.range_m = 8.0f;
  base.light("spot", spot, moved(0, 0, 4));
  const dvec3 point(1.5, 0.0, 0.0), offset(-1.5, 0.0, 4.0);
  const double d2 = glm::dot(offset, offset), cosine = 4.0 / std::sqrt(d2);
  const double ramp = (cosine - std::cos(0.6f)) / (std::cos(0.2f) - std::cos(0.6f));
  const double expected = 50.0 / d2 * cosine * ramp * ramp * (1.0 - std::pow(d2 / 64.0, 2.0));
  EXPECT_NEAR(illuminance(light_sources(base.world)[0], point, dvec3(0, 0, 1)), expected, 1e-5 * expected);

  Light sun;
  sun.kind = LightKind::directional;
  sun.intensity = 10.0f;
  sun.color = vec3(1.0f, 0.5f, 0.0f);
  base.light("sun", sun, dmat4(1.0));
  EXPECT_NEAR(illuminance(light_sources(base.world)[1], point, glm::normalize(dvec3(0, 1, 1))),
              10.0 * (0.2126 + 0.5 * 0.7152) / std::sqrt(2.0), 1e-5);
}

}  // namespace
}  // namespace gloam
