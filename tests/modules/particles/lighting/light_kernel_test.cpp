// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "engine/math/packing.h"
#include "shaders/particles/shaders.h"
#include "tests/modules/particles/support/light_kernel.h"

namespace gloam::test {
namespace {

/// Light around a probe in a direction ω: kAround + kSlopes[0] ω.x + kSlopes[1] ω.y + kSlopes[2] ω.z.
constexpr dvec3 kAround(0.8, 0.5, 0.3);
constexpr std::array<dvec3, 3> kSlopes = {dvec3(0.3, 0.1, -0.1), dvec3(-0.2, 0.3, 0.1), dvec3(0.1, -0.3, 0.2)};

/// Emitters with random looks and lights, and particles around them.
struct Lit {
  LightKernelScene scene;
  std::vector<TwinLamp> lamps;

  explicit Lit(bool maps) {
    std::mt19937 random(12);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    const auto any = [&] { return vec3(unit(random), unit(random), unit(random)); };
    for (int i = 0; i < 9; ++i) {
      const vec3 at = 4.0f * any(), candela = 10.0f * glm::abs(any());
      lamps.push_back({dvec3(at), dvec3(candela), 12.0});
      scene.add_lamp(at, candela, 12.0f);
    }
    for (std::uint32_t i = 0; i < 6; ++i) {
      shaders::ParticleEmitterRow row{};
      row.origin = 2.0f * any();
      row.albedo = glm::abs(any());
      row.forward = 0.9f * std::abs(unit(random));
      row.light_count = i % 5;
      for (int l = 0; l < 4; ++l) {
        row.lights[l] = static_cast<std::uint32_t>(random() % 9);
        row.light_weights[l] = std::abs(unit(random));
        row.light_channels[l] = static_cast<std::uint32_t>(random() % 5);
      }
      row.map_slice = maps && i % 2 == 0 ? 0.0f : -1.0f;
      row.map_light_scale = i % 4 == 0 ? 1.0f : 2.0f;
      row.map_from = row.origin - 2.0f;
      row.map_size = vec3(scene.kMapSide);
      row.map_scale = vec3(scene.kMapSide / 4.0f);
      scene.emitters.push_back(row);
    }
    for (std::uint32_t i = 0; i < 300; ++i) {
      shaders::Particle p{};
      p.look = i % 6;
      p.position = scene.emitters[p.look].origin + any();
      p.radius_m = 0.2f * std::abs(unit(random));
      p.outward = static_cast<std::uint32_t>(random()) & 0x3FFFFFFFu;
      scene.particles.push_back(p);
      scene.order.push_back((i * 77) % 300);
    }
  }
  /// The light at a corner of the sprite that is drawn as number i.
  [[nodiscard]] dvec3 expected(std::uint32_t i, double x, double y) const {
    const shaders::Particle& p = scene.particles[scene.order[i]];
    const shaders::ParticleEmitterRow& e = scene.emitters[p.look];
    const shaders::ParticleFrame frame = scene.frame();
    const dvec3 at =
        dvec3(p.position) + static_cast<double>(p.radius_m) * (x * dvec3(frame.right) + y * dvec3(frame.up));
    const dvec3 n = twin_outward(e, frame, p, x, y), albedo(e.albedo);
    const dvec3 sky =
        albedo * glm::mix(dvec3(scene.kGround), 0.5 * (dvec3(scene.kHorizon) + dvec3(scene.kZenith)), 0.5 + 0.5 * n.y);
    const dvec3 around =
        scene.probe ? albedo * (kAround + (kSlopes[0] * n.x + kSlopes[1] * n.y + kSlopes[2] * n.z) / 3.0) : sky;
    dvec3 sum = around;
    dvec4 visibility(1.0);
    if (e.map_slice >= 0.0f) {
      const dvec3 texel =
          glm::clamp((at - dvec3(e.map_from)) * dvec3(e.map_scale), dvec3(0.5), dvec3(e.map_size) - 0.5);
      for (int c = 0; c < 3; ++c) {
        const double baked = static_cast<double>(e.map_light_scale) * albedo[c] *
                             std::max(glm::dot(scene.flux_at(texel, c), dvec4(n, 1.0)), 0.0) / (4.0 * kTwinPi);
        sum[c] = std::max(baked + around[c] - sky[c], 0.0);  // maps hold the light of the sky
      }
      visibility = scene.visibility_at(texel);
    }
    for (std::uint32_t l = 0; l < e.light_count; ++l) {
      const int at_l = static_cast<int>(l);
      const TwinLamp& lamp = lamps[e.lights[at_l]];
      const std::uint32_t channel = e.light_channels[at_l];
      const double share =
          static_cast<double>(e.light_weights[at_l]) * (channel < 4 ? visibility[static_cast<int>(channel)] : 1.0);
      sum += share * twin_scattered(albedo, n, glm::normalize(lamp.position - at), twin_illuminance(lamp, at));
    }
    return sum;
  }
};

class ParticleLightKernel : public KernelTest {};

TEST_F(ParticleLightKernel, is_the_light_of_the_twin_at_middles_and_corners_with_and_without_maps) {
  for (const bool maps : {false, true}) {
    const Lit lit(maps);
    for (const std::uint32_t points : {1u, 4u}) {
      const std::vector<uvec2> found = lit.scene.run(device(), points, maps);
      for (std::uint32_t i = 0; i < lit.scene.order.size() * points; ++i) {
        const double x = points == 1     ? 0.0
                         : (i & 1u) != 0 ? kTwinCorner
                                         : -kTwinCorner,
                     y = points == 1     ? 0.0
                         : (i & 2u) != 0 ? kTwinCorner
                                         : -kTwinCorner;
        const dvec3 wanted = lit.expected(i / points, x, y);
        const auto half = [](std::uint32_t bits) { return half_to_float(static_cast<std::uint16_t>(bits)); };
        const vec3 light(half(found[i].x), half(found[i].x >> 16), half(found[i].y));
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(static_cast<double>(light[c]), wanted[c], 4e-3 * wanted[c] + 1e-5) << i << ", maps " << maps;
      }
    }
  }
}

TEST_F(ParticleLightKernel, of_a_probe_takes_the_place_of_sky_and_ground) {
  shaders::DiffuseProbe probe{};
  probe.row.global = 1.0f;
  probe.row.fade = 0.2f;
  probe.terms[0] = vec4(vec3(kAround), 0.0f);
  // A cosine lobe over a linear environment has 2/3 of its slope. Terms are those of y, z and x.
  probe.terms[1] = vec4(vec3(kSlopes[1] * (2.0 / 3.0)), 0.0f);
  probe.terms[2] = vec4(vec3(kSlopes[2] * (2.0 / 3.0)), 0.0f);
  probe.terms[3] = vec4(vec3(kSlopes[0] * (2.0 / 3.0)), 0.0f);
  for (const bool maps : {false, true}) {
    Lit lit(maps);
    lit.scene.probe = probe;
    const std::vector<uvec2> found = lit.scene.run(device(), 1, maps);
    for (std::uint32_t i = 0; i < lit.scene.order.size(); ++i) {
      const dvec3 wanted = lit.expected(i, 0.0, 0.0);
      const auto half = [](std::uint32_t bits) { return half_to_float(static_cast<std::uint16_t>(bits)); };
      const vec3 light(half(found[i].x), half(found[i].x >> 16), half(found[i].y));
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<double>(light[c]), wanted[c], 4e-3 * wanted[c] + 1e-5)
            << i << " " << c << ", maps " << maps;
    }
  }
}

}  // namespace
}  // namespace gloam::test
