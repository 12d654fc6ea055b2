// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/math/packing.h"
#include "tests/render/draws/drawn_scene.h"

// Content of the geometry buffer under a pixel, read with Renderer::pick.

namespace gloam {
namespace {

using test::Picked;

dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }
dmat4 turned(double angle, const dvec3& axis) { return glm::rotate(dmat4(1.0), angle, axis); }
dmat4 scaled_by(const dvec3& scale) { return glm::scale(dmat4(1.0), scale); }

void expect_near(const dvec3& value, const dvec3& expected, double bound) {
  EXPECT_LT(glm::length(value - expected), bound) << value.x << " " << value.y << " " << value.z << " instead of "
                                                  << expected.x << " " << expected.y << " " << expected.z;
}

class Geometry : public test::DrawingTest {
 protected:
  /// Draws a square that fills the picture, 4 m ahead, with texture coordinates 0…1.
  Entity fill_picture(const Material& material, const dmat4& matrix = dmat4(1.0)) {
    const float half = 4.0f * std::tan(0.5f * stage->settings.camera.fov_y);
    return stage->scene.draw(stage->scene.mesh(test::quad(half, stage->scene.material(material))),
                             at(0, 0, -4) * matrix);
  }
};

TEST_F(Geometry, a_quad_has_its_materials_values_and_its_place) {
  Material material;
  material.base_color = vec4(0.5f, 0.25f, 0.75f, 1.0f);
  material.roughness = 0.3f;
  material.metallic = 0.6f;
  stage->scene.draw(stage->scene.mesh(test::quad(1.0f, stage->scene.material(material))), at(0, 0, -5));
  const Picked p = stage->pick_middle();
  ASSERT_FALSE(p.sky);
  EXPECT_NEAR(p.depth_m, 5.0, 1e-4);
  expect_near(p.base_color, dvec3(0.5, 0.25, 0.75), 0.008);  // 8 bits, sRGB
  EXPECT_FALSE(p.subsurface);
  expect_near(p.normal, dvec3(0, 0, 1), 2e-4);
  expect_near(p.face_normal, dvec3(0, 0, 1), 2e-4);
  expect_near(p.roughness_metallic_occlusion, dvec3(0.3, 0.6, 1.0), 0.004);
  EXPECT_TRUE(stage->pick(0, 0).sky);
}

TEST_F(Geometry, subsurface_and_vertex_colours_arrive) {
  Material material;
  material.subsurface = true;
  material.base_color = vec4(0.5f, 1.0f, 1.0f, 1.0f);
  Primitive quad = test::quad(1.0f, stage->scene.material(material));
  quad.colors.assign(4, vec4(0.5f, 0.5f, 0.25f, 1.0f));
  stage->scene.draw(stage->scene.mesh(quad), at(0, 0, -3));
  const Picked p = stage->pick_middle();
  EXPECT_TRUE(p.subsurface);
  expect_near(p.base_color, dvec3(0.25, 0.5, 0.25), 0.008);
}

TEST_F(Geometry, texture_rows_run_from_the_top_left) {
  Material material;
  material.base_color_texture.texture =
      stage->scene.texture(2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}, true);
  fill_picture(material);
  stage->render();
  expect_near(stage->pick(4, 4).base_color, dvec3(1, 0, 0), 1e-3);
  expect_near(stage->pick(28, 4).base_color, dvec3(0, 1, 0), 1e-3);
  expect_near(stage->pick(4, 28).base_color, dvec3(0, 0, 1), 1e-3);
  expect_near(stage->pick(28, 28).base_color, dvec3(1, 1, 1), 1e-3);
}

TEST_F(Geometry, a_texture_transform_and_the_second_set_of_coordinates_count) {
  Material material;
  material.base_color_texture.texture = stage->scene.texture(2, 1, {255, 0, 0, 255, 0, 255, 0, 255}, true);
  material.base_color_texture.uv_set = 1;
  material.base_color_texture.transform_row0 = vec3(0.0f, 1.0f, 0.0f);  // u' = v
  material.base_color_texture.transform_row1 = vec3(1.0f, 0.0f, 0.0f);
  Primitive quad = test::quad(4.0f, stage->scene.material(material));
  quad.uv1 = quad.uv0;
  quad.uv0.assign(4, vec2(0.0f));
  stage->scene.draw(stage->scene.mesh(quad), at(0, 0, -4));
  stage->render();
  expect_near(stage->pick(4, 4).base_color, dvec3(1, 0, 0), 1e-3);
  expect_near(stage->pick(28, 4).base_color, dvec3(1, 0, 0), 1e-3);
  expect_near(stage->pick(16, 28).base_color, dvec3(0, 1, 0), 1e-3);
}

TEST_F(Geometry, metal_roughness_and_occlusion_come_from_their_channels) {
  Material material;
  material.metallic = 0.5f;
  material.roughness = 1.0f;
  material.occlusion_strength = 0.5f;
  material.metallic_roughness_texture.texture = stage->scene.texture(1, 1, {10, 102, 204, 255}, false);
  material.occlusion_texture.texture = stage->scene.texture(1, 1, {51, 255, 255, 255}, false);
  fill_picture(material);
  expect_near(stage->pick_middle().roughness_metallic_occlusion, dvec3(0.4, 0.4, 0.6), 0.006);
}

TEST_F(Geometry, normal_maps_tilt_along_the_tangent_and_mirror_with_their_node) {
  Material material;
  material.normal_texture.texture = stage->scene.texture(1, 1, {204, 128, 229, 255}, false);
  const Entity quad = fill_picture(material);
  const dmat4 pose = stage->world.get<WorldTransform>(quad).matrix;
  const double x = 2.0 * 204 / 255 - 1.0, y = 2.0 * 128 / 255 - 1.0, z = 2.0 * 229 / 255 - 1.0;
  expect_near(stage->pick_middle().normal, glm::normalize(dvec3(x, y, z)), 1e-3);
  stage->world.get<WorldTransform>(quad).matrix = pose * scaled_by(dvec3(-1.0, 1.0, 1.0));
  expect_near(stage->pick_middle().normal, glm::normalize(dvec3(-x, y, z)), 1e-3);
  stage->world.get<WorldTransform>(quad).matrix = pose * turned(1.5707963267948966, dvec3(0, 0, 1));
  expect_near(stage->pick_middle().normal, glm::normalize(dvec3(-y, x, z)), 1e-3);
}

TEST_F(Geometry, mirrored_nodes_keep_their_normals_towards_the_viewer) {
  const std::uint32_t mesh = stage->scene.mesh(test::box(vec3(1.0f, 0.7f, 0.5f)));
  const dmat4 pose = at(0, 0, -5) * turned(0.6, glm::normalize(dvec3(1.0, 2.0, 0.5)));
  const Entity box = stage->scene.draw(mesh, pose);
  stage->render();
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> pixels = {
      {16, 16}, {13, 15}, {19, 17}, {16, 13}, {15, 19}};
  std::vector<Picked> plain;
  for (const auto& [px, py] : pixels) plain.push_back(stage->pick(px, py));
  for (const dvec3& mirror : {dvec3(-1, 1, 1), dvec3(1, -1, 1), dvec3(1, 1, -1), dvec3(-1, -1, -1)}) {
    stage->world.get<WorldTransform>(box).matrix = pose * scaled_by(mirror);
    stage->render();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const Picked p = stage->pick(pixels[i].first, pixels[i].second);
      ASSERT_FALSE(p.sky || plain[i].sky);
      EXPECT_NEAR(p.depth_m, plain[i].depth_m, 1e-4);
      expect_near(p.normal, plain[i].normal, 1e-3);
      expect_near(p.face_normal, plain[i].face_normal, 1e-3);
      expect_near(p.normal, p.face_normal, 2e-3);
      EXPECT_GT(p.face_normal.z, -0.2);
    }
  }
}

TEST_F(Geometry, back_faces_are_drawn_of_two_sided_materials_only) {
  Material closed;
  Material open;
  open.double_sided = true;
  const std::uint32_t closed_mesh = stage->scene.mesh(test::quad(1.0f, stage->scene.material(closed)));
  const std::uint32_t open_mesh = stage->scene.mesh(test::quad(1.0f, stage->scene.material(open)));
  const dmat4 away = at(0, 0, -5) * turned(3.14159265358979, dvec3(0, 1, 0));
  const Entity quad = stage->scene.draw(closed_mesh, away);
  EXPECT_TRUE(stage->pick_middle().sky);
  stage->world.get<WorldTransform>(quad).matrix = away * scaled_by(dvec3(-1, 1, 1));
  EXPECT_TRUE(stage->pick_middle().sky) << "mirrored in its plane it still faces away";
  stage->world.get<WorldTransform>(quad).matrix = away * scaled_by(dvec3(1, 1, -1));
  EXPECT_FALSE(stage->pick_middle().sky) << "mirrored across its plane it faces the camera";
  stage->world.get<MeshInstance>(quad).mesh = open_mesh;
  for (const dvec3& mirror : {dvec3(1, 1, 1), dvec3(-1, 1, 1), dvec3(1, 1, -1)}) {
    stage->world.get<WorldTransform>(quad).matrix = away * scaled_by(mirror);
    const Picked p = stage->pick_middle();
    ASSERT_FALSE(p.sky);
    expect_near(p.normal, dvec3(0, 0, 1), 2e-4);
    expect_near(p.face_normal, dvec3(0, 0, 1), 2e-4);
  }
}

TEST_F(Geometry, cut_outs_leave_what_is_below_the_cutoff) {
  Material material;
  material.alpha_mode = AlphaMode::mask;
  material.alpha_cutoff = 0.5f;
  material.base_color_texture.texture =
      stage->scene.texture(2, 2, {9, 9, 9, 127, 9, 9, 9, 128, 9, 9, 9, 0, 9, 9, 9, 255}, true);
  fill_picture(material);
  stage->render();
  EXPECT_TRUE(stage->pick(4, 4).sky);
  EXPECT_FALSE(stage->pick(28, 4).sky);
  EXPECT_TRUE(stage->pick(4, 28).sky);
  EXPECT_FALSE(stage->pick(28, 28).sky);
  // At the edge of the cut-out, discarded fragments still take part in derivatives, so the face normal is exact.
  for (std::uint32_t y = 2; y < 31; y += 4) expect_near(stage->pick(17, y).face_normal, dvec3(0, 0, 1), 2e-4);
}

TEST_F(Geometry, opaque_materials_ignore_alpha) {
  Material material;
  material.base_color = vec4(1.0f, 1.0f, 1.0f, 0.0f);
  fill_picture(material);
  EXPECT_FALSE(stage->pick_middle().sky);
}

TEST_F(Geometry, the_nearest_surface_is_seen_whatever_is_drawn_first) {
  for (const double first : {-3.0, -6.0}) {
    test::Stage own;
    Material red, green;
    red.base_color = vec4(1, 0, 0, 1);
    green.base_color = vec4(0, 1, 0, 1);
    own.scene.draw(own.scene.mesh(test::quad(1.0f, own.scene.material(red))), at(0, 0, first));
    own.scene.draw(own.scene.mesh(test::quad(1.0f, own.scene.material(green))), at(0, 0, -9.0 - first));
    const Picked p = own.pick_middle();
    EXPECT_NEAR(p.depth_m, 3.0, 1e-4);
    expect_near(p.base_color, first == -3.0 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), 1e-3);
  }
}

TEST_F(Geometry, a_rotated_box_lies_where_rays_meet_it) {
  const Primitive box = test::box(vec3(1.0f, 0.6f, 0.8f));
  const dmat4 pose =
      at(0.3, -0.2, -4) * turned(0.9, glm::normalize(dvec3(1.0, 1.0, 0.2))) * scaled_by(dvec3(1.0, 1.5, 0.7));
  stage->scene.draw(stage->scene.mesh(box), pose);
  std::vector<dvec3> corners;
  for (const std::uint32_t i : box.indices) corners.push_back(dvec3(pose * dvec4(dvec3(box.positions[i]), 1.0)));
  stage->render();
  int compared = 0;
  for (std::uint32_t y = 2; y < 33; y += 5) {
    for (std::uint32_t x = 2; x < 33; x += 5) {
      const test::RayHit hit = test::first_hit(corners, stage->settings, x + 0.5, y + 0.5);
      bool edge = false;
      for (const auto& [dx, dy] : {std::pair{0.05, 0.0}, {-0.05, 0.0}, {0.0, 0.05}, {0.0, -0.05}}) {
        const test::RayHit near = test::first_hit(corners, stage->settings, x + 0.5 + dx, y + 0.5 + dy);
        edge = edge || std::isinf(near.depth_m) != std::isinf(hit.depth_m) || glm::dot(near.normal, hit.normal) < 0.99;
      }
      if (std::isfinite(hit.depth_m) && edge) continue;
      ++compared;
      const Picked p = stage->pick(x, y);
      ASSERT_EQ(p.sky, std::isinf(hit.depth_m)) << x << "," << y;
      if (p.sky) continue;
      EXPECT_NEAR(p.depth_m, hit.depth_m, 1e-3) << x << "," << y;
      expect_near(p.face_normal, hit.normal, 2e-3);
      expect_near(p.normal, hit.normal, 1e-3);
    }
  }
  EXPECT_GT(compared, 30);
}

TEST_F(Geometry, orthographic_cameras_see_faces_and_depths_as_they_are) {
  stage->settings.camera.orthographic = true;
  stage->settings.camera.half_height_m = 4.0f;
  stage->settings.camera.near_m = 0.5f;
  stage->settings.camera.far_m = 20.0f;
  // A face far to the right whose normal points to the right: an orthographic camera sees it, though it faces away from
  // the camera's position.
  const double angle = std::atan2(0.6, 0.8);
  stage->scene.draw(stage->scene.mesh(test::quad(0.8f)), at(3, 0, -2) * turned(angle, dvec3(0, 1, 0)));
  stage->render();
  const auto column = static_cast<std::uint32_t>((3.0 / 8.0 + 0.5) * 33.0);
  const double x = ((column + 0.5) / 33.0 - 0.5) * 8.0;
  const Picked p = stage->pick(column, 16);
  ASSERT_FALSE(p.sky);
  expect_near(p.face_normal, dvec3(0.6, 0.0, 0.8), 1e-3);
  expect_near(p.normal, dvec3(0.6, 0.0, 0.8), 1e-3);
  EXPECT_NEAR(p.depth_m, 2.0 + (x - 3.0) * 0.75, 1e-3);
}

// Hard case: selftest.skinning
TEST_F(Geometry, a_skinned_bar_bends_as_its_twin) {
  const dmat4 lower = at(0, -2, -7);
  const dmat4 upper = at(0, 0, -7) * turned(0.8, dvec3(0, 0, 1)) * turned(0.3, dvec3(0, 1, 0));
  const std::uint32_t skin = test::two_joint_skin(stage->world, 0, lower, upper);
  const Primitive bar = test::skinned_bar();
  // The mesh node's transform must have no effect.
  stage->world.create(WorldTransform{at(100, 100, 100)}, MeshInstance{stage->scene.mesh(bar), skin});
  const dmat4 joints[] = {lower, upper * at(0, -2, 0)};
  std::vector<dvec3> corners;
  for (const std::uint32_t i : bar.indices) {
    const dvec4 rest(dvec3(bar.positions[i]), 1.0);
    const double w = std::round(static_cast<double>(bar.weights[i].y) * 65535.0) / 65535.0;
    corners.push_back(dvec3((1.0 - w) * (joints[0] * rest) + w * (joints[1] * rest)));
  }
  stage->render();
  int hits = 0;
  for (std::uint32_t y = 1; y < 33; y += 4) {
    for (std::uint32_t x = 1; x < 33; x += 3) {
      const test::RayHit hit = test::first_hit(corners, stage->settings, x + 0.5, y + 0.5);
      bool edge = false;
      for (const auto& [dx, dy] : {std::pair{0.1, 0.0}, {-0.1, 0.0}, {0.0, 0.1}, {0.0, -0.1}}) {
        const test::RayHit near = test::first_hit(corners, stage->settings, x + 0.5 + dx, y + 0.5 + dy);
        edge = edge || std::isinf(near.depth_m) != std::isinf(hit.depth_m) || glm::dot(near.normal, hit.normal) < 0.99;
      }
      if (edge && std::isfinite(hit.depth_m)) continue;
      if (std::isinf(hit.depth_m) && (edge || (x + y) % 2 == 0)) continue;
      const Picked p = stage->pick(x, y);
      ASSERT_EQ(p.sky, std::isinf(hit.depth_m)) << x << "," << y;
      if (p.sky) continue;
      ++hits;
      EXPECT_NEAR(p.depth_m, hit.depth_m, 2e-3) << x << "," << y;
      expect_near(p.face_normal, hit.normal, 5e-3);
    }
  }
  EXPECT_GT(hits, 5);
}

TEST_F(Geometry, a_mirrored_skin_shows_its_outside) {
  const dmat4 mirror = at(0, -2, -7) * scaled_by(dvec3(-1, 1, 1));
  const std::uint32_t skin = test::two_joint_skin(stage->world, 0, mirror, mirror * at(0, 2, 0));
  stage->world.create(WorldTransform{}, MeshInstance{stage->scene.mesh(test::skinned_bar()), skin});
  const Picked p = stage->pick_middle();
  ASSERT_FALSE(p.sky);
  EXPECT_NEAR(p.depth_m, 6.5, 1e-3) << "the near side of the bar, not its far one from within";
  expect_near(p.face_normal, dvec3(0, 0, 1), 1e-3);
  EXPECT_GT(p.normal.z, 0.6);
}

TEST_F(Geometry, morph_weights_move_a_surface_and_its_normals) {
  Primitive flag = test::quad(3.0f);
  flag.morph_targets = {{std::vector<vec3>(4, vec3(0, 0, 2)), std::vector<vec3>(4, vec3(1, 0, 0))},
                        {std::vector<vec3>(4, vec3(0, 0, -3)), std::vector<vec3>(4, vec3(0, 0, 0))}};
  const std::uint32_t mesh = stage->scene.mesh(flag);
  stage->scene.assets().meshes[mesh].morph_weights = {0.5f, 0.25f};
  stage->world.create(WorldTransform{at(0, 0, -5)}, MeshInstance{mesh}, MorphInstance{});
  const Picked p = stage->pick_middle();
  ASSERT_FALSE(p.sky);
  EXPECT_NEAR(p.depth_m, 5.0 - 0.5 * 2.0 + 0.25 * 3.0, 1e-3);
  expect_near(p.normal, glm::normalize(dvec3(0.5, 0, 1)), 1e-3);
  expect_near(p.face_normal, dvec3(0, 0, 1), 1e-3);
}

}  // namespace
}  // namespace gloam
