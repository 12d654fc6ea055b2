// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <random>
#include <utility>

#include "engine/math/srgb.h"
#include "engine/scene/gltf/import.h"
#include "modules/accuracy/module.h"
#include "tests/support/render_scene.h"
#include "tests/support/worse.h"

namespace gloam {
namespace {

/// A world, and the surfaces that rays through it meet.
class NearestSurfaces : public testing::Test {
 protected:
  NearestSurfaces() { prepare_scene_world(world_); }

  void trace(const dvec3& origin = dvec3(0.0)) {
    tracer_ = std::move(make_scene_tracer(world_, *serial_, origin)).value();
  }
  [[nodiscard]] TracedSurface seen(const SurfaceRay& ray) const {
    TracedSurface surface;
    tracer_->nearest(world_.resource<SceneAssets>(), {&ray, 1}, {&surface, 1});
    return surface;
  }
  /// The surface on the ray from a world position toward another.
  [[nodiscard]] TracedSurface seen(const dvec3& from, const dvec3& to) const {
    return seen({.origin = vec3(from - tracer_->origin()), .direction = vec3(glm::normalize(to - from))});
  }
  /// The surface under (x, y) of things in the plane z = 0, seen from +Z or from −Z.
  [[nodiscard]] TracedSurface front(double x, double y) const { return seen({x, y, 1.0}, {x, y, 0.0}); }
  [[nodiscard]] TracedSurface back(double x, double y) const { return seen({x, y, -1.0}, {x, y, 0.0}); }

  Entity draw(Primitive primitive, const Material& material, const dmat4& place = dmat4(1.0)) {
    primitive.material = maker_.material(material);
    return maker_.draw(maker_.mesh(std::move(primitive)), place);
  }
  static void expect_near(const vec3& actual, const vec3& expected, float tolerance = 1e-5f) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], tolerance);
  }

  World world_;
  test::SceneMaker maker_{world_};
  std::unique_ptr<JobExecutor> serial_ = make_serial_executor();
  std::unique_ptr<SceneTracer> tracer_;
};

Material two_sided() {
  Material material;
  material.double_sided = true;
  return material;
}

TEST_F(NearestSurfaces, an_empty_world_has_none) {
  trace();
  EXPECT_FALSE(front(0.0, 0.0).hit);
}

TEST_F(NearestSurfaces, a_tilted_ground_of_any_width_is_where_it_is) {
  const dmat4 turned = glm::rotate(dmat4(1.0), 0.7, dvec3(0.36, 0.48, 0.8));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double half : {100.0, 1e4, 1e6, 1e9}) {
    SCOPED_TRACE(half);
    World world;
    prepare_scene_world(world);
    test::SceneMaker maker{world};
    Primitive ground = test::quad(1.0f);
    for (vec3& position : ground.positions) position *= static_cast<float>(half);
    for (std::size_t i = 0; i < ground.positions.size(); ++i)
      ground.uv0[i] = vec2(ground.positions[i]) / static_cast<float>(half);
    ground = test::finished(std::move(ground));
    ground.material = maker.material(two_sided());
    maker.draw(maker.mesh(std::move(ground)), turned);
    maker.draw(maker.mesh(test::box(vec3(0.5f))), glm::translate(dmat4(1.0), dvec3(turned[2]) * -5.0));
    const dvec3 normal(turned[2]), right(turned[0]), up(turned[1]);
    const auto tracer = std::move(make_scene_tracer(world, *serial_, normal * 1.6)).value();
    double worst = 0.0;
    int missed = 0, blocked_above = 0;
    for (int i = 0; i < 2000; ++i) {
      // A point over the ground, and a ray down to it.
      const double height = 0.02 + 3.0 * std::abs(unit(random));
      const dvec3 from = right * (4.0 * unit(random)) + up * (4.0 * unit(random)) + normal * height;
      dvec3 way = glm::normalize(right * unit(random) + up * unit(random) - normal * (0.2 + std::abs(unit(random))));
      const SurfaceRay down{.origin = vec3(from - tracer->origin()), .direction = vec3(way)};
      TracedSurface surface;
      tracer->nearest(world.resource<SceneAssets>(), {&down, 1}, {&surface, 1});
      const double expected = -height / glm::dot(normal, way);
      missed += surface.hit ? 0 : 1;
      if (surface.hit) worst = test::worse(worst, std::abs(static_cast<double>(surface.distance_m) - expected));
      // A ray from 2 mm above the ground up to the sky.
      const ShadowRay sky{.origin = vec3(from - normal * (height - 0.002) - tracer->origin()),
                          .direction = vec3(-way * 1e12)};
      std::uint8_t blocked = 0;
      tracer->occluded({&sky, 1}, {&blocked, 1});
      blocked_above += blocked;
    }
    EXPECT_EQ(missed, 0);
    EXPECT_EQ(blocked_above, 0);
    EXPECT_LT(worst, 2e-4);
  }
}

TEST_F(NearestSurfaces, reflectivity_is_that_of_frames) {
  struct Case {
    float stated, roughness, metallic, expected;
  };
  // Without a stated value: 1 - roughness, of which a surface that is no metal has half.
  const Case cases[] = {{-1.0f, 0.4f, 0.0f, 0.3f},
                        {-1.0f, 0.4f, 1.0f, 0.6f},
                        {-1.0f, 1.0f, 1.0f, 0.0f},
                        {0.0f, 0.0f, 1.0f, 0.0f},
                        {0.35f, 1.0f, 0.0f, 0.35f}};
  double x = 0.0;
  for (const Case& one : cases) {
    Material material;
    material.reflectivity = one.stated;
    material.roughness = one.roughness;
    material.metallic = one.metallic;
    draw(test::quad(0.4f), material, glm::translate(dmat4(1.0), dvec3(x, 0.0, 0.0)));
    trace();
    EXPECT_NEAR(front(x, 0.1).reflectivity, one.expected, 1e-6f);
    x += 1.0;
  }
}

TEST_F(NearestSurfaces, rays_meet_the_front_faces_of_boxes) {
  const dvec3 middle(3.0, 1.0, -2.0), half(0.5, 1.0, 2.0);
  draw(test::box(vec3(half)), {}, glm::translate(dmat4(1.0), middle));
  trace(dvec3(1.0, 2.0, 3.0));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-6.0, 6.0);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const dvec3 from(place(random), place(random), place(random)), to(place(random), place(random), place(random));
    const dvec3 direction = glm::normalize(to - from), relative = from - middle;
    if (glm::all(glm::lessThan(glm::abs(relative), half + 1e-3))) continue;
    // Slab test: the ray enters the box by the face that it reaches last.
    double enter = -1e300, leave = 1e300;
    int face = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (-half[axis] - relative[axis]) / direction[axis];
      const double b = (half[axis] - relative[axis]) / direction[axis];
      if (std::min(a, b) > enter) {
        enter = std::min(a, b);
        face = axis;
      }
      leave = std::min(leave, std::max(a, b));
    }
    if (std::abs(leave - enter) < 1e-4) continue;  // grazes an edge
    const TracedSurface surface = seen(from, to);
    ASSERT_EQ(surface.hit, enter < leave && enter > 0.0);
    if (!surface.hit) continue;
    vec3 normal(0.0f);
    normal[face] = direction[face] > 0.0 ? -1.0f : 1.0f;
    EXPECT_NEAR(surface.distance_m, enter, 1e-4);
    expect_near(surface.position, vec3(from + enter * direction - tracer_->origin()), 1e-4f);
    expect_near(surface.face_normal, normal);
    expect_near(surface.normal, normal);
    ++hits;
  }
  EXPECT_GT(hits, 20);
}

TEST_F(NearestSurfaces, only_double_sided_materials_have_a_back) {
  draw(test::quad(1.0f), {});
  draw(test::quad(1.0f), two_sided(), glm::translate(dmat4(1.0), dvec3(5.0, 0.0, 0.0)));
  dmat4 mirrored(1.0);
  mirrored[0].x = -1.0;
  mirrored[3].x = 10.0;
  draw(test::quad(1.0f), {}, mirrored);
  trace();
  EXPECT_TRUE(front(0.3, 0.2).hit);
  EXPECT_FALSE(back(0.3, 0.2).hit);
  EXPECT_TRUE(front(5.3, 0.2).hit);
  const TracedSurface behind = back(5.3, 0.2);
  ASSERT_TRUE(behind.hit);
  expect_near(behind.face_normal, {0.0f, 0.0f, -1.0f});
  expect_near(behind.normal, {0.0f, 0.0f, -1.0f});
  EXPECT_TRUE(front(10.3, 0.2).hit) << "a mirrored instance shows its front on the same side";
  EXPECT_FALSE(back(10.3, 0.2).hit);
  expect_near(front(10.3, 0.2).normal, {0.0f, 0.0f, 1.0f});
}

TEST_F(NearestSurfaces, normals_that_lean_to_the_back_do_not_swap_the_sides) {
  const vec3 leaning(0.0f, 0.8f, -0.6f);
  Primitive card = test::quad(1.0f);
  card.normals.assign(4, leaning);
  draw(card, two_sided());
  dmat4 mirrored(1.0);
  mirrored[0].x = -1.0;
  mirrored[3].x = 5.0;
  draw(card, two_sided(), mirrored);
  trace();
  for (const double x : {0.3, 5.3}) {
    expect_near(front(x, 0.2).normal, leaning);
    expect_near(front(x, 0.2).face_normal, {0.0f, 0.0f, 1.0f});
    expect_near(back(x, 0.2).normal, -leaning);
    expect_near(back(x, 0.2).face_normal, {0.0f, 0.0f, -1.0f});
  }
}

TEST_F(NearestSurfaces, rays_end_where_they_say) {
  draw(test::quad(1.0f), {});
  trace();
  EXPECT_FALSE(seen({.origin = {0, 0, 1}, .direction = {0, 0, -1}, .to_m = 0.99f}).hit);
  EXPECT_TRUE(seen({.origin = {0, 0, 1}, .direction = {0, 0, -1}, .to_m = 1.01f}).hit);
}

TEST_F(NearestSurfaces, normals_are_interpolated_and_follow_scale_and_mirror) {
  Primitive slope = test::quad(1.0f);
  const vec3 left = glm::normalize(vec3(-1.0f, 0.0f, 1.0f)), right = glm::normalize(vec3(1.0f, 0.0f, 1.0f));
  slope.normals = {left, right, right, left};
  dmat4 wide(1.0);
  wide[0].x = 2.0;
  dmat4 mirrored = wide;
  mirrored[0].x = -2.0;
  mirrored[3].x = 10.0;
  draw(slope, {}, wide);
  draw(slope, {}, mirrored);
  trace();
  // A matrix that doubles x halves the normals' slope in x.
  const vec3 wide_left = glm::normalize(vec3(-0.5f, 0.0f, 1.0f)), wide_right = glm::normalize(vec3(0.5f, 0.0f, 1.0f));
  for (const double x : {-1.5, -0.2, 0.9}) {
    const auto share = static_cast<float>((x + 2.0) / 4.0);
    expect_near(front(x, 0.3).normal, glm::normalize(glm::mix(wide_left, wide_right, share)));
    expect_near(front(x, 0.3).face_normal, {0.0f, 0.0f, 1.0f});
    expect_near(front(10.0 - x, 0.3).normal,
                glm::normalize(glm::mix(wide_right, wide_left, 1.0f - share)) * vec3(-1.0f, 1.0f, 1.0f));
  }
}

TEST_F(NearestSurfaces, materials_are_evaluated_with_their_textures) {
  const auto linear = [](double srgb) { return static_cast<float>(srgb_to_linear(srgb / 255.0)); };
  Material material;
  material.base_color = {0.5f, 1.0f, 1.0f, 1.0f};
  material.emissive = {0.0f, 4.0f, 8.0f};
  material.metallic = 0.5f;
  material.roughness = 0.8f;
  material.occlusion_strength = 0.5f;
  material.base_color_texture.texture = maker_.texture(2, 1, {255, 255, 255, 255, 100, 200, 50, 255}, true);
  material.emissive_texture.texture = maker_.texture(1, 2, {255, 255, 255, 255, 0, 0, 128, 255}, false);
  material.metallic_roughness_texture.texture = maker_.texture(1, 1, {9, 51, 204, 255}, false);
  material.occlusion_texture.texture = maker_.texture(1, 1, {102, 0, 0, 255}, false);
  material.emissive_texture.uv_set = 1;
  material.emissive_texture.transform_row1 = vec3(0.0f, 1.0f, 0.25f);  // moves v by a quarter
  Primitive sheet = test::quad(1.0f);
  sheet.uv1 = sheet.uv0;
  sheet.colors.assign(4, vec4(1.0f, 0.5f, 1.0f, 1.0f));
  draw(std::move(sheet), material);
  trace();
  const TracedSurface left = front(-0.5, 0.9), right = front(0.5, 0.3);
  expect_near(left.base_color, {0.5f, 0.5f, 1.0f});
  expect_near(right.base_color, {0.5f * linear(100), 0.5f * linear(200), linear(50)}, 1e-4f);
  EXPECT_NEAR(left.roughness, 0.8f * 51.0f / 255.0f, 1e-6f);
  EXPECT_NEAR(left.metallic, 0.5f * 204.0f / 255.0f, 1e-6f);
  EXPECT_NEAR(left.occlusion, 1.0f + 0.5f * (102.0f / 255.0f - 1.0f), 1e-6f);
  expect_near(left.emissive, {0.0f, 4.0f, 8.0f});                     // v = 0.05 + 0.25
  expect_near(right.emissive, {0.0f, 0.0f, 8.0f * 128.0f / 255.0f});  // v = 0.35 + 0.25
  EXPECT_FALSE(left.subsurface);
}

TEST_F(NearestSurfaces, textures_are_filtered_in_linear_light) {
  Material material;
  material.base_color_texture.texture = maker_.texture(2, 1, {0, 0, 0, 255, 255, 255, 255, 255}, true);
  maker_.assets().textures.back().nearest = false;
  draw(test::quad(1.0f), material);
  trace();
  for (const double u : {0.3, 0.5, 0.7})  // texel centres are at 0.25 and 0.75
    EXPECT_NEAR(front(2.0 * u - 1.0, 0.1).base_color.g, (u - 0.25) / 0.5, 1e-5);
  EXPECT_NEAR(front(-0.9, 0.1).base_color.g, 0.0, 1e-6) << "clamped to the edge";
  maker_.assets().textures.back().wrap_u = WrapMode::repeat;
  EXPECT_NEAR(front(-1.0 + 1e-6, 0.1).base_color.g, 0.5, 1e-4);
}

TEST_F(NearestSurfaces, meshes_without_a_material_have_the_default_one) {
  maker_.draw(maker_.mesh(test::quad(1.0f)));
  trace();
  const TracedSurface surface = front(0.1, 0.1);
  expect_near(surface.base_color, vec3(1.0f));
  EXPECT_EQ(surface.metallic, 1.0f);
  EXPECT_EQ(surface.roughness, 1.0f);
}

TEST_F(NearestSurfaces, rays_pass_through_holes_and_blended_surfaces) {
  Material mask;
  mask.alpha_mode = AlphaMode::mask;
  mask.base_color_texture.texture = maker_.texture(2, 1, {255, 255, 255, 0, 255, 255, 255, 255}, true);
  draw(test::quad(1.0f), mask);
  Material glass;
  glass.alpha_mode = AlphaMode::blend;
  draw(test::quad(1.0f), glass, glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 0.5)));
  draw(test::quad(1.0f), {}, glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -2.0)));
  trace();
  EXPECT_NEAR(front(-0.5, 0.2).distance_m, 3.0f, 1e-5f);
  EXPECT_NEAR(front(0.5, 0.2).distance_m, 1.0f, 1e-5f);
}

TEST_F(NearestSurfaces, meshes_that_cast_no_shadows_are_seen_and_leave_occlusion_as_it_is) {
  draw(test::quad(1.0f), {}, glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -1.0)));
  trace();
  const std::uint64_t version = tracer_->version(), all = tracer_->all_version();
  Material green = two_sided();
  green.base_color = {0.0f, 1.0f, 0.0f, 1.0f};
  green.emissive = vec3(1.0f);
  world_.get<MeshInstance>(draw(test::quad(0.5f), green)).casts_shadows = false;
  trace();
  EXPECT_EQ(tracer_->version(), version);
  EXPECT_NE(tracer_->all_version(), all);
  EXPECT_EQ(tracer_->triangles(), 2u);
  EXPECT_TRUE(tracer_->emissive_meshes().empty());
  expect_near(front(0.2, 0.2).base_color, {0.0f, 1.0f, 0.0f});
  EXPECT_NEAR(front(0.8, 0.2).distance_m, 2.0f, 1e-5f);
  EXPECT_TRUE(seen({0.2, 0.2, -0.5}, {0.2, 0.2, -1.0}).hit) << "behind it";
  const ShadowRay through{.origin = {0.2f, 0.2f, 1.0f}, .direction = {0.0f, 0.0f, -1.5f}};
  std::uint8_t blocked = 2;
  tracer_->occluded({&through, 1}, {&blocked, 1});
  EXPECT_EQ(blocked, 0);
}

TEST_F(NearestSurfaces, normals_of_skinned_meshes_turn_with_their_joints) {
  Primitive sheet = test::quad(1.0f);
  sheet.joints.assign(4, {0, 0, 0, 0});
  sheet.weights.assign(4, vec4(1.0f, 0.0f, 0.0f, 0.0f));
  const Entity entity = world_.create(WorldTransform{}, MeshInstance{maker_.mesh(std::move(sheet)), 0});
  JointMatrices& joints = world_.resource<JointMatrices>();
  joints.matrices = {glm::rotate(mat4(1.0f), 0.6f, vec3(0.0f, 1.0f, 0.0f))};
  joints.ranges = {{.instance = entity, .first = 0, .count = 1}};
  trace();
  const TracedSurface surface = front(0.1, 0.2);
  ASSERT_TRUE(surface.hit);
  expect_near(surface.normal, {std::sin(0.6f), 0.0f, std::cos(0.6f)});
  expect_near(surface.face_normal, surface.normal);
}

TEST_F(NearestSurfaces, normals_of_morphed_meshes_follow_their_weights) {
  Primitive sheet = test::quad(1.0f);
  sheet.morph_targets.push_back(
      {std::vector<vec3>(4, vec3(0.0f, 0.0f, -1.0f)), std::vector<vec3>(4, vec3(1.0f, 0.0f, 0.0f))});
  world_.create(WorldTransform{}, MeshInstance{maker_.mesh(std::move(sheet))}, MorphInstance{0, 1});
  world_.resource<MorphWeights>().values = {0.5f};
  trace();
  EXPECT_NEAR(front(0.1, 0.1).distance_m, 1.5f, 1e-5f);
  expect_near(front(0.1, 0.1).normal, glm::normalize(vec3(0.5f, 0.0f, 1.0f)));
}

}  // namespace
}  // namespace gloam
