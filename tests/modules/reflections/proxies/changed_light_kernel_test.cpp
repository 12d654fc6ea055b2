// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tests/modules/lighting/shading_oracle.h"
#include "tests/modules/reflections/support/blend_kernel.h"
#include "tests/support/render_scene.h"

namespace gloam::test {
namespace {

/// A floor before a wall that is a proxy, with lights that may change after the capture.
class ChangedLights : public KernelTest {
 protected:
  void SetUp() override {
    KernelTest::SetUp();
    ProxyScene scene;
    scene.add({0.0, 0.0, -4.0}, {0.0, 0.0, 1.0}, vec2(200.0f));
    proxies = std::make_unique<ProxyWorld>(scene);
    seen = look({}, look_at({0.5, 1.2, 6.0}, {0.0, 0.4, 0.0}, 24, 20));
  }
  Entity light(const Light& what, const dvec3& at, const dvec3& direction = dvec3(0.0, -1.0, 0.0)) {
    dmat4 matrix(1.0);
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0), z));
    matrix[0] = dvec4(x, 0.0), matrix[1] = dvec4(glm::cross(z, x), 0.0), matrix[2] = dvec4(z, 0.0);
    matrix[3] = dvec4(at, 1.0);
    const Entity entity = proxies->world.create(what, WorldTransform{matrix});
    lights.push_back({what, at, -z});
    entities.push_back(entity);
    proxies->captures.lights.push_back({entity, what.color * what.intensity});
    return entity;
  }
  /// Three lights, one of each kind.
  void put_lights() {
    Light lamp;
    lamp.intensity = 20.0f;
    lamp.range_m = 30.0f;
    lamp.color = {1.0f, 0.8f, 0.6f};
    light(lamp, {1.0, 3.0, 2.0});
    lamp.kind = LightKind::spot;
    lamp.inner_angle = 0.3f;
    lamp.outer_angle = 0.9f;
    light(lamp, {-2.0, 4.0, 3.0}, {0.3, -1.0, -0.2});
    lamp.kind = LightKind::directional;
    lamp.intensity = 2.0f;
    light(lamp, {}, {0.2, -1.0, -0.4});
  }
  /// Illuminance of the floor under a pixel.
  [[nodiscard]] dvec3 illuminance(std::uint32_t x, std::uint32_t y, const std::vector<OracleLight>& of) const {
    dvec3 sum(0.0);
    const dvec3 at = seen.position(x, y) + seen.view.position;
    for (const OracleLight& l : of) {
      const OracleArrival arrival = oracle_arrival(at, l);
      sum += arrival.illuminance * std::max(arrival.to_light.y, 0.0);
    }
    return sum;
  }
  [[nodiscard]] std::vector<OracleLight> now() const {
    std::vector<OracleLight> current = lights;
    for (std::size_t i = 0; i < current.size(); ++i) current[i].light = proxies->world.get<Light>(entities[i]);
    return current;
  }
  [[nodiscard]] Blended draw(bool follow = true) {
    BlendInput in = blend_input(seen, 1);
    for (std::uint32_t y = 0; y < 20; ++y)
      for (std::uint32_t x = 0; x < 24; ++x) {
        dvec3 light(0.0);
        if (seen.object[seen.at(x, y)] == 0) light = illuminance(x, y, now());
        in.diffuse_light.emplace_back(vec3(light), 1.0f);
      }
    if (follow) in.changed = changed_lights(proxies->world, seen.view, proxies->captures);
    const FlatLayers images(device(), 4, 1, std::vector<vec4>{vec4(0.5f, 0.25f, 1.0f, 1.0f)});
    return blend(device(), in, *proxies, images);
  }
  /// Calls check(x, y, texel) for each texel that shows the proxy.
  template <class Check>
  void each_shown(const Check& check) const {
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < 20; ++y)
      for (std::uint32_t x = 0; x < 24; ++x) {
        const std::size_t texel = seen.at(x, y);
        if (seen.object[texel] != 0 || seen.position(x, y).z + 6.0 < -3.9 || seen.mirrored(x, y).y < 1e-3) continue;
        check(x, y, texel);
        ++count;
      }
    EXPECT_GT(count, 100u);
  }

  std::unique_ptr<ProxyWorld> proxies;
  SyntheticView seen;
  std::vector<OracleLight> lights;  ///< at capture
  std::vector<Entity> entities;
};

double weighed(const dvec3& light) { return glm::dot(light, dvec3(0.2126, 0.7152, 0.0722)); }

TEST_F(ChangedLights, colours_are_as_captured_while_no_light_changes) {
  put_lights();
  EXPECT_TRUE(changed_lights(proxies->world, seen.view, proxies->captures).empty());
  const Blended with = draw(), without = draw(false);
  EXPECT_EQ(with.color, without.color);
  each_shown([&](std::uint32_t, std::uint32_t, std::size_t texel) {
    ASSERT_EQ(with.color[texel], vec4(0.5f, 0.25f, 1.0f, 1.0f));
  });
}

TEST_F(ChangedLights, colours_follow_the_receivers_light) {
  for (std::size_t changed = 0; changed < 3; ++changed)
    for (const float factor : {0.0f, 0.3f, 2.5f}) {
      SetUp();
      lights.clear();
      entities.clear();
      put_lights();
      Light& light = proxies->world.get<Light>(entities[changed]);
      light.intensity *= factor;
      ASSERT_EQ(changed_lights(proxies->world, seen.view, proxies->captures).size(), 1u);
      const Blended picture = draw();
      double lowest = 10.0;
      each_shown([&](std::uint32_t x, std::uint32_t y, std::size_t texel) {
        const double then = weighed(illuminance(x, y, lights)), today = weighed(illuminance(x, y, now()));
        const double ratio = std::clamp(today / then, 0.0, 8.0);
        lowest = std::min(lowest, ratio);
        ASSERT_NEAR(static_cast<double>(picture.color[texel].b), ratio, 5e-3 * std::max(ratio, 1.0))
            << changed << ", factor " << factor << ", texel " << x << ", " << y;
        ASSERT_NEAR(picture.color[texel].r, 0.5f * picture.color[texel].b, 2e-3f);
        ASSERT_EQ(picture.color[texel].a, 1.0f) << "a scaled colour is as opaque as before";
      });
      if (factor < 1.0f) {
        EXPECT_LT(lowest, 0.9);
      }
    }
}

TEST_F(ChangedLights, without_light_captured_colours_are_black) {
  put_lights();
  for (const Entity entity : entities) proxies->world.get<Light>(entity).intensity = 0.0f;
  const Blended picture = draw();
  each_shown([&](std::uint32_t, std::uint32_t, std::size_t texel) {
    ASSERT_LT(picture.color[texel].b, 1e-3f);
    ASSERT_TRUE(std::isfinite(picture.color[texel].r));
  });
}

TEST_F(ChangedLights, floors_that_had_and_have_no_light_keep_the_captured_colours) {
  Light lamp;
  lamp.intensity = 20.0f;
  lamp.range_m = 0.5f;
  light(lamp, {0.0, 10.0, 0.0});  // lights nothing of the floor
  proxies->world.get<Light>(entities[0]).intensity = 5.0f;
  const Blended picture = draw();
  each_shown([&](std::uint32_t, std::uint32_t, std::size_t texel) {
    ASSERT_EQ(picture.color[texel], vec4(0.5f, 0.25f, 1.0f, 1.0f));
  });
}

TEST_F(ChangedLights, a_fire_is_not_scaled_by_the_receivers_light) {
  put_lights();
  proxies->world.get<IbrProxy>(proxies->set.proxies[0].entity).kind = IbrProxyKind::fire;
  for (const Entity entity : entities) proxies->world.get<Light>(entity).intensity *= 0.1f;
  const Blended picture = draw();
  each_shown([&](std::uint32_t, std::uint32_t, std::size_t texel) {
    ASSERT_EQ(picture.color[texel], vec4(0.5f, 0.25f, 1.0f, 1.0f));
  });
}

TEST_F(ChangedLights, a_proxy_dims_with_its_own_lights_and_vanishes_without_them) {
  put_lights();
  proxies->captures.proxy_lights = {{0, entities[0], 0.75f}, {0, entities[1], 0.25f}};
  const auto with_factors = [&](float first, float second) {
    proxies->world.get<Light>(entities[0]).intensity = 20.0f * first;
    proxies->world.get<Light>(entities[1]).intensity = 20.0f * second;
    return draw(false);
  };
  const Blended dim = with_factors(0.5f, 1.0f), gone = with_factors(0.0f, 0.0f), bright = with_factors(2.0f, 2.0f);
  each_shown([&](std::uint32_t, std::uint32_t, std::size_t texel) {
    ASSERT_NEAR(dim.color[texel].b, 0.625f, 2e-3f);
    ASSERT_NEAR(dim.color[texel].a, 0.625f, 2e-3f) << "the rest is seen in the next tier";
    ASSERT_EQ(gone.color[texel], vec4(0.0f));
    ASSERT_NEAR(bright.color[texel].b, 2.0f, 4e-3f);
    ASSERT_EQ(bright.color[texel].a, 1.0f);
  });
  proxies->world.destroy(entities[0]);
  proxies->world.destroy(entities[1]);
  lights.clear(), entities.clear();
  EXPECT_EQ(proxy_dim(proxies->world, proxies->captures, 0), 0.0f) << "lights that no longer exist are off";
}

TEST_F(ChangedLights, a_proxy_that_was_captured_later_or_never_is_not_shown) {
  proxies->captures.proxy_entities.clear();
  const Blended picture = draw(false);
  each_shown([&](std::uint32_t, std::uint32_t, std::size_t texel) { ASSERT_EQ(picture.color[texel], vec4(0.0f)); });
}

}  // namespace
}  // namespace gloam::test
