// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/modules/shadows/rig.h"
#include "tests/modules/shadows/support/disc_light.h"

namespace gloam::test {
namespace {

using shaders::ShadowProbe;

/// A spot light that shines down on a floor at y = 0, and a half plane above it whose straight edge casts a shadow.
struct EdgeScene {
  double height_m = 12.0;
  double gap_m = 1.0;  // height of the half plane above the floor
  double width_m = 0.4;
  double tan_half = 0.6;
  std::uint32_t size = 1024;
  double angle = 0.3;   // angle of the edge, radians
  double offset = 0.0;  // distance of the shadow's edge on the floor from the middle, m
  bool average = false;
  [[nodiscard]] double penumbra() const { return gap_m * width_m / (height_m - gap_m); }
  [[nodiscard]] double texel() const { return 2.0 * tan_half / size * height_m; }
};

struct Curve {
  std::vector<double> x;
  std::vector<double> visibility;
  [[nodiscard]] double width() const { return last_below(0.9) - last_below(0.1); }
  // Position at which the curve rises above a level, by interpolation.
  [[nodiscard]] double last_below(double level) const {
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
      if (visibility[i] < level && visibility[i + 1] >= level)
        return x[i] + (x[i + 1] - x[i]) * (level - visibility[i]) / (visibility[i + 1] - visibility[i]);
    return NAN;
  }
};

class ShadowPenumbra : public ShadowKernelTest {
 protected:
  static Curve curve_of(const EdgeScene& s, const ProbeSettings& settings) {
    const FacePose pose{.origin = dvec3(0.0, s.height_m, 0.0),
                        .right = dvec3(1.0, 0.0, 0.0),
                        .up = dvec3(0.0, 0.0, -1.0),
                        .forward = dvec3(0.0, -1.0, 0.0),
                        .tan_half = s.tan_half};
    const dvec3 across(std::cos(s.angle), 0.0, std::sin(s.angle));
    const double edge = s.offset * (1.0 - s.gap_m / s.height_m);
    const RayScene scene = nearest_of(
        {plane(dvec3(0.0, s.gap_m, 0.0), dvec3(0.0, 1.0, 0.0), [=](const dvec3& p) { return dot(p, across) < edge; }),
         plane(dvec3(0.0), dvec3(0.0, 1.0, 0.0))});
    ShadowMaps maps(device(), s.size);
    maps.add_face(draw_face(pose, s.size, scene), uvec2(0), s.size, false, s.average);
    const double reach = std::min(1.2 * s.penumbra() + 12.0 * s.texel(), 0.9 * s.tan_half * s.height_m);
    Curve curve;
    std::vector<ShadowProbe> probes;
    for (int i = 0; i <= 400; ++i) {
      curve.x.push_back(reach * (i / 200.0 - 1.0));
      const dvec3 point = across * (s.offset + curve.x.back());
      probes.push_back({.position = vec3(point),
                        .light = 0,
                        .face_normal = vec3(0.0f, 1.0f, 0.0f),
                        .light_vector = vec3(pose.origin)});
    }
    const auto results =
        maps.probe(probes, {spot_row(pose, s.tan_half, s.width_m, uvec2(0), s.size)}, shadow_block(maps), settings);
    for (const auto& result : results) curve.visibility.push_back(result.visibility);
    return curve;
  }
  /// Mean penumbra width over several positions of the edge between texels. It is measured from visibility 0.1 to 0.9
  /// and divided by the share of the disc between those.
  static double width_of(EdgeScene s, const ProbeSettings& settings = {}) {
    const double share = -crossing([](double c) { return disc_beyond(-c); }, 0.1, -1.0, 1.0);
    double sum = 0.0;
    constexpr int kPlaces = 3;
    for (int i = 0; i < kPlaces; ++i) {
      s.offset = (0.13 + 1.0 * i / kPlaces) * s.texel() * 4.0;
      s.angle = 0.2 * i;
      sum += curve_of(s, settings).width() / share;
    }
    return sum / kPlaces;
  }
};

// Distances of 0.1 to 10 m between blocker and floor, maps of two sizes and two fields of view.
TEST_F(ShadowPenumbra, is_as_wide_as_the_disc_makes_it_whatever_the_map) {
  struct Map {
    std::uint32_t size;
    double tan_half;
  };
  for (const double gap : {0.1, 1.0, 4.0, 10.0}) {
    double narrowest = 1e9, widest = 0.0;
    for (const Map map : {Map{512, 0.3}, Map{512, 0.6}, Map{1024, 0.3}}) {
      const EdgeScene s{.gap_m = gap, .tan_half = map.tan_half, .size = map.size};
      const double width = width_of(s), texels = s.penumbra() / s.texel();
      std::printf("gap %4.1f m, map %4u, tan %.1f: %.4f m (%.1f texels), measured %.4f m\n", gap, map.size,
                  map.tan_half, s.penumbra(), texels, width);
      EXPECT_NEAR(width, s.penumbra(), texels >= 8.0 ? 0.1 * s.penumbra() : 2.0 * s.texel())
          << "gap " << gap << " map " << map.size << " " << map.tan_half;
      if (texels < 8.0) continue;
      narrowest = std::min(narrowest, width);
      widest = std::max(widest, width);
    }
    EXPECT_LE(widest, 1.1 * narrowest + (widest == 0.0 ? 1e10 : 0.0)) << "gap " << gap;
  }
}

// Mips hold the nearest depth of a block, so shadows grow by up to half a texel of the mip that filters them, which is
// an eighth of the penumbra.
// Hard case: selftest.filter, selftest.light_width
TEST_F(ShadowPenumbra, follows_the_disc_within_the_texel_of_its_mip) {
  EdgeScene s;
  s.size = 512;
  s.tan_half = 0.3;
  s.gap_m = 7.0;
  const Curve curve = curve_of(s, {});
  double error = 0.0, before = 0.0;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double exact = half_plane_visibility(curve.x[i], s.height_m, s.gap_m, s.width_m);
    EXPECT_NEAR(curve.visibility[i], exact, 0.2) << curve.x[i] / s.texel() << " texels";
    EXPECT_GE(curve.visibility[i], before - 0.01) << "not monotone at " << curve.x[i] / s.texel() << " texels";
    error += std::abs(curve.visibility[i] - exact) / static_cast<double>(curve.x.size());
    before = curve.visibility[i];
  }
  EXPECT_LT(error, 0.06);
}

// A texel beside an edge whose penumbra is a texel wide, nothing of the edge's texels may count.
TEST_F(ShadowPenumbra, of_a_texel_ends_within_a_texel_of_its_edge) {
  SpotRig rig;
  rig.width_m = rig.width_for(1.0, 4.0, 2.0);
  const auto depths = over_floor(rig.size, [](std::uint32_t x, std::uint32_t) { return x < 128; });
  const auto at = [&](double x) { return rig.at(floor_at(rig, x, 128.5)); };
  const auto seen = rig.look(device(), depths, {at(126.9), at(129.1)});
  EXPECT_NEAR(seen[0].visibility, 0.0f, 0.005f);
  EXPECT_NEAR(seen[1].visibility, 1.0f, 0.005f);
}

}  // namespace
}  // namespace gloam::test
