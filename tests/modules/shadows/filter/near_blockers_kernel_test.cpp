// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/modules/shadows/rig.h"
#include "tests/modules/shadows/support/traced_disc.h"

// Lamps as people build them: what blocks is about as near to the lamp as the lamp is wide. Judged against rays to the
// emitter's disc.

namespace gloam::test {
namespace {

using shaders::ShadowProbe;

constexpr std::uint32_t kFaceSize = 256;
constexpr double kFaceTan = 1.0 + 8.0 / kFaceSize;  // a rim of four texels
constexpr int kReceivers = 600;
constexpr std::uint32_t kWide = 1, kAll = 2;  // shadows.near

class NearBlockers : public ShadowKernelTest {
 protected:
  static uvec2 origin(int face) {
    return {static_cast<std::uint32_t>(face) % 4 * kFaceSize, static_cast<std::uint32_t>(face) / 4 * kFaceSize};
  }
  /// Judges points in all directions, 4 m from the lamp. near: shadows.near.
  void expect_near_rays(const std::string& name, const RayScene& scene, double width_m, double near_m,
                        std::uint32_t near) {
    SCOPED_TRACE(name);
    ShadowMaps maps(device(), 1024);
    FacePose first = cube_face(0, dvec3(0.0), kFaceTan);
    first.near_m = near_m;
    shaders::ShadowRow row = spot_row(first, 1.0, width_m, origin(0), kFaceSize);
    row.kind = GLOAM_SHADOW_CUBE;
    for (int face = 0; face < 6; ++face) {
      FacePose pose = cube_face(face, dvec3(0.0), kFaceTan);
      pose.near_m = near_m;
      maps.add_face(draw_face(pose, kFaceSize, scene), origin(face), kFaceSize);
      row.origins[face] = vec2(origin(face));
    }
    std::vector<ShadowProbe> probes;
    std::vector<double> expected;
    int partly = 0;
    for (int i = 0; i < kReceivers; ++i) {
      const double y = 1.0 - (2.0 * i + 1.0) / kReceivers, r = std::sqrt(1.0 - y * y);
      const dvec3 at = 4.0 * dvec3(r * std::cos(i * kGoldenAngle), y, r * std::sin(i * kGoldenAngle));
      probes.push_back({.position = vec3(at), .light = 0, .face_normal = vec3(normalize(-at))});
      expected.push_back(traced_disc(scene, dvec3(vec3(at)), dvec3(0.0), normalize(at), width_m));
      partly += expected.back() > 0.05 && expected.back() < 0.95 ? 1 : 0;
    }
    for (const bool standard : {false, true}) {
      const auto results = maps.probe(probes, {row}, shadow_block(maps), {.near = near, .standard = standard});
      double sum = 0.0;
      int far_off = 0;
      for (std::size_t i = 0; i < results.size(); ++i) {
        const double difference = std::abs(results[i].visibility - expected[i]);
        sum += difference;
        far_off += difference > 0.1 ? 1 : 0;
      }
      EXPECT_LE(sum / kReceivers, 0.02);
      EXPECT_LE(far_off, kReceivers * 3 / 100);
    }
    EXPECT_GT(partly, 10) << "the scene has penumbrae";
  }
};

RayScene disc(const dvec3& middle, const dvec3& normal, double radius) {
  return plane(middle, normal, [=](const dvec3& p) { return length(p - middle) < radius; });
}

TEST_F(NearBlockers, hide_what_rays_say) {
  const dvec3 up(0, 1, 0);
  expect_near_rays("a hood 6 cm above a lamp of 15 cm", disc(dvec3(0, 0.06, 0), up, 0.25), 0.15, 0.02, kWide);
  expect_near_rays(
      "a pole 20 cm behind it",
      plane(dvec3(0, 0, -0.2), dvec3(0, 0, 1), [](const dvec3& p) { return std::abs(p.x) < 0.04 && p.y < 0.5; }), 0.15,
      0.02, kAll);
  expect_near_rays("a rim 1 cm from a lamp of 3 cm",
                   plane(dvec3(0.01, 0, 0), dvec3(1, 0, 0),
                         [](const dvec3& p) { return p.y > 0.004 && p.y < 0.05 && std::abs(p.z) < 0.05; }),
                   0.03, 0.005, kWide);
}

TEST_F(NearBlockers, of_a_lantern_with_six_bars_hide_what_rays_say) {
  std::vector<RayScene> bars;
  for (int i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi / 3.0 * i;
    const dvec3 outward(std::cos(angle), 0.0, std::sin(angle)), along(-outward.z, 0.0, outward.x);
    bars.push_back(plane(0.12 * outward, outward, [=](const dvec3& p) {
      return std::abs(dot(p, along)) < 0.01 && std::abs(p.y) < 0.15 && dot(p, outward) > 0.0;
    }));
  }
  expect_near_rays("bars 12 cm from a lamp of 8 cm", nearest_of(bars), 0.08, 0.02, kAll);
}

}  // namespace
}  // namespace gloam::test
