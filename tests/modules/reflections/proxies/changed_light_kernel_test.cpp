// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "tests/modules/reflections/support/blend_kernel.h"
#include "tests/support/render_scene.h"

namespace gloam::test {
namespace {

const vec4 kAll(0.5f, 0.25f, 1.0f, 1.0f), kEmission(0.125f, 0.25f, 0.5f, 1.0f);

/// A floor before a wall that is a proxy, with lights that change after the capture. Layer 0 shows all light, layer 1
/// the part that no lamp causes.
class ChangedLight : public KernelTest {
 protected:
  void SetUp() override {
    KernelTest::SetUp();
    ProxyScene scene;
    scene.add({0.0, 0.0, -4.0}, {0.0, 0.0, 1.0}, kWall);
    proxies = std::make_unique<ProxyWorld>(scene);
    proxies->captures.proxy_parts.resize(1);
    seen = look({}, look_at({0.5, 1.2, 6.0}, {0.0, 0.4, 0.0}, 24, 20));
  }
  Entity light(float candela) {
    Light what;
    what.intensity = candela;
    const Entity entity = proxies->world.create(what, WorldTransform{});
    proxies->captures.lights.push_back({.light = entity, .emitted = vec3(candela)});
    return entity;
  }
  /// factors: of the proxy's cells; none: as captured.
  [[nodiscard]] Blended draw(const std::vector<vec4>& factors = {}) {
    BlendInput in = blend_input(seen, 1);
    in.cells = {vec4(9.0f)};  // of another proxy
    in.cells.insert(in.cells.end(), factors.begin(), factors.end());
    if (!factors.empty()) in.factors = {{.first = 1}};
    const FlatLayers images(device(), 4, 2, std::vector<vec4>{kAll, kEmission});
    return blend(device(), in, *proxies, images);
  }
  /// Calls check(uv, texel) for each texel that shows the proxy. uv: of its image.
  template <class Check>
  void each_shown(const Check& check) const {
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < 20; ++y)
      for (std::uint32_t x = 0; x < 24; ++x) {
        const std::size_t texel = seen.at(x, y);
        const dvec3 at = seen.position(x, y) + seen.view.position, along = seen.mirrored(x, y);
        if (seen.object[texel] != 0 || at.z < -3.9 || along.y < 1e-3 || along.z > -1e-3) continue;
        const dvec3 met = at + along * ((-4.0 - at.z) / along.z);
        const dvec2 uv(0.5 + met.x / static_cast<double>(kWall.x), 0.5 - met.y / static_cast<double>(kWall.y));
        if (std::max(std::abs(uv.x - 0.5), std::abs(uv.y - 0.5)) > 0.49) continue;
        check(uv, texel);
        ++count;
      }
    EXPECT_GT(count, 40u);
  }

  static constexpr vec2 kWall = vec2(12.0f, 10.0f);
  std::unique_ptr<ProxyWorld> proxies;
  SyntheticView seen;
};

TEST_F(ChangedLight, without_factors_the_image_is_shown_as_captured) {
  proxies->captures.proxy_parts[0].emission = 1;
  const Blended picture = draw();
  each_shown([&](const dvec2&, std::size_t texel) { ASSERT_EQ(picture.color[texel], kAll); });
}

TEST_F(ChangedLight, factors_scale_the_light_of_lamps_between_the_middles_of_cells) {
  std::vector<vec4> factors;
  for (int i = 0; i < GLOAM_PROXY_CELLS * GLOAM_PROXY_CELLS; ++i)
    factors.emplace_back(0.1f * static_cast<float>(i), 2.0f, static_cast<float>(i % GLOAM_PROXY_CELLS), 1.0f);
  const auto expected = [&](const dvec2& uv, int channel) {
    const dvec2 at = glm::clamp(uv * double{GLOAM_PROXY_CELLS} - 0.5, dvec2(0.0), dvec2(GLOAM_PROXY_CELLS - 1));
    double sum = 0.0;
    for (int y = 0; y < GLOAM_PROXY_CELLS; ++y)
      for (int x = 0; x < GLOAM_PROXY_CELLS; ++x)
        sum += std::max(0.0, 1.0 - std::abs(at.x - x)) * std::max(0.0, 1.0 - std::abs(at.y - y)) *
               static_cast<double>(factors[static_cast<std::size_t>(y * GLOAM_PROXY_CELLS + x)][channel]);
    return sum;
  };
  for (const bool emission : {false, true}) {
    proxies->captures.proxy_parts[0].emission = emission ? 1 : -1;
    const Blended picture = draw(factors);
    each_shown([&](const dvec2& uv, std::size_t texel) {
      for (int c = 0; c < 3; ++c) {
        const double kept = emission ? static_cast<double>(kEmission[c]) : 0.0;
        const double light = kept + expected(uv, c) * (static_cast<double>(kAll[c]) - kept);
        ASSERT_NEAR(static_cast<double>(picture.color[texel][c]), light, 4e-3 * std::max(light, 1.0)) << uv.x;
      }
      ASSERT_EQ(picture.color[texel].a, 1.0f) << "a scaled colour is as opaque as before";
    });
  }
}

TEST_F(ChangedLight, without_lamps_a_wall_is_opaque_and_keeps_what_is_not_theirs) {
  const std::vector<vec4> off(std::size_t{GLOAM_PROXY_CELLS} * GLOAM_PROXY_CELLS, vec4(0.0f, 0.0f, 0.0f, 1.0f));
  const Blended black = draw(off);
  proxies->captures.proxy_parts[0].emission = 1;
  const Blended kept = draw(off);
  each_shown([&](const dvec2&, std::size_t texel) {
    ASSERT_EQ(black.color[texel], vec4(0.0f, 0.0f, 0.0f, 1.0f));
    ASSERT_EQ(kept.color[texel], kEmission);
  });
}

TEST_F(ChangedLight, a_fire_dims_with_its_own_lights_and_vanishes_without_them) {
  proxies->world.get<IbrProxy>(proxies->set.proxies[0].entity).kind = IbrProxyKind::fire;
  const Entity first = light(20.0f), second = light(20.0f);
  proxies->captures.proxy_lights = {{0, first, 0.75f}, {0, second, 0.25f}};
  const auto with_factors = [&](float of_first, float of_second) {
    proxies->world.get<Light>(first).intensity = 20.0f * of_first;
    proxies->world.get<Light>(second).intensity = 20.0f * of_second;
    return draw();
  };
  const Blended dim = with_factors(0.5f, 1.0f), gone = with_factors(0.0f, 0.0f), bright = with_factors(2.0f, 2.0f);
  each_shown([&](const dvec2&, std::size_t texel) {
    ASSERT_NEAR(dim.color[texel].b, 0.625f, 2e-3f);
    ASSERT_NEAR(dim.color[texel].a, 0.625f, 2e-3f) << "the rest is seen in the next tier";
    ASSERT_EQ(gone.color[texel], vec4(0.0f));
    ASSERT_NEAR(bright.color[texel].b, 2.0f, 4e-3f);
    ASSERT_EQ(bright.color[texel].a, 1.0f);
  });
  proxies->world.destroy(first);
  proxies->world.destroy(second);
  EXPECT_EQ(proxy_dim(proxies->world, proxies->captures, 0), 0.0f) << "lights that no longer exist are off";
}

TEST_F(ChangedLight, a_proxy_that_was_captured_later_or_never_is_not_shown) {
  proxies->captures.proxy_entities.clear();
  const Blended picture = draw();
  each_shown([&](const dvec2&, std::size_t texel) { ASSERT_EQ(picture.color[texel], vec4(0.0f)); });
}

}  // namespace
}  // namespace gloam::test
