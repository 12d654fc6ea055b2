// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "modules/closeups/components.h"
#include "tests/modules/shadows/support/hard_shadows.h"
#include "tests/support/worse.h"

namespace gloam {
namespace {

/// Bodies that light passes through, seen from their dark side by a camera on +Z. Lights are behind them.
class ShadowTransmission : public test::HardShadows {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HardShadows::SetUp());
    if (IsSkipped()) return;
    settings = test::look_at(dvec3(0.1, 0.05, 0.7), dvec3(0.0), 40, 40);
  }

  /// base: share of light that the material reflects, in 8-bit square roots, so that the geometry buffer is exact.
  [[nodiscard]] static Material flesh(float extinction_m, bool double_sided = false) {
    Material made;
    const auto exact = [](int root) { return static_cast<float>(root * root) / (255.0f * 255.0f); };
    made.base_color = vec4(exact(200), exact(150), exact(90), 1.0f);
    made.roughness = 1.0f;
    made.metallic = 0.0f;
    made.subsurface = true;
    made.extinction_m = extinction_m;
    made.double_sided = double_sided;
    return made;
  }

  /// Light on the dark side of a surface, with nothing in between: what the lit side does not reflect (Fresnel's term,
  /// then the albedo) enters, and leaves evenly to all sides, tinted by the albedo.
  [[nodiscard]] static dvec3 passed(const Material& material, const dvec3& normal, const test::OracleArrival& arrival) {
    const double cosine = -glm::dot(normal, arrival.to_light);
    if (cosine <= 0.0) return dvec3(0.0);
    const dvec3 albedo(material.base_color);
    const double fresnel = 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
    return arrival.illuminance * cosine * (1.0 - fresnel) * (1.0 - albedo) * albedo / test::kPiOracle;
  }

  struct Deviation {
    double worst = 0.0;  ///< greatest difference, as a share of the light that passes through a sheet
    double mean = 0.0;
    std::size_t pixels = 0;
  };
  /// The drawn light against `expected` (share of the light that crosses the body) at each point with |x|, |y| ≤ half
  /// on the plane through `middle` with this normal.
  using Expected = std::function<double(const dvec3& point, const test::OracleArrival& arrival)>;
  [[nodiscard]] Deviation deviation(const LinearPicture& seen, const Material& material, const dvec3& middle,
                                    const dvec3& normal, double half, const Expected& expected) {
    Deviation found;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const Ray r = ray(x, y);
        const dvec3 point =
            r.origin + r.direction * (glm::dot(middle - r.origin, normal) / glm::dot(r.direction, normal));
        if (std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) > half) continue;
        dvec3 sum(0.0), full(0.0);
        for (const test::OracleLight& l : oracle_lights) {
          const test::OracleArrival arrival = test::oracle_arrival(point, l);
          full += passed(material, normal, arrival);
          sum += passed(material, normal, arrival) * expected(point, arrival);
        }
        const dvec3 off = glm::abs(pixel(seen, x, y) - sum) / full;
        found.worst = std::max({found.worst, off.x, off.y, off.z});
        found.mean += (off.x + off.y + off.z) / 3.0;
        ++found.pixels;
      }
    found.mean /= static_cast<double>(std::max<std::size_t>(found.pixels, 1));
    return found;
  }

  struct NamedLight {
    const char* name;
    Light light;
    dvec3 position;
    dvec3 direction;
  };
  [[nodiscard]] static std::vector<NamedLight> lights_behind() {
    return {{"sun", sun(0.0f), dvec3(0.0), dvec3(0.3, -0.4, 1.0)},
            {"wide sun", sun(0.02f), dvec3(0.0), dvec3(-0.2, 0.3, 1.0)},
            {"spot", spot(40.0), dvec3(0.3, 0.2, -1.1), dvec3(-0.3, -0.2, 1.1)},
            {"wide spot", spot(40.0, 0.04f), dvec3(0.3, 0.2, -1.1), dvec3(-0.3, -0.2, 1.1)},
            {"lamp", point(0.0f), dvec3(-0.2, 0.1, -1.0), dvec3(0.0, 0.0, 1.0)},
            {"wide lamp", point(0.05f), dvec3(0.3, -0.2, -1.2), dvec3(0.0, 0.0, 1.0)}};
  }
  /// The only light of the scene.
  void shine(const NamedLight& made) {
    darken();
    lamp(made.light, made.position, made.direction);
  }
  void darken() {
    std::erase_if(things, [&](Entity thing) {
      if (world.try_get<Light>(thing) == nullptr) return false;
      world.destroy(thing);
      return true;
    });
    oracle_lights.clear();
  }
  void clear() {
    for (const Entity thing : things) world.destroy(thing);
    things.clear();
    oracle_lights.clear();
  }
  Entity slab(const Material& material, double thickness_m, double half = 0.6) {
    return thing(
        test::box(vec3(static_cast<float>(half), static_cast<float>(half), static_cast<float>(0.5 * thickness_m)),
                  scene.material(material)),
        at(0.0, 0.0, -0.5 * thickness_m));
  }
  /// A sheet through the origin, turned about y.
  Entity leaf(const Material& material, double turn, float half = 0.3f) {
    return thing(test::quad(half, scene.material(material)), glm::rotate(dmat4(1.0), turn, dvec3(0.0, 1.0, 0.0)));
  }
};

constexpr double kFullShare = 1.0;

TEST_F(ShadowTransmission, a_slab_lets_light_through_by_its_thickness) {
  for (const char* filter : {"chs", "pcss", "hard"}) {
    set("shadows.filter", filter);
    for (const double thickness : {0.002, 0.01, 0.03})
      for (const float extinction : {0.003f, 0.02f}) {
        clear();
        const Material material = flesh(extinction);
        slab(material, thickness);
        for (const NamedLight& light : lights_behind()) {
          shine(light);
          const Deviation off =
              deviation(drawn(), material, dvec3(0.0), dvec3(0.0, 0.0, 1.0), 0.2,
                        [&](const dvec3&, const test::OracleArrival& arrival) {
                          return std::exp(thickness / arrival.to_light.z / static_cast<double>(extinction));
                        });
          const std::string what = std::string(filter) + ", " + light.name + ", " + std::to_string(thickness) +
                                   " m, length " + std::to_string(extinction);
          std::printf("%-50s worst %.4f mean %.4f of %zu\n", what.c_str(), off.worst, off.mean, off.pixels);
          EXPECT_LE(off.worst, 0.01) << what;
          EXPECT_GE(off.pixels, 200u) << what;
        }
      }
  }
}

TEST_F(ShadowTransmission, a_sheet_shines_through_with_all_its_light_at_any_slope) {
  const Material material = flesh(0.001f, true);
  for (const double turn : {0.0, 0.5, -1.2, 1.35}) {
    clear();
    leaf(material, turn);
    const dvec3 normal(std::sin(turn), 0.0, std::cos(turn));
    for (const NamedLight& light : lights_behind()) {
      shine(light);
      if (-glm::dot(normal, test::oracle_arrival(dvec3(0.0), oracle_lights.front()).to_light) < 0.1) continue;
      const Deviation off = deviation(drawn(), material, dvec3(0.0), normal, 0.15,
                                      [](const dvec3&, const test::OracleArrival&) { return kFullShare; });
      std::printf("turned by %5.2f, %-10s worst %.4f mean %.4f of %zu\n", turn, light.name, off.worst, off.mean,
                  off.pixels);
      EXPECT_LE(off.worst, 0.03) << light.name << " at " << turn;
      EXPECT_LE(off.mean, 0.01) << light.name << " at " << turn;
      EXPECT_GE(off.pixels, 20u);
    }
  }
}

TEST_F(ShadowTransmission, a_wall_before_a_sheet_shadows_it) {
  const Material material = flesh(0.005f, true);
  leaf(material, 0.0);
  box(dvec3(0.0, 0.0, -0.5), dvec3(2.0, 2.0, 0.01));
  for (const NamedLight& light : lights_behind()) {
    shine(light);
    const Deviation off = deviation(drawn(), material, dvec3(0.0), dvec3(0.0, 0.0, 1.0), 0.25,
                                    [](const dvec3&, const test::OracleArrival&) { return 0.0; });
    EXPECT_LE(off.worst, 1e-4) << light.name;
  }
}

TEST_F(ShadowTransmission, blended_sheets_let_light_through_as_others_do) {
  Material material = flesh(0.005f, true);
  material.alpha_mode = AlphaMode::blend;
  leaf(material, 0.4);
  const dvec3 normal(std::sin(0.4), 0.0, std::cos(0.4));
  const auto worst = [&](double share) {
    return deviation(drawn(), material, dvec3(0.0), normal, 0.15,
                     [&](const dvec3&, const test::OracleArrival&) { return share; })
        .worst;
  };
  for (const NamedLight& light : lights_behind()) {
    shine(light);
    EXPECT_LE(worst(kFullShare), 0.01) << light.name;
    const Entity wall = box(dvec3(0.0, 0.0, -0.5), dvec3(2.0, 2.0, 0.01));
    EXPECT_LE(worst(0.0), 1e-4) << light.name;
    world.destroy(wall);
    things.pop_back();
  }
}

TEST_F(ShadowTransmission, a_ball_is_bright_at_its_rim_and_dark_in_its_middle) {
  constexpr double kRadius = 0.15;
  constexpr float kLength = 0.1f;
  const Material material = flesh(kLength);
  thing(test::round_ball(static_cast<float>(kRadius), 96, 64, scene.material(material)));
  for (const NamedLight& light : {NamedLight{"sun", sun(), dvec3(0.0), dvec3(0.0, 0.0, 1.0)},
                                  NamedLight{"lamp", point(), dvec3(0.2, 0.1, -1.5), dvec3(0.0, 0.0, 1.0)}}) {
    shine(light);
    const LinearPicture seen = drawn();
    double worst = 0.0, mean = 0.0, rim = 0.0, middle = 1.0;
    std::size_t pixels = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const Ray r = ray(x, y);
        const double b = glm::dot(r.origin, r.direction), c = glm::dot(r.origin, r.origin) - kRadius * kRadius;
        if (b * b - c <= 0.0) continue;
        const dvec3 point = r.origin + r.direction * (-b - std::sqrt(b * b - c));
        const dvec3 normal = point / kRadius;
        const test::OracleArrival arrival = test::oracle_arrival(point, oracle_lights.front());
        const double cosine = -glm::dot(normal, arrival.to_light);
        if (cosine < 0.15) continue;
        const double expected = std::exp(-2.0 * kRadius * cosine / static_cast<double>(kLength));
        const double share = pixel(seen, x, y).x / passed(material, normal, arrival).x;
        // At the rim the depth of the ball changes by many millimetres in a texel of the map.
        if (cosine > 0.3) worst = test::worse(worst, std::abs(share - expected));
        mean += std::abs(share - expected);
        if (cosine < 0.3) rim = std::max(rim, share);
        if (cosine > 0.95) middle = std::min(middle, share);
        ++pixels;
      }
    mean /= static_cast<double>(std::max<std::size_t>(pixels, 1));
    std::printf("%-6s worst %.4f, mean %.4f, rim %.3f, middle %.3f, %zu pixels\n", light.name, worst, mean, rim, middle,
                pixels);
    EXPECT_LE(worst, 0.04) << light.name;
    EXPECT_LE(mean, 0.01) << light.name;
    EXPECT_GE(pixels, 200u);
    EXPECT_GE(rim, 0.5);
    EXPECT_LE(middle, 0.1);
  }
}

TEST_F(ShadowTransmission, front_and_back_together_give_no_more_light_than_falls_on_a_sheet) {
  for (const int root : {60, 180, 240, 255}) {
    clear();
    Material material = flesh(0.005f, true);
    material.base_color = vec4(vec3(static_cast<float>(root * root) / (255.0f * 255.0f)), 1.0f);
    leaf(material, 0.0);
    // From both sides at once: each side shows what it reflects of one and lets through of the other.
    const dvec3 toward = glm::normalize(dvec3(0.2, 0.1, 1.0));
    lamp(sun(), dvec3(0.0), toward);
    lamp(sun(), dvec3(0.0), -toward);
    const double falls = 10.0 * toward.z;
    EXPECT_LE(pixel(drawn(), settings.width / 2, settings.height / 2).x * test::kPiOracle, 1.002 * falls) << root;
  }
}

TEST_F(ShadowTransmission, both_modes_draw_the_same_picture) {
  set("shadows.visibility_bits", "8");
  yard();
  thing(test::round_ball(0.25f, 12, 8, scene.material(flesh(0.1f))), at(0.7, 0.7, 0.6));
  thing(test::quad(0.3f, scene.material(flesh(0.004f, true))), at(-0.3, 0.6, 0.7));
  thing(test::box(vec3(0.2f, 0.2f, 0.004f), scene.material(flesh(0.01f))), at(-1.0, 0.5, 0.6));
  lamp(point(0.1f), dvec3(0.4, 0.9, -0.2));
  lamp(spot(50.0, 0.05f), dvec3(-1.0, 1.5, -1.4), dvec3(0.6, -0.9, 1.6));
  lamp(sun(0.02f), dvec3(0.0), dvec3(0.3, -0.5, 1.0));
  Light plain = point();
  world.add(light(plain, dvec3(0.0, 0.5, -1.5)), ShadowCaster{false, 256});
  for (const auto& [eye, width] : {std::pair(dvec3(0.3, 1.2, 2.4), 160u), std::pair(dvec3(-1.2, 0.5, 1.6), 90u)}) {
    settings = test::look_at(eye, dvec3(0.0, 0.4, 0.0), width, 90);
    for (const char* filter : {"chs", "pcss", "pcf", "hard"}) {
      set("shadows.filter", filter);
      set("shadows.mode", "monolithic");
      const LinearPicture whole = drawn();
      set("shadows.mode", "deferred");
      for (const char* classify : {"off", "on"}) {
        set("shadows.classify", classify);
        draw();
        EXPECT_EQ(drawn().rgba, whole.rgba) << filter << ", shadows.classify=" << classify;
        EXPECT_GT(counter("shadows.tile_lights_filtered"), 0.0);
      }
    }
  }
}

TEST_F(ShadowTransmission, lengths_in_other_units_give_the_same_light) {
  for (const double unit : {0.01, 1.0, 100.0}) {
    clear();
    constexpr double kThickness = 0.01;
    const Material material = flesh(static_cast<float>(0.01 * unit));
    slab(material, kThickness * unit, 0.6 * unit);
    settings = test::look_at(dvec3(0.1, 0.05, 0.7) * unit, dvec3(0.0), 40, 40);
    settings.camera.near_m = static_cast<float>(0.05 * unit);
    for (NamedLight light : lights_behind()) {
      light.light.width_m *= static_cast<float>(unit);
      light.light.range_m *= static_cast<float>(unit);
      if (light.light.kind != LightKind::directional) light.light.intensity *= static_cast<float>(unit * unit);
      light.position *= unit;
      shine(light);
      const Deviation off = deviation(
          drawn(), material, dvec3(0.0), dvec3(0.0, 0.0, 1.0), 0.2 * unit,
          [&](const dvec3&, const test::OracleArrival& arrival) { return std::exp(1.0 / arrival.to_light.z); });
      EXPECT_LE(off.worst, 0.01) << light.name << " at " << unit;
      EXPECT_GE(off.pixels, 200u) << light.name << " at " << unit;
    }
  }
}

TEST_F(ShadowTransmission, drawn_light_agrees_with_rays_through_the_bodies) {
  thing(test::round_ball(0.25f, 48, 32, scene.material(flesh(0.15f))), at(0.5, 0.45, 0.0));
  thing(test::quad(0.3f, scene.material(flesh(0.004f, true))), at(-0.3, 0.6, 0.3));
  thing(test::box(vec3(0.2f, 0.3f, 0.01f), scene.material(flesh(0.02f))),
        glm::rotate(at(-0.8, 0.4, 0.2), 0.3, dvec3(0.0, 1.0, 0.0)));
  floor();
  box(dvec3(-0.2, 0.4, -0.6), dvec3(0.1, 0.4, 0.1), 0.4);
  settings = test::look_at(dvec3(0.1, 0.9, 2.2), dvec3(0.0, 0.4, 0.0), 160, 90);
  const std::pair<const char*, Entity> lights[] = {
      {"lamp", lamp(point(0.05f), dvec3(0.1, 0.9, -1.4))},
      {"spot", lamp(spot(50.0, 0.08f), dvec3(-0.9, 1.2, -1.4), dvec3(0.9, -0.9, 1.4))},
      {"sun", lamp(sun(0.02f), dvec3(0.0), dvec3(0.2, -0.4, 1.0))}};
  for (const char* mode : {"monolithic", "deferred"}) {
    set("shadows.mode", mode);
    set("shadows.visibility_bits", mode == std::string("deferred") ? "8" : "exact");
    const TracedVisibility traced = trace();
    for (const auto& [name, light] : lights) expect_right(std::string(name) + ", " + mode, error(light, traced));
  }
}

TEST_F(ShadowTransmission, lights_without_shadows_shine_through_as_if_bodies_had_no_thickness) {
  const Material material = flesh(0.002f);
  slab(material, 0.05);
  lamp(point(), dvec3(-0.2, 0.1, -1.0));
  const auto share_is = [&](double share) {
    return deviation(drawn(), material, dvec3(0.0), dvec3(0.0, 0.0, 1.0), 0.2,
                     [&](const dvec3&, const test::OracleArrival&) { return share; })
        .worst;
  };
  EXPECT_LE(share_is(0.0), 1e-4);
  for (const char* mode : {"monolithic", "deferred"}) {
    set("shadows.mode", mode);
    world.get<ShadowCaster>(things.back()).enabled = false;
    EXPECT_LE(share_is(kFullShare), 0.005);
    world.get<ShadowCaster>(things.back()).enabled = true;
  }
  set("shadows.mode", "off");
  EXPECT_LE(share_is(kFullShare), 0.005);
}

TEST_F(ShadowTransmission, no_light_passes_without_a_length) {
  slab(flesh(0.0f), 0.001);
  for (const NamedLight& light : lights_behind()) lamp(light.light, light.position, light.direction);
  EXPECT_EQ(pixel(drawn(), 20, 20), dvec3(0.0));
}

TEST_F(ShadowTransmission, tiles_that_no_light_passes_are_judged_as_without_light_through_bodies) {
  set("shadows.mode", "deferred");
  set("shadows.visibility_bits", "8");
  set("shadows.reuse", "off");  // it would filter nothing at rest
  // The wall's face is turned away from every light. The sheet is out of view.
  slab(flesh(0.0f), 0.05, 0.6);
  for (const NamedLight& light : lights_behind()) lamp(light.light, light.position, light.direction);
  const auto filtered = [&] {
    for (int frame = 0; frame < 4; ++frame) draw();  // counters arrive later
    return counter("shadows.tile_lights_filtered");
  };
  const double without = filtered();
  const Entity sheet = thing(test::quad(0.05f, scene.material(flesh(0.004f, true))), at(0.0, 0.0, 5.0));
  EXPECT_EQ(filtered(), without);
  world.destroy(sheet);
  things.pop_back();
  slab(flesh(0.1f), 0.051, 0.3);  // before the wall's middle
  EXPECT_GT(filtered(), without);
}

TEST_F(ShadowTransmission, without_lit_sides_in_the_map_bodies_are_as_sheets) {
  const Material material = flesh(0.005f);
  slab(material, 0.03);
  for (const NamedLight& light : lights_behind()) {
    shine(light);
    for (const char* mode : {"monolithic", "deferred"}) {
      set("shadows.mode", mode);
      const auto worst = [&](double share) {
        return deviation(drawn(), material, dvec3(0.0), dvec3(0.0, 0.0, 1.0), 0.2,
                         [&](const dvec3&, const test::OracleArrival&) { return share; })
            .worst;
      };
      set("shadows.subsurface", "back_faces");
      EXPECT_LE(worst(kFullShare), 0.01) << light.name << ", " << mode;
      set("shadows.subsurface", "larger_bias");
      EXPECT_LE(worst(0.0), 0.01) << light.name << ", " << mode;
    }
  }
}

TEST_F(ShadowTransmission, closeup_subjects_let_light_through_by_their_thickness) {
  constexpr double kThickness = 0.01;
  const Material material = flesh(0.01f);
  const Entity body = slab(material, kThickness, 0.25);
  thing(test::quad(2.0f, stone), at(0.0, 0.0, 1.5) * glm::rotate(dmat4(1.0), 3.14159, dvec3(0.0, 1.0, 0.0)));
  world.add(body, CloseupSubject{true});
  set("shadows.mode", "deferred");
  for (const NamedLight& light : lights_behind()) {
    shine(light);
    for (int frame = 0; frame < 3; ++frame) draw();
    const Deviation off = deviation(drawn(), material, dvec3(0.0), dvec3(0.0, 0.0, 1.0), 0.15,
                                    [&](const dvec3&, const test::OracleArrival& arrival) {
                                      return std::exp(kThickness / arrival.to_light.z / 0.01);
                                    });
    std::printf("%-10s worst %.4f mean %.4f, pairs %.0f\n", light.name, off.worst, off.mean, counter("closeups.pairs"));
    EXPECT_LE(off.worst, 0.015) << light.name;
  }
}

}  // namespace
}  // namespace gloam
