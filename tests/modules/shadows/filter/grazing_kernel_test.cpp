// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/modules/shadows/rig.h"

namespace gloam::test {
namespace {

using shaders::ShadowProbe;

class ShadowGrazing : public ShadowKernelTest {};

// Light arrives at up to 89.9 degrees. A pole makes the filters use all mips. It hides the same with and without the
// floor in the map, so any further darkening comes from the floor shadowing itself.
// Hard case: shadows.grazing_light, selftest.slope
TEST_F(ShadowGrazing, a_floor_in_grazing_light_never_shadows_itself) {
  for (const double tilt : {1.2, 1.5}) {
    SpotRig rig = tilted(0.02, tilt, 0.8);
    rig.width_m = 0.02;
    const RayScene pole = plane(dvec3(0.0, 0.0, -0.4), dvec3(0.0, 0.0, 1.0),
                                [](const dvec3& p) { return p.x > 0.02 && p.x < 0.08 && p.y > 0.003; });
    const auto with_floor = draw_face(rig.pose, rig.size, nearest_of({floor_plane(), pole}));
    const auto without = draw_face(rig.pose, rig.size, pole);
    const auto only_floor = draw_face(rig.pose, rig.size, floor_plane());
    std::vector<ShadowProbe> probes;
    for (int i = 0; i < 1024; ++i) {
      const double z = -0.5 * std::pow(22.9, (i / 32) / 31.0);  // up to 89.9 degrees
      probes.push_back(rig.at(dvec3((i % 32 - 15.5) / 15.5 * 0.6 * z, 0.0, z)));
    }
    for (const bool average : {false, true}) {
      rig.average = average;
      for (const ProbeSettings& settings : every_filter()) {
        for (const auto& result : rig.look(device(), only_floor, probes, settings))
          ASSERT_GE(result.visibility, 0.999f) << name_of(settings) << " average " << average;
        const auto a = rig.look(device(), with_floor, probes, settings);
        const auto b = rig.look(device(), without, probes, settings);
        // The floor widens the search region, in which small kernels and single fetches are less exact; and it
        // contributes to mean depths.
        const float slack = settings.filter == 2 || settings.kernel == 4 || average ? 0.25f : 0.05f;
        for (std::size_t i = 0; i < probes.size(); ++i)
          ASSERT_GE(a[i].visibility, b[i].visibility - slack)
              << name_of(settings) << " average " << average << " probe " << i;
      }
    }
  }
}

}  // namespace
}  // namespace gloam::test
