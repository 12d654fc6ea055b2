// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/modules/shadows/support/hard_shadows.h"

// shadows.min_contribution: what dim lights change in a pixel is at most the light that they could add without shadows.

namespace gloam {
namespace {

constexpr double kLeast = 1.0 / 256.0;
constexpr double kMostLights = 4.0;  // most light of a tile's dim lights, over the knob's value

/// What a scene of this test differs in.
struct DimCase {
  std::uint8_t roughness = 200;
  std::uint8_t metallic = 0;
  double scale = 1.0;  ///< of all lengths; lights get its square
  float ev100 = 0.0f;
  bool wide = false;  ///< highlights are as wide as lamps and pixels
  bool balls = false;
};

class DimLights : public test::HardShadows {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HardShadows::SetUp());
    if (IsSkipped()) return;
    environment().sky_zenith = environment().sky_horizon = environment().sky_ground = vec3(0.0f);
    set("shadows.visibility_bits", "8");
    set("shadows.mode", "deferred");
    set("shadows.atlas", "1024");
    set("shadows.reuse", "off");
    set("lighting.reuse", "off");
  }

  /// A floor with boxes and rods, and lights of which some are dim in most tiles.
  void build(const DimCase& c) {
    material_ = exact_material(210, 180, 150, c.roughness, c.metallic);
    const std::uint32_t used = scene.material(material_);
    const dmat4 scaled = glm::scale(dmat4(1.0), dvec3(c.scale));
    const auto put = [&](Primitive shape, const dmat4& where) {
      things.push_back(scene.draw(scene.mesh(std::move(shape)), scaled * where));
    };
    put(test::quad(3.0f, used), flat(0.0));
    for (int i = 0; i < 9; ++i) put(test::box(vec3(0.03f, 0.4f, 0.03f), used), at(-1.2 + 0.3 * i, 0.4, -0.5 + i % 3));
    if (c.balls)
      put(test::ball(0.3f, used), at(0.3, 0.3, 0.6));
    else
      put(test::box(vec3(0.2f), used), at(0.3, 0.2, 0.6));
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int i = 0; i < 24; ++i) {
      Light made = i % 3 == 0 ? spot(50.0, 0.1f) : point(i % 2 == 0 ? 0.08f : 0.0f);
      made.range_m = static_cast<float>(c.scale * between(2.0, 6.0));
      made.width_m *= static_cast<float>(c.scale);
      made.color = vec3(dvec3(between(0.3, 1.0), between(0.3, 1.0), between(0.3, 1.0)));
      const double exposed = std::exp2(static_cast<double>(c.ev100)) * c.scale * c.scale;
      made.intensity = static_cast<float>(exposed * std::exp2(between(-9.0, -1.0)));
      const dvec3 place(between(-1.5, 1.5), i == 1 ? 0.03 : between(0.2, 1.5), between(-1.2, 1.2));
      lamps_.push_back(lamp(made, c.scale * place, dvec3(0.1, -1.0, 0.2), 64));
    }
    environment().exposure_ev100 = c.ev100;
    settings = test::look_at(c.scale * dvec3(0.3, 1.3, 2.6), c.scale * dvec3(0.0, 0.1, 0.0), 96, 56);
    settings.camera.near_m = static_cast<float>(0.05 * c.scale);
    set("lights.emitter_highlights", c.wide ? "on" : "off");
    set("lighting.specular_antialiasing", c.wide ? "on" : "off");
  }

  void clear() {
    for (const Entity entity : things) world.destroy(entity);
    things.clear();
    lamps_.clear();
    oracle_lights.clear();
  }

  [[nodiscard]] double white() { return 1.2 * std::exp2(static_cast<double>(environment().exposure_ev100)); }
  [[nodiscard]] LinearPicture with(double least) {
    set("shadows.min_contribution", std::to_string(least));
    return drawn();
  }
  /// The light that each lamp alone gives without shadows, each drawn by itself.
  [[nodiscard]] std::vector<LinearPicture> drawn_alone() {
    set("shadows.mode", "off");
    std::vector<Light> lights;
    for (const Entity lamp : lamps_) lights.push_back(world.get<Light>(lamp));
    std::vector<LinearPicture> pictures;
    for (std::size_t only = 0; only < lamps_.size(); ++only) {
      for (std::size_t i = 0; i < lamps_.size(); ++i)
        world.get<Light>(lamps_[i]).intensity = i == only ? lights[i].intensity : 0.0f;
      pictures.push_back(drawn());
    }
    for (std::size_t i = 0; i < lamps_.size(); ++i) world.get<Light>(lamps_[i]) = lights[i];
    set("shadows.mode", "deferred");
    return pictures;
  }
  /// The same in double precision; 0 at pixels without a surface.
  [[nodiscard]] std::vector<LinearPicture> computed_alone() {
    draw();
    const GeometryPicture geometry = test::value_of(renderer->read_geometry(world, settings.id));
    std::vector<LinearPicture> pictures(oracle_lights.size());
    for (std::size_t l = 0; l < pictures.size(); ++l) {
      pictures[l] = {settings.width, settings.height, std::vector<float>(geometry.depth.size() * 4)};
      for (std::size_t i = 0; i < geometry.depth.size(); ++i) {
        if (geometry.is_sky(i)) continue;
        const Ray r =
            ray(static_cast<std::uint32_t>(i % settings.width), static_cast<std::uint32_t>(i / settings.width));
        const double depth = static_cast<double>(settings.camera.near_m) / static_cast<double>(geometry.depth[i]);
        test::OracleSurface s;
        s.position = r.origin + r.direction * (depth / glm::dot(r.direction, -dvec3(settings.world_from_camera[2])));
        s.normal = dvec3(geometry.texel(i).normal);
        s.to_eye = -r.direction;
        s.base_color = dvec3(material_.base_color);
        s.metallic = static_cast<double>(material_.metallic);
        s.roughness = static_cast<double>(material_.roughness);
        const dvec3 light = test::oracle_light(s, oracle_lights[l]);
        for (int c = 0; c < 3; ++c)
          pictures[l].rgba[4 * i + static_cast<std::size_t>(c)] = static_cast<float>(light[c]);
      }
    }
    return pictures;
  }

  /// Draws with and without dim lights. Expects that each pixel changes by at most the light of those lights of
  /// `alone` that are nowhere in its tile brighter than the knob allows.
  void expect_bounded(const std::string& what, const std::vector<LinearPicture>& alone) {
    const LinearPicture right = with(0.0), seen = with(kLeast);
    if (HasFatalFailure()) return;
    const double most = kLeast * white();
    double greatest = 0.0, over_sum = 0.0, over_four = 0.0;
    std::size_t changed = 0;
    for (std::uint32_t tile = 0; tile < 12 * 7; ++tile) {
      std::vector<std::size_t> pixels;
      for (std::size_t i = 0; i < 64; ++i)
        pixels.push_back((tile / 12 * 8 + i / 8) * settings.width + tile % 12 * 8 + i % 8);
      std::vector<bool> dim;
      for (const LinearPicture& light : alone) {
        double brightest = 0.0;
        for (const std::size_t i : pixels)
          for (std::size_t c = 0; c < 3; ++c)
            brightest = std::max(brightest, static_cast<double>(light.rgba[4 * i + c]));
        dim.push_back(brightest <= most * 1.001);
      }
      for (const std::size_t i : pixels)
        for (std::size_t c = 4 * i; c < 4 * i + 3; ++c) {
          double left_out = 0.0;
          for (std::size_t l = 0; l < alone.size(); ++l)
            left_out += dim[l] ? static_cast<double>(alone[l].rgba[c]) : 0.0;
          // Both pictures are half floats, and visibilities have 255 steps.
          const double rounding = static_cast<double>(right.rgba[c]) / 512.0 + left_out / 255.0;
          const double change = std::abs(static_cast<double>(seen.rgba[c]) - static_cast<double>(right.rgba[c]));
          changed += change > rounding ? 1 : 0;
          greatest = std::max(greatest, change);
          over_sum = std::max(over_sum, change - left_out - rounding);
          over_four = std::max(over_four, change - kMostLights * most - rounding);
        }
    }
    std::printf("%-28s dim %5.0f of %5.0f pairs, bound %.5f, greatest change %.5f of white\n", what.c_str(),
                counter("shadows.tile_lights_dim"), counter("shadows.tile_lights_filtered"),
                counter("shadows.dim_light"), greatest / white());
    EXPECT_LE(over_sum, 0.0) << what;
    EXPECT_LE(over_four, 0.0) << what;
    EXPECT_LE(counter("shadows.dim_light"), kMostLights * kLeast * 1.0001) << what;
    EXPECT_GT(counter("shadows.tile_lights_dim"), 20.0) << what;
    EXPECT_GT(changed, 20u) << what << ": the test needs lights whose mean visibility is not that of each pixel";
  }

  Material material_;
  std::vector<Entity> lamps_;
};

TEST_F(DimLights, change_a_pixel_by_at_most_their_unshadowed_light) {
  build({});
  expect_bounded("matt, in double", computed_alone());
  expect_bounded("matt, drawn", drawn_alone());
}

TEST_F(DimLights, keep_their_highlights_on_a_mirror) {
  build({.roughness = 20, .metallic = 255});
  expect_bounded("mirror, in double", computed_alone());
}

TEST_F(DimLights, keep_their_highlights_on_a_glossy_floor) {
  build({.roughness = 80});
  expect_bounded("glossy, in double", computed_alone());
}

TEST_F(DimLights, keep_wide_highlights_on_curved_surfaces) {
  build({.roughness = 60, .metallic = 128, .wide = true, .balls = true});
  expect_bounded("wide, drawn", drawn_alone());
}

TEST_F(DimLights, are_the_same_at_every_scale) {
  for (const double scale : {0.01, 100.0}) {
    build({.roughness = 120, .scale = scale});
    expect_bounded("scale " + std::to_string(scale), computed_alone());
    clear();
  }
}

TEST_F(DimLights, follow_the_exposure) {
  for (const float ev100 : {-4.0f, 4.0f}) {
    build({.roughness = 120, .ev100 = ev100});
    expect_bounded("exposure " + std::to_string(ev100), computed_alone());
    clear();
  }
}

TEST_F(DimLights, are_none_where_white_is_not_known_before_or_nobody_asks) {
  build({});
  const LinearPicture right = with(0.0);
  EXPECT_EQ(counter("shadows.tile_lights_dim"), 0.0);
  EXPECT_EQ(counter("shadows.dim_light"), 0.0);
  EXPECT_NE(with(kLeast).rgba, right.rgba);
  environment().has_exposure = false;
  EXPECT_EQ(with(kLeast).rgba, with(0.0).rgba);
  EXPECT_EQ(counter("shadows.tile_lights_dim"), 0.0);
}

}  // namespace
}  // namespace gloam
