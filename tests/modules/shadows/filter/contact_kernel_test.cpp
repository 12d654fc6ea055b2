// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/modules/shadows/rig.h"

// Receivers at the very depth of what the map holds: where a wall stands on a floor, and where a plate lies on it.

namespace gloam::test {
namespace {

using glm::dvec2;
using shaders::ShadowProbe;

constexpr double kWall = -1.3;  ///< z of the wall
constexpr double kHalf = 0.5;   ///< of its width
constexpr double kHigh = 0.6;

class ShadowContact : public ShadowKernelTest {
 protected:
  /// All filters, the last one without mips and with mips that hold coverage, too. Each is a pipeline to compile.
  static std::vector<ProbeSettings> filters() {
    return {{.filter = 0},
            {.filter = 1},
            {.filter = 2},
            {.filter = 3},
            {.filter = 3, .mips = 0},
            {.filter = 3, .coverage = 1}};
  }
  static std::string name(const ProbeSettings& s) { return name_of(s) + " coverage " + std::to_string(s.coverage); }
  static SpotRig rig() { return tilted(2.0, 0.55, 0.6); }
  static RayScene wall() {
    return plane(dvec3(0.0, 0.0, kWall), dvec3(0.0, 0.0, 1.0),
                 [](const dvec3& p) { return std::abs(p.x) < kHalf && p.y < kHigh; });
  }
  /// Length of a texel at the foot of the wall: on the floor away from the lamp, and up the wall.
  static dvec2 texel_at_foot(const SpotRig& rig) {
    const dvec3 way = dvec3(0.0, 0.0, kWall) - rig.pose.origin;
    const double across = glm::dot(way, rig.pose.forward) * rig.texel() * glm::length(way);
    return {across / rig.pose.origin.y, across / -kWall};
  }
  /// How far a filter reaches over an edge, in texels of mip 0: half of pcf's fixed kernel; or a bilinear step, and the
  /// penumbra of what blocks half a kernel up the wall, where texels are longer than on the floor.
  static double reach(const ProbeSettings& s, const SpotRig& rig) {
    const double half = 0.5 * s.kernel, high = rig.pose.origin.y, far = -kWall;
    return s.filter == 1 ? half : 1.0 + half * (high / far) * rig.width_m / std::hypot(high, far);
  }
  static void expect(const std::vector<shaders::ShadowProbeResult>& results, bool lit, std::size_t first,
                     std::size_t count, float tolerance, const std::string& what) {
    ASSERT_GE(results.size(), first + count);
    for (std::size_t i = first; i < first + count; ++i)
      ASSERT_NEAR(results[i].visibility, lit ? 1.0f : 0.0f, tolerance) << what << ", probe " << i - first;
  }
};

// Rays in double say: before the wall all is lit, behind it all is dark, for lamps of any width here.
TEST_F(ShadowContact, of_a_wall_and_a_floor_is_where_the_wall_stands) {
  SpotRig rig = ShadowContact::rig();
  const auto depths = draw_face(rig.pose, rig.size, nearest_of({floor_plane(), wall()}));
  const dvec2 texel = texel_at_foot(rig);
  constexpr std::size_t kProbes = 96;
  for (const double width : {0.0, 0.04})
    for (const ProbeSettings& settings : filters()) {
      rig.width_m = width;
      std::vector<ShadowProbe> probes;
      for (const int side : {-1, 1})
        for (std::size_t i = 0; i < kProbes; ++i) {
          const double x = (static_cast<double>(i % 16) - 7.5) / 8.0 * 0.8 * kHalf;
          const double texels = reach(settings, rig) + 0.02 + static_cast<double>(i / 16);
          probes.push_back(rig.at(dvec3(x, 0.0, kWall + side * texels * texel.x)));
        }
      // The wall itself from near its foot, seen from the lamp's side and from behind.
      for (const int side : {-1, 1})
        for (std::size_t i = 0; i < kProbes; ++i) {
          const double x = (static_cast<double>(i % 16) - 7.5) / 8.0 * 0.8 * kHalf;
          const double y = (reach(settings, rig) + 0.02) * texel.y + 0.06 * static_cast<double>(i / 16);
          probes.push_back(rig.at(dvec3(x, y, kWall), dvec3(0.0, 0.0, side)));
        }
      const auto results = rig.look(device(), depths, probes, settings);
      const std::string what = name(settings) + " width " + std::to_string(width);
      // The width of a penumbra is estimated from a search region; one of the kernel's 64 texels may be wrong.
      const float tolerance = width > 0.0 ? 1.0f / 64.0f : 1e-3f;
      expect(results, false, 0, kProbes, tolerance, what + ", the floor behind");
      expect(results, true, kProbes, kProbes, tolerance, what + ", the floor before");
      expect(results, false, 2 * kProbes, kProbes, tolerance, what + ", the wall's back");
      expect(results, true, 3 * kProbes, kProbes, tolerance, what + ", the wall's front");
    }
}

// A plate that lies on the floor, or touches it by rounding: the map holds the one, the receiver is the other.
// Hard case: shadows.receiver_is_blocker
TEST_F(ShadowContact, of_a_plate_in_the_plane_of_the_floor_casts_nothing) {
  SpotRig rig = ShadowContact::rig();
  for (const double height : {-1e-6, 0.0, 1e-6}) {
    const RayScene plate =
        plane(dvec3(0.0, height, 0.0), kUp, [](const dvec3& p) { return std::abs(p.x) < kHalf && p.z < -0.9; });
    const auto depths = draw_face(rig.pose, rig.size, nearest_of({plate, floor_plane()}));
    std::vector<ShadowProbe> probes;
    for (int i = 0; i < 1024; ++i) probes.push_back(rig.at(dvec3((i % 32 - 15.5) / 25.0, 0.0, -0.6 - (i / 32) / 40.0)));
    for (const double width : {0.0, 0.1})
      for (const ProbeSettings& settings : filters()) {
        rig.width_m = width;
        expect(rig.look(device(), depths, probes, settings), true, 0, probes.size(), 1e-3f,
               name(settings) + " width " + std::to_string(width) + " height " + std::to_string(height));
      }
  }
}

}  // namespace
}  // namespace gloam::test
