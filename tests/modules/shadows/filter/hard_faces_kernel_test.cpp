// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/rig.h"
#include "tests/modules/shadows/support/disc_light.h"

namespace gloam::test {
namespace {

using shaders::ShadowProbe;

class ShadowHardFaces : public ShadowKernelTest {};

TEST_F(ShadowHardFaces, kernels_at_the_border_of_a_spots_face_see_only_that_face) {
  SpotRig rig;
  rig.size = 256;
  rig.width_m = 0.5;
  std::vector<ShadowProbe> probes;
  for (int i = 0; i < 256; ++i) {
    const double along = (i / 64 == 0 || i / 64 == 1) ? -1.0 : 1.0;
    const double t = (i % 64 - 31.5) / 32.0;
    const glm::dvec2 ends(along * 1.79, t * 1.79);
    probes.push_back(rig.at((i / 64) % 2 == 0 ? dvec3(ends.x, 0.0, ends.y) : dvec3(ends.y, 0.0, ends.x)));
  }
  const auto closed = draw_face(rig.pose, rig.size, plane(dvec3(0.0, 1.0, 0.0), kUp));
  const auto open = draw_face(rig.pose, rig.size, floor_plane());
  for (const bool blocked : {false, true}) {
    ShadowMaps maps(device(), 1024);
    const std::vector<float> other = blocked ? open : closed;  // neighbours in the atlas, with the opposite result
    for (std::uint32_t i = 0; i < 16; ++i)
      maps.add_face(i == 5 ? (blocked ? closed : open) : other, uvec2(i % 4 * 256, i / 4 * 256), 256);
    const std::vector<shaders::ShadowRow> rows = {spot_row(rig.pose, rig.tan_inner, rig.width_m, uvec2(256, 256), 256)};
    for (ProbeSettings settings : every_filter())
      for (settings.full_penumbra = 0; settings.full_penumbra < 2; ++settings.full_penumbra)
        for (const auto& result : maps.probe(probes, rows, shadow_block(maps), settings))
          ASSERT_NEAR(result.visibility, blocked ? 0.0f : 1.0f, 1e-4f) << name_of(settings);
  }
}

// Hard case: shadows.node_mirrored
TEST_F(ShadowHardFaces, a_mirrored_spot_casts_the_same_shadow) {
  SpotRig rig = tilted(3.0, 0.4, 0.5);
  rig.width_m = 0.1;
  const RayScene scene =
      nearest_of({plane(dvec3(0.0, 1.0, 0.0), kUp, [](const dvec3& p) { return p.x < 0.1; }), floor_plane()});
  std::vector<ShadowProbe> probes;
  for (int i = 0; i < 200; ++i) probes.push_back(rig.at(dvec3(i * 0.01 - 1.0, 0.0, -1.2)));
  const auto plain = rig.look(device(), draw_face(rig.pose, rig.size, scene), probes);
  rig.pose.right = -rig.pose.right;
  const auto mirrored = rig.look(device(), draw_face(rig.pose, rig.size, scene), probes);
  for (std::size_t i = 0; i < probes.size(); ++i) EXPECT_NEAR(plain[i].visibility, mirrored[i].visibility, 5e-3f) << i;
  EXPECT_EQ(plain.front().visibility, 0.0f);
  EXPECT_EQ(plain.back().visibility, 1.0f);
}

/// A cube and one wide spot face at the same position, with texels of the same size.
struct CubeScene {
  static constexpr std::uint32_t kCube = 128, kWide = 1024;
  static constexpr double kCubeTan = 1.125;
  static constexpr double kWideTan = kCubeTan * kWide / kCube;

  static void add(ShadowMaps& maps, const RayScene& scene) {
    for (int face = 0; face < 6; ++face)
      maps.add_face(draw_face(cube_face(face, dvec3(0.0), kCubeTan), kCube, scene), origin(face), kCube);
    maps.add_face(draw_face(cube_face(0, dvec3(0.0), kWideTan), kWide, scene), uvec2(0), kWide);
  }
  static uvec2 origin(int face) {
    return {1024 + static_cast<std::uint32_t>(face) % 4 * kCube, static_cast<std::uint32_t>(face) / 4 * kCube};
  }
  static shaders::ShadowRow cube_row(double width) {
    shaders::ShadowRow row = spot_row(cube_face(0, dvec3(0.0), kCubeTan), 1.0, width, uvec2(0), kCube);
    row.kind = GLOAM_SHADOW_CUBE;
    for (int face = 0; face < 6; ++face) row.origins[face] = vec2(origin(face));
    return row;
  }
};

// A kernel that leaves its cube face gives the result of one large face: in face +X, at its border with −Z, and at its
// corner with +Y and −Z, in the cube's axes.
// Hard case: shadows.penumbra_2_faces, shadows.penumbra_3_faces
TEST_F(ShadowHardFaces, penumbrae_across_two_and_three_faces_of_a_cube_are_those_of_one_large_face) {
  const glm::dmat3 cube = cube_axes();
  const dvec3 blocker_normal = cube * normalize(dvec3(1.0, 0.2, -0.3));
  const RayScene blocker = plane(blocker_normal * 1.5, blocker_normal,
                                 [&](const dvec3& p) { return dot(p, cube[1]) + 0.3 * dot(p, cube[2]) < 0.35; });
  const RayScene wall = plane(4.0 * cube[0], -cube[0]);
  ShadowMaps maps(device(), 2048);
  CubeScene::add(maps, nearest_of({blocker, wall}));
  std::vector<ShadowProbe> probes;
  std::vector<shaders::ShadowRow> rows;
  constexpr double kWidth = 0.4;  // no blocker is near: see near_blockers.glsl
  int across = 0;
  for (int i = 0; i < 500; ++i) {
    const dvec3 at = cube * dvec3(4.0, 4.0 * 0.98 * (i % 25 - 12) / 12.0, -4.0 * (0.55 + 0.43 * (i / 25) / 19.0));
    const double stretch = std::sqrt(length(at) / 4.0);
    rows.push_back(CubeScene::cube_row(kWidth));
    probes.push_back(
        {.position = vec3(at), .light = static_cast<std::uint32_t>(rows.size() - 1), .face_normal = vec3(-cube[0])});
    rows.push_back(spot_row(cube_face(0, dvec3(0.0), CubeScene::kWideTan), CubeScene::kWideTan * 0.99, kWidth * stretch,
                            uvec2(0), CubeScene::kWide));
    probes.push_back(probes.back());
    probes.back().light = static_cast<std::uint32_t>(rows.size() - 1);
  }
  for (const ProbeSettings settings :
       {ProbeSettings{}, ProbeSettings{.shape = 1}, ProbeSettings{.kernel = 12}, ProbeSettings{.filter = 1}}) {
    const auto results = maps.probe(probes, rows, shadow_block(maps), settings);
    double difference = 0.0;
    for (std::size_t i = 0; i < results.size(); i += 2) {
      EXPECT_NEAR(results[i].visibility, results[i + 1].visibility, 0.12) << name_of(settings) << " probe " << i / 2;
      difference += std::abs(results[i].visibility - results[i + 1].visibility) / 500.0;
      across += results[i + 1].visibility > 0.05f && results[i + 1].visibility < 0.95f;
    }
    EXPECT_LT(difference, 0.015) << name_of(settings);
  }
  EXPECT_GT(across, 200);  // points in the penumbra
}

TEST_F(ShadowHardFaces, a_cubes_faces_look_where_they_should) {
  // A small plate in each direction: its shadow must be where rays hit it.
  std::vector<RayScene> plates;
  for (int face = 0; face < 6; ++face) {
    const FacePose pose = cube_face(face, dvec3(0.0), 1.0);
    const dvec3 middle = pose.forward * 2.0 + pose.right * 0.5 + pose.up * 0.9;
    plates.push_back(plane(middle, pose.forward, [=](const dvec3& p) { return length(p - middle) < 0.3; }));
  }
  const RayScene scene = nearest_of(plates);
  ShadowMaps maps(device(), 2048);
  CubeScene::add(maps, scene);
  std::vector<ShadowProbe> probes;
  std::vector<bool> dark;
  for (int face = 0; face < 6; ++face) {
    const FacePose pose = cube_face(face, dvec3(0.0), 1.0);
    for (int i = 0; i < 144; ++i) {
      const dvec3 ray = pose.forward + pose.right * ((i % 12 - 5.5) / 6.0) + pose.up * ((i / 12 - 5.5) / 6.0);
      probes.push_back({.position = vec3(ray * 4.0), .light = 0, .face_normal = vec3(-pose.forward)});
      dark.push_back(scene(dvec3(0.0), ray) > 0.0);
    }
  }
  const auto results = maps.probe(probes, {CubeScene::cube_row(0.0)}, shadow_block(maps), {.filter = 0});
  int wrong = 0;
  for (std::size_t i = 0; i < probes.size(); ++i) wrong += (results[i].visibility < 0.5f) != dark[i];
  EXPECT_LE(wrong, 6);  // rays within a texel of an edge
}

TEST_F(ShadowHardFaces, the_suns_penumbra_is_as_wide_as_its_disc_makes_it) {
  constexpr std::uint32_t kSize = 512;
  const dvec3 shines = normalize(dvec3(0.3, -1.0, 0.2));
  FacePose pose{.tan_half = 0.0, .near_m = 0.0, .half_extent_m = 8.0, .depth_m = 40.0};
  pose.forward = shines;
  pose.right = normalize(cross(shines, dvec3(0.0, 0.0, 1.0)));
  pose.up = cross(pose.right, shines);
  pose.origin = shines * -20.0;
  for (const double gap : {1.0, 3.0, 9.0}) {
    const double penumbra_m_per_m = 0.1;
    const dvec3 middle = shines * -gap;
    const RayScene blocker = plane(middle, shines, [=](const dvec3& p) { return dot(p - middle, pose.right) < 0.0; });
    ShadowMaps maps(device(), kSize);
    maps.add_face(draw_face(pose, kSize, nearest_of({blocker, plane(dvec3(0.0), shines)})), uvec2(0), kSize, true);
    shaders::ShadowBlock block = shadow_block(maps);
    shaders::DirectionalShadow& sun = block.directional[0];
    sun.cascade_count = 1;
    sun.penumbra_m_per_m = static_cast<float>(penumbra_m_per_m);
    shaders::ShadowCascade& cascade = sun.cascades[0];
    const double texel = 16.0 / kSize;
    cascade.row_u = vec4(vec3(pose.right / texel), kSize / 2.0);
    cascade.row_v = vec4(vec3(-pose.up / texel), kSize / 2.0);
    cascade.row_depth = vec4(vec3(-shines / pose.depth_m), 0.5);
    cascade.size = kSize;
    cascade.texel_m = static_cast<float>(texel);
    cascade.depth_m = static_cast<float>(pose.depth_m);
    cascade.rim = 8.0f;
    std::vector<ShadowProbe> probes;
    const double width = gap * penumbra_m_per_m, step = width / 100.0;
    for (int i = -150; i <= 150; ++i)
      probes.push_back({.position = vec3(pose.right * (i * step)),
                        .light = 0,
                        .face_normal = vec3(-shines),
                        .flags = GLOAM_SHADOW_PROBE_DIRECTIONAL,
                        .light_vector = vec3(shines)});
    const auto results = maps.probe(probes, {}, block);
    std::vector<double> at(2, 0.0);
    for (std::size_t i = 0; i + 1 < results.size(); ++i)
      for (const std::size_t end : {0u, 1u}) {
        const float level = end == 0 ? 0.1f : 0.9f;
        if (results[i].visibility < level && results[i + 1].visibility >= level)
          at[end] = static_cast<double>(i) * step;
      }
    const double share = -crossing([](double c) { return disc_beyond(-c); }, 0.1, -1.0, 1.0);
    const double measured = (at[1] - at[0]) / share;
    EXPECT_NEAR(measured, width, width > 8.0 * texel ? 0.1 * width : 2.0 * texel) << "gap " << gap;
    EXPECT_EQ(results.front().visibility, 0.0f);
    EXPECT_EQ(results.back().visibility, 1.0f);
  }
}

}  // namespace
}  // namespace gloam::test
