// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <numbers>
#include <string>

#include "tests/modules/shadows/rig.h"
#include "tests/modules/shadows/support/traced_disc.h"

// Wide penumbrae of several blockers in the corners of a room, where the kernel of one wall's receiver holds texels of
// the next wall. Judged against rays to the emitter's disc.

namespace gloam::test {
namespace {

using shaders::ShadowProbe;

constexpr std::uint32_t kRoomFace = 256;
constexpr int kRoomReceivers = 1500;
constexpr std::uint32_t kPcssFilter = 2, kChsFilter = 3;

/// A lamp in a ring of vertical rods, in a room with flat walls.
struct CagedLamp {
  std::string name;
  int rods = 16;
  double ring_m = 1.2;      ///< radius of the ring
  double rod_m = 0.12;      ///< width of a rod
  double emitter_m = 0.35;  ///< width of the lamp
  double wall_m = 3.0;      ///< distance from the lamp to the walls
  bool spot = false;        ///< shines along −X, with a cone of 100°; otherwise a point light
  double turn = 0.0;        ///< of the room about a slanted axis, so that edges of cube faces cross other parts of it

  [[nodiscard]] dvec3 room() const { return {wall_m, 0.6 * wall_m, wall_m}; }
  /// From the room's axes to the world's.
  [[nodiscard]] glm::dmat3 axes() const {
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), turn, normalize(dvec3(0.3, 1.0, 0.2))));
  }
  [[nodiscard]] RayScene scene() const {
    std::vector<RayScene> parts;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        dvec3 normal(0.0);
        normal[axis] = sign;
        parts.push_back(plane(room() * normal, normal));
      }
    for (int i = 0; i < rods; ++i) {
      const double angle = 2.0 * std::numbers::pi / rods * (i + 0.3);
      const dvec3 outward(std::cos(angle), 0.0, std::sin(angle)), along(-outward.z, 0.0, outward.x);
      parts.push_back(plane(ring_m * outward, outward, [=, this](const dvec3& p) {
        return std::abs(dot(p, along)) < 0.5 * rod_m && std::abs(p.y) < 0.3 * wall_m && dot(p, outward) > 0.0;
      }));
    }
    return [room = nearest_of(parts), to_room = transpose(axes())](const dvec3& from, const dvec3& along) {
      return room(to_room * from, to_room * along);
    };
  }
};

/// The error of one filter: in all receivers, and by their place in the cube face (tangent below or above 0.8).
struct FilterError {
  double mean = 0.0;
  double far_off = 0.0;  ///< share of the receivers with an error over 0.3
  double middle = 0.0;
  double edge = 0.0;
};

class ShadowCorners : public ShadowKernelTest {
 protected:
  struct Receivers {
    std::vector<ShadowProbe> probes;
    std::vector<double> expected;
    std::vector<bool> at_edge;  ///< near an edge of a cube face
  };

  static Receivers receivers(const CagedLamp& lamp, const RayScene& scene) {
    Receivers r;
    const dvec3 room = lamp.room();
    for (int i = 0; i < kRoomReceivers; ++i) {
      const double y = 1.0 - (2.0 * i + 1.0) / kRoomReceivers, radius = std::sqrt(1.0 - y * y);
      const dvec3 toward(radius * std::cos(i * kGoldenAngle), y, radius * std::sin(i * kGoldenAngle));
      if (lamp.spot && std::max(std::abs(toward.y), std::abs(toward.z)) > -0.9 * toward.x) continue;
      const dvec3 t = room / abs(toward);
      const int axis = t.x < t.y && t.x < t.z ? 0 : t.y < t.z ? 1 : 2;
      dvec3 at = toward * t[axis], normal(0.0);
      at[axis] = std::copysign(room[axis], at[axis]);
      normal[axis] = at[axis] > 0.0 ? -1.0 : 1.0;
      at = dvec3(vec3(lamp.axes() * at));
      normal = lamp.axes() * normal;
      r.probes.push_back({.position = vec3(at), .light = 0, .face_normal = vec3(normal)});
      r.expected.push_back(traced_disc(scene, at + 1e-6 * lamp.wall_m * normal, dvec3(0.0),
                                       lamp.spot ? dvec3(-1.0, 0.0, 0.0) : normalize(at), lamp.emitter_m));
      dvec3 in_cube = abs(at * cube_axes());
      const double longest = std::max({in_cube.x, in_cube.y, in_cube.z});
      const double least = std::min({in_cube.x, in_cube.y, in_cube.z});
      r.at_edge.push_back(in_cube.x + in_cube.y + in_cube.z - longest - least > 0.8 * longest);
    }
    return r;
  }

  /// Draws the lamp's maps.
  static shaders::ShadowRow draw(ShadowMaps& maps, const CagedLamp& lamp, const RayScene& scene) {
    const int faces = lamp.spot ? 1 : 6;
    const double tan_half = lamp.spot ? std::tan(50.0 / 180.0 * std::numbers::pi) * 1.05 : 1.0 + 8.0 / kRoomFace;
    shaders::ShadowRow row;
    for (int face = 0; face < faces; ++face) {
      FacePose pose = cube_face(face, dvec3(0.0), tan_half);
      if (lamp.spot) {
        pose.forward = dvec3(-1.0, 0.0, 0.0);
        pose.up = dvec3(0.0, 1.0, 0.0);
        pose.right = cross(pose.forward, pose.up);
      }
      pose.near_m = 0.01 * lamp.wall_m;
      const uvec2 origin(static_cast<std::uint32_t>(face) % 4 * kRoomFace,
                         static_cast<std::uint32_t>(face) / 4 * kRoomFace);
      maps.add_face(draw_face(pose, kRoomFace, scene), origin, kRoomFace, false, GLOAM_SHADOW_MIPS_COVERAGE,
                    static_cast<float>(6.0 * tan_half / kRoomFace));
      // A cube's faces meet at tangents of 1. Beyond tan_inner a receiver counts as lit.
      const double tan_inner = lamp.spot ? tan_half / 1.05 : 1.0;
      if (face == 0) row = spot_row(pose, tan_inner, lamp.emitter_m, origin, kRoomFace);
      row.origins[face] = vec2(origin);
    }
    if (!lamp.spot) row.kind = GLOAM_SHADOW_CUBE;
    return row;
  }

  static FilterError error_of(ShadowMaps& maps, const shaders::ShadowRow& row, const Receivers& r,
                              const ProbeSettings& settings) {
    const auto results = maps.probe(r.probes, {row}, shadow_block(maps), settings);
    FilterError error;
    double edges = 0.0;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const double difference = std::abs(results[i].visibility - r.expected[i]);
      error.mean += difference;
      error.far_off += difference > 0.3 ? 1.0 : 0.0;
      (r.at_edge[i] ? error.edge : error.middle) += difference;
      edges += r.at_edge[i] ? 1.0 : 0.0;
    }
    const auto count = static_cast<double>(results.size());
    return {error.mean / count, error.far_off / count, error.middle / std::max(count - edges, 1.0),
            error.edge / std::max(edges, 1.0)};
  }

  struct Judged {
    FilterError chs, wide, pcss;  ///< the standard filter, contact hardening with 12 texels, single fetches
  };

  static Judged judge(const CagedLamp& lamp) {
    const RayScene scene = lamp.scene();
    ShadowMaps maps(device(), 1024);
    const shaders::ShadowRow row = draw(maps, lamp, scene);
    const Receivers r = receivers(lamp, scene);
    const Judged j{error_of(maps, row, r, {.filter = kChsFilter, .coverage = 1, .standard = true}),
                   error_of(maps, row, r, {.filter = kChsFilter, .kernel = 12, .coverage = 1}),
                   error_of(maps, row, r, {.filter = kPcssFilter, .coverage = 1})};
    std::printf("%-40s", lamp.name.c_str());
    for (const FilterError& e : {j.chs, j.wide, j.pcss})
      std::printf(" %.4f (over 0.3: %.4f, middle %.4f, edge %.4f)", e.mean, e.far_off, e.middle, e.edge);
    std::printf("\n");
    return j;
  }

  /// Contact hardening is as exact as the specification asks (a mean error of 0.02), and no worse than single fetches.
  static void expect_close_to_rays(const CagedLamp& lamp) {
    SCOPED_TRACE(lamp.name);
    const Judged j = judge(lamp);
    for (const FilterError& e : {j.chs, j.wide}) {
      EXPECT_LE(e.mean, 0.02);
      EXPECT_LE(e.far_off, 0.01);
      EXPECT_LE(e.mean, j.pcss.mean);
      EXPECT_LE(e.far_off, j.pcss.far_off);
    }
  }
};

TEST_F(ShadowCorners, of_a_room_are_as_rays_say_for_point_lights) {
  expect_close_to_rays({.name = "sixteen rods"});
  expect_close_to_rays({.name = "seven wide rods", .rods = 7, .rod_m = 0.3});
  expect_close_to_rays({.name = "forty thin rods", .rods = 40, .rod_m = 0.04});
  expect_close_to_rays({.name = "a small lamp", .emitter_m = 0.1});
  expect_close_to_rays({.name = "a lamp and rods of millimetres",
                        .rods = 12,
                        .ring_m = 0.0012,
                        .rod_m = 0.0002,
                        .emitter_m = 0.0003,
                        .wall_m = 0.004});
}

// Near the edges a face stretches the emitter's outline along the radius, and a round kernel only has the same area.
// Some points of the room are harder than others wherever they lie in a face, so the edges of one turn say nothing.
TEST_F(ShadowCorners, are_nearly_as_exact_at_the_edges_of_cube_faces) {
  for (const int rods : {16, 40}) {
    FilterError chs, wide, pcss;
    for (const double turn : {0.15, 0.5, 0.85, 1.2}) {
      const Judged j = judge({.name = "turned", .rods = rods, .rod_m = 2.0 / rods, .turn = turn});
      chs.edge += j.chs.edge;
      chs.middle += j.chs.middle;
      wide.edge += j.wide.edge;
      pcss.edge += j.pcss.edge;
    }
    EXPECT_LE(chs.edge, pcss.edge) << rods;
    EXPECT_LE(chs.edge, 1.3 * chs.middle) << rods;
    EXPECT_LE(wide.edge, pcss.edge) << rods;
  }
}

TEST_F(ShadowCorners, of_a_room_are_as_rays_say_for_spots) {
  expect_close_to_rays({.name = "a spot, sixteen rods", .spot = true});
  expect_close_to_rays({.name = "a spot, nine wide rods", .rods = 9, .ring_m = 1.5, .rod_m = 0.4, .spot = true});
}

}  // namespace
}  // namespace gloam::test
