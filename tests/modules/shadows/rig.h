// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "tests/modules/shadows/support/maps.h"
#include "tests/support/kernel.h"

namespace gloam::test {

/// A suite of kernel tests that share the pipelines of ShadowMaps::probe().
class ShadowKernelTest : public KernelTest {
 protected:
  static void TearDownTestSuite() {
    forget_probe_pipelines();
    KernelTest::TearDownTestSuite();
  }
};

/// One spot light with one face, and probes of it.
struct SpotRig {
  FacePose pose{.origin = dvec3(0.0, 4.0, 0.0),
                .right = dvec3(1.0, 0.0, 0.0),
                .up = dvec3(0.0, 0.0, -1.0),
                .forward = dvec3(0.0, -1.0, 0.0),
                .tan_half = 0.5};
  double tan_inner = 0.45;
  double width_m = 0.0;
  std::uint32_t size = 256;
  float bias_m = 0.002f;
  bool d16 = false;
  bool average = false;

  /// Tangent per texel.
  [[nodiscard]] double texel() const { return 2.0 * pose.tan_half / size; }
  /// Width of an emitter whose penumbra is `texels` texels of mip 0 wide.
  [[nodiscard]] double width_for(double texels, double receiver_z, double blocker_z) const {
    return texels * texel() * receiver_z * blocker_z / (receiver_z - blocker_z);
  }
  [[nodiscard]] shaders::ShadowProbe at(dvec3 point, dvec3 normal = dvec3(0.0, 1.0, 0.0),
                                        std::uint32_t light = 0) const {
    return {.position = vec3(point), .light = light, .face_normal = vec3(normal), .light_vector = vec3(pose.origin)};
  }
  /// Evaluates the probes with a face of these depths.
  [[nodiscard]] std::vector<shaders::ShadowProbeResult> look(gpu::Device& device, const std::vector<float>& depths,
                                                             const std::vector<shaders::ShadowProbe>& probes,
                                                             const ProbeSettings& settings = {}) const {
    ShadowMaps maps(device, size, d16 ? gpu::Format::r16_unorm : gpu::Format::r32_float);
    const std::uint32_t standard = average ? GLOAM_SHADOW_MIPS_AVERAGE : GLOAM_SHADOW_MIPS_NEAREST;
    maps.add_face(depths, uvec2(0), size, false, settings.coverage != 0 ? GLOAM_SHADOW_MIPS_COVERAGE : standard,
                  static_cast<float>(3.0 * texel()));
    return maps.probe(probes, {spot_row(pose, tan_inner, width_m, uvec2(0), size)}, shadow_block(maps, bias_m, d16),
                      settings);
  }
};

/// Settings for every filter, kernel shape and use of mips, with several kernel sizes; fewer sizes at vector widths
/// other than 256. Each setting is a pipeline to compile.
[[nodiscard]] inline std::vector<ProbeSettings> every_filter() {
  const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  const bool usual = width == nullptr || std::string_view(width) == "256";
  std::vector<ProbeSettings> all;
  all.push_back({.filter = 0});
  for (const std::uint32_t kernel : usual ? std::vector<std::uint32_t>{4, 8, 16} : std::vector<std::uint32_t>{8, 12}) {
    for (const std::uint32_t filter : {1u, 2u, 3u}) all.push_back({.filter = filter, .kernel = kernel});
    all.push_back({.filter = 3, .kernel = kernel, .mips = 0});
    all.push_back({.filter = 3, .kernel = kernel, .shape = 1});
  }
  return all;
}

[[nodiscard]] inline std::string name_of(const ProbeSettings& s) {
  return "filter " + std::to_string(s.filter) + " kernel " + std::to_string(s.kernel) + " mips " +
         std::to_string(s.mips) + " shape " + std::to_string(s.shape);
}

inline constexpr dvec3 kUp = dvec3(0.0, 1.0, 0.0);

inline RayScene floor_plane() { return plane(dvec3(0.0), kUp); }

/// A rig at `height` above the origin of the floor. Its face looks down, tilted by `tilt` radians toward −Z.
inline SpotRig tilted(double height, double tilt, double tan_half) {
  SpotRig rig;
  rig.pose.origin = dvec3(0.0, height, 0.0);
  rig.pose.forward = dvec3(0.0, -std::cos(tilt), -std::sin(tilt));
  rig.pose.up = dvec3(0.0, std::sin(tilt), -std::cos(tilt));
  rig.pose.tan_half = tan_half;
  rig.tan_inner = tan_half * 0.9;
  return rig;
}

/// Depths of a face that sees a floor at distance 4, and blockers at distance 2 in the texels where blocks(x, y) is
/// true.
template <class Blocks>
std::vector<float> over_floor(std::uint32_t size, Blocks&& blocks) {
  std::vector<float> depths;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) depths.push_back(blocks(x, y) ? 0.05f / 2.0f : 0.05f / 4.0f);
  return depths;
}

/// The point of the floor at a texel coordinate of mip 0.
inline dvec3 floor_at(const SpotRig& rig, double x, double y) {
  const double half = 0.5 * rig.size;
  return dvec3((x - half) * rig.texel() * 4.0, 0.0, (y - half) * rig.texel() * 4.0);
}

}  // namespace gloam::test
