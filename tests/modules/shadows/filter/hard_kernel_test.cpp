// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "tests/modules/shadows/rig.h"

namespace gloam::test {
namespace {

using shaders::ShadowProbe;

class ShadowHard : public ShadowKernelTest {};

// Hard case: shadows.sheet_present, shadows.sheet_no_leak
TEST_F(ShadowHard, a_sheet_3_mm_above_a_floor_shadows_it_without_leaks_and_is_lit_itself) {
  for (const double tilt : {0.0, 0.7, 1.1}) {
    SpotRig rig = tilted(2.0, tilt, 0.35);
    rig.size = 512;
    const dvec3 middle = rig.pose.origin + rig.pose.forward * (2.0 / std::cos(tilt));
    const double reach = 0.25 / std::cos(tilt);
    const RayScene sheet = plane(dvec3(0.0, 0.003, 0.0), kUp, [=](const dvec3& p) {
      return std::abs(p.x - middle.x) < reach && std::abs(p.z - middle.z) < reach;
    });
    const auto depths = draw_face(rig.pose, rig.size, nearest_of({sheet, floor_plane()}));
    std::vector<ShadowProbe> below, above, behind;
    for (int i = 0; i < 400; ++i) {
      const dvec3 at =
          dvec3(middle.x + (i % 20 - 9.5) / 10.0 * reach * 0.8, 0.0, middle.z + (i / 20 - 9.5) / 10.0 * reach * 0.8);
      below.push_back(rig.at(at));
      above.push_back(rig.at(at + dvec3(0.0, 0.003, 0.0)));
      behind.push_back(rig.at(at + dvec3(0.0, 0.003, 0.0), -kUp));  // seen from below: the normal of the visible side
    }
    for (const double width : {0.0, 0.1}) {
      rig.width_m = width;
      for (const ProbeSettings& settings : every_filter()) {
        SCOPED_TRACE(name_of(settings) + " tilt " + std::to_string(tilt) + " width " + std::to_string(width));
        for (const auto& result : rig.look(device(), depths, below, settings)) ASSERT_LE(result.visibility, 1e-3f);
        for (const auto& result : rig.look(device(), depths, above, settings)) ASSERT_GE(result.visibility, 0.999f);
        for (const auto& result : rig.look(device(), depths, behind, settings)) ASSERT_LE(result.visibility, 1e-3f);
      }
    }
  }
}

TEST_F(ShadowHard, a_subsurface_sheet_never_shadows_itself) {
  SpotRig rig;
  const auto depths = draw_face(rig.pose, rig.size, floor_plane());
  std::vector<ShadowProbe> probes;
  for (int i = 0; i < 64; ++i) probes.push_back(rig.at(dvec3(i * 0.01 - 0.3, 0.0, 0.1), -kUp));
  for (const auto& result : rig.look(device(), depths, probes)) EXPECT_EQ(result.visibility, 0.0f);
  for (ShadowProbe& probe : probes) probe.flags = GLOAM_SHADOW_PROBE_SUBSURFACE;
  for (const auto& result : rig.look(device(), depths, probes)) EXPECT_EQ(result.visibility, 1.0f);
}

// Hard case: shadows.normal_quantisation
TEST_F(ShadowHard, a_surface_in_line_with_the_light_faces_it_whatever_quantisation_says) {
  SpotRig rig;
  const auto depths = draw_face(rig.pose, rig.size, floor_plane());
  std::vector<ShadowProbe> probes;
  for (const double tilt : {-1e-4, -2e-5, 0.0, 2e-5, 1e-4}) {
    const dvec3 at(0.5, 0.0, 0.3);
    const dvec3 ray = normalize(at - rig.pose.origin);
    const dvec3 side = normalize(cross(ray, kUp));
    probes.push_back(rig.at(at, normalize(cross(side, ray) + ray * tilt)));
  }
  for (const auto& result : rig.look(device(), depths, probes)) EXPECT_EQ(result.visibility, 1.0f);
}

// Hard case: shadows.receiver_at_light, shadows.receiver_before_near_plane
TEST_F(ShadowHard, nothing_is_in_shadow_at_the_light_or_nearer_than_the_near_plane) {
  SpotRig rig;
  const auto depths = draw_face(rig.pose, rig.size, plane(dvec3(0.0, 3.9, 0.0), kUp));
  const std::vector<ShadowProbe> probes = {rig.at(rig.pose.origin), rig.at(rig.pose.origin - dvec3(0.0, 0.03, 0.0)),
                                           rig.at(rig.pose.origin + dvec3(0.0, 1.0, 0.0)),
                                           rig.at(dvec3(30.0, 3.0, 0.0))};
  for (const auto& result : rig.look(device(), depths, probes)) EXPECT_EQ(result.visibility, 1.0f);
}

// Hard case: shadows.blocker_near_emitter
TEST_F(ShadowHard, a_blocker_nearer_than_the_emitter_is_wide_hides_what_it_hides_of_a_disc) {
  SpotRig rig;
  rig.width_m = 1.0;
  rig.pose.tan_half = 1.0;  // the face sees all blockers between the emitter and the point
  rig.tan_inner = 0.9;
  // Blockers 0.5 m below the emitter. From a point 3.5 m below them the emitter covers a disc of this radius there.
  const double disc = 0.5 * rig.width_m * 3.5 / 4.0;
  const auto plate = [](double radius) {
    return plane(dvec3(0.0, 3.5, 0.0), kUp, [=](const dvec3& p) { return p.x * p.x + p.z * p.z < radius * radius; });
  };
  const auto visibility = [&](const RayScene& scene, const ProbeSettings& settings) {
    const auto depths = draw_face(rig.pose, rig.size, nearest_of({scene, floor_plane()}));
    return rig.look(device(), depths, {rig.at(dvec3(0.0))}, settings)[0].visibility;
  };
  // No tolerance reaches 1: a filter that ignores the plate fails at each radius.
  const ProbeSettings fine = {.kernel = 16, .shape = 1};
  for (const double radius : {0.2, 0.25, 0.3, 0.35})
    EXPECT_NEAR(visibility(plate(radius), fine), 1.0 - radius * radius / (disc * disc), 0.05) << radius;
  EXPECT_NEAR(visibility(plate(0.25), {}), 1.0 - 0.0625 / (disc * disc), 0.15);
  const RayScene hole = plane(dvec3(0.0, 3.5, 0.0), kUp, [](const dvec3& p) { return p.x * p.x + p.z * p.z > 0.36; });
  const RayScene closed = plane(dvec3(0.0, 3.5, 0.0), kUp);
  for (const ProbeSettings& settings : {ProbeSettings{}, fine}) {
    EXPECT_NEAR(visibility(hole, settings), 1.0, 0.1) << "the whole disc shows through the hole";
    EXPECT_NEAR(visibility(closed, settings), 0.0, 1e-3);
  }
}

TEST_F(ShadowHard, sixteen_bits_shadow_without_acne_at_ten_metres) {
  SpotRig rig = tilted(10.0, 0.3, 0.5);
  rig.d16 = true;
  rig.width_m = 0.2;
  const RayScene plate = plane(dvec3(0.0, 1.0, 0.0), kUp, [](const dvec3& p) { return p.x < 0.0; });
  const auto depths = draw_face(rig.pose, rig.size, nearest_of({plate, floor_plane()}));
  std::vector<ShadowProbe> lit, dark;
  for (int i = 0; i < 256; ++i) {
    const double z = -3.0 - 2.0 * (i / 16) / 15.0 + 1.0, x = 0.5 + 2.0 * (i % 16) / 15.0;
    lit.push_back(rig.at(dvec3(x, 0.0, z)));
    dark.push_back(rig.at(dvec3(-x, 0.0, z)));
  }
  for (const ProbeSettings& settings : every_filter()) {
    for (const auto& result : rig.look(device(), depths, lit, settings))
      ASSERT_GE(result.visibility, 0.999f) << name_of(settings);
    for (const auto& result : rig.look(device(), depths, dark, settings))
      ASSERT_LE(result.visibility, 1e-3f) << name_of(settings);
  }
}

// Hard case: shadows.all_finite
TEST_F(ShadowHard, bad_numbers_leave_visibility_between_0_and_1) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  SpotRig rig;
  rig.width_m = 0.3;
  const auto depths = draw_face(
      rig.pose, rig.size,
      nearest_of({plane(dvec3(0.0, 1.0, 0.0), kUp, [](const dvec3& p) { return p.x < 0.0; }), floor_plane()}));
  std::vector<ShadowProbe> probes;
  for (const double bad : {nan, infinity, -infinity, 1e30, 1e-30, 0.0}) {
    probes.push_back(rig.at(dvec3(bad, 0.0, 0.0)));
    probes.push_back(rig.at(dvec3(0.1, bad, 0.1)));
    probes.push_back(rig.at(dvec3(0.05, 0.0, 0.1), dvec3(bad)));
    probes.push_back(rig.at(dvec3(0.05, 0.0, 0.1), dvec3(bad, 1.0, 0.0)));
    probes.push_back(probes[2]);
    probes.back().light_vector = vec3(static_cast<float>(bad), 4.0f, 0.0f);
  }
  for (const ProbeSettings& settings : every_filter()) {
    for (const double width : {0.0, 0.3, 1e9}) {
      rig.width_m = width;
      for (const auto& result : rig.look(device(), depths, probes, settings))
        ASSERT_TRUE(result.visibility >= 0.0f && result.visibility <= 1.0f)
            << name_of(settings) << ": " << result.visibility;
    }
  }
}

}  // namespace
}  // namespace gloam::test
