// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "modules/closeups/components.h"
#include "modules/shadows/outputs.h"
#include "tests/modules/shadows/support/blades_module.h"
#include "tests/modules/shadows/support/held_faces.h"
#include "tests/modules/shadows/support/shadowed_scene.h"

// Casters without a mesh: blades that another module draws into shadow maps.

namespace gloam {
namespace {

using Faces = std::vector<test::FaceTexels>;

class CasterSources : public test::ShadowedScene {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ShadowedScene::SetUp());
    if (IsSkipped()) return;
    set("shadows.atlas", "1024");
    set("shadows.filter", "hard");
  }
  [[nodiscard]] ModuleList make_modules() override {
    ModuleList modules = make_all_modules();
    auto made = std::make_unique<test::BladesModule>();
    blades_ = made.get();
    modules.insert(modules.begin(), std::move(made));
    return modules;
  }

  /// Blades in a row, parallel to the wall.
  test::BladeField& field(const dvec3& origin, int count, float spacing_m, float half_width_m, float height_m) {
    test::BladeField& made = blades_->fields.emplace_back();
    made.origin = origin;
    for (int i = 0; i < count; ++i) {
      const float x = spacing_m * (static_cast<float>(i) - 0.5f * static_cast<float>(count - 1));
      made.resting.push_back({vec3(x, 0.0f, 0.03f * static_cast<float>(i % 3)), half_width_m,
                              vec3(x + 0.05f, height_m, 0.03f * static_cast<float>(i % 3)), 0.0f});
    }
    return made;
  }
  test::BladeField& swaying(const dvec3& origin, int count = 6) {
    test::BladeField& made = field(origin, count, 0.12f, 0.03f, 0.3f);
    made.reach_m = 0.06f;
    made.moving = true;
    return made;
  }
  void resting_boxes() {
    for (int i = 0; i < 12; ++i)
      box(dvec3(-1.8 + 0.33 * i, 0.9 - 0.17 * i, 0.3 + 0.1 * (i % 3)), dvec3(0.12, 0.2, 0.05));
  }
  Entity lamp_of(const std::string& name, LightKind kind, const dvec3& position, std::uint32_t resolution,
                 const dvec3& direction = dvec3(0.0, 0.0, -1.0)) {
    const Entity made = lamp(name, kind, position, direction);
    world.get<ShadowCaster>(made).resolution = resolution;
    return made;
  }
  void sway() {
    for (test::BladeField& made : blades_->fields)
      if (made.moving) made.phase += 0.37f;
  }

  /// Whether a blade lies between two points (Möller–Trumbore, in double).
  [[nodiscard]] bool bladed(const dvec3& from, const dvec3& to) const {
    const dvec3 step = to - from;
    for (const test::BladeField& made : blades_->fields)
      for (std::size_t i = 0; i < made.resting.size(); ++i) {
        const auto triangle = made.triangle(i);
        const dvec3 a = triangle.corners[1] - triangle.corners[0], b = triangle.corners[2] - triangle.corners[0];
        const dvec3 p = glm::cross(step, b), s = from - triangle.corners[0], q = glm::cross(s, a);
        const double determinant = glm::dot(a, p);
        const double u = glm::dot(s, p) / determinant, v = glm::dot(step, q) / determinant;
        const double t = glm::dot(b, q) / determinant;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-4 && t < 1.0) return true;
      }
    return false;
  }
  /// Compares the drawn visibility of the wall with geometry. position: of the light, or a point far in the direction
  /// that it comes from.
  void expect_true_shadows(const std::string& name, const dvec3& position) {
    const std::vector<float> seen = visibility(name);
    ASSERT_EQ(seen.size(), std::size_t{settings.width} * settings.height);
    int lit = 0, dark = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const Ray r = ray(x, y);
        const dvec3 point = r.origin - r.direction * (r.origin.z / r.direction.z);
        const float at = seen[y * settings.width + x];
        if (at < 0.0f || std::max(std::abs(point.x), std::abs(point.y)) > 3.9) continue;
        const bool middle = bladed(point, position);
        bool clear = true;
        for (const dvec3& offset :
             {dvec3(0.015, 0.0, 0.0), dvec3(-0.015, 0.0, 0.0), dvec3(0.0, 0.015, 0.0), dvec3(0.0, -0.015, 0.0)})
          clear = clear && bladed(point + offset, position) == middle;
        if (!clear) continue;  // too close to a shadow's edge
        EXPECT_EQ(at, middle ? 0.0f : 1.0f) << name << " at " << x << "," << y;
        (middle ? dark : lit) += 1;
      }
    EXPECT_GT(lit, 1000) << name;
    EXPECT_GT(dark, 50) << name;
  }

  /// Draws of the newest frame in passes that draw shadow maps.
  [[nodiscard]] std::uint32_t map_draws() const {
    std::uint32_t draws = 0;
    for (const PassTime& pass : renderer->report().passes)
      if (pass.name == "shadow_map_draw") draws += pass.draws;
    return draws;
  }
  [[nodiscard]] std::size_t passes_named(const std::string& name) const {
    const FrameReport report = renderer->report();
    return static_cast<std::size_t>(
        std::ranges::count_if(report.passes, [&](const PassTime& pass) { return pass.name == name; }));
  }

  [[nodiscard]] Faces faces_now() { return test::held_faces(*renderer, world); }
  /// The maps in the next frame, all drawn whole and without anything kept.
  [[nodiscard]] Faces faces_from_scratch() {
    set("shadows.casters", "simplified");  // no mesh here has simplified triangles, but maps count as different
    draw();
    set("shadows.casters", "full");
    return faces_now();
  }
  /// Number of texels in which two maps differ.
  [[nodiscard]] static std::size_t differing(const Faces& a, const Faces& b) {
    std::size_t count = 0;
    EXPECT_EQ(a.size(), b.size());
    for (std::size_t f = 0; f < std::min(a.size(), b.size()); ++f)
      for (std::size_t i = 0; i + 4 <= std::min(a[f].size(), b[f].size()); i += 4)
        count += std::memcmp(&a[f][i], &b[f][i], 4) == 0 ? 0 : 1;
    return count;
  }
  /// Draws frames in which blades sway, boxes move now and then, and a resting field changes. Compares the maps with
  /// maps drawn from scratch.
  void expect_equal_walks(int frames, double most_share) {
    resting_boxes();
    swaying(dvec3(0.1, -0.2, 0.9));
    swaying(dvec3(-0.6, 0.3, 0.7), 3);
    field(dvec3(0.3, 0.1, 0.5), 5, 0.1f, 0.04f, 0.25f);
    // Distant boxes keep the casters' bounds, and with them the cascades, constant.
    for (const double side : {-1.0, 1.0}) box(dvec3(3.0 * side, 3.0 * side, 1.5 + 1.5 * side), dvec3(0.1));
    const Entity mover = scene.draw(scene.mesh(test::box(vec3(0.1f), stone)));
    double texels[2] = {0.0, 0.0};
    std::vector<Faces> walks[2];
    for (const std::size_t from_scratch : {0u, 1u}) {
      std::mt19937 random(5);
      std::uniform_real_distribution<double> near(-0.4, 0.4);
      world.get<WorldTransform>(mover).matrix = glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 0.7));
      for (test::BladeField& made : blades_->fields) made.phase = 0.0f;
      draw();
      for (int i = 0; i < frames && !HasFatalFailure(); ++i) {
        sway();
        if (i % 5 == 4)
          world.get<WorldTransform>(mover).matrix[3] = dvec4(near(random), near(random), 0.7 + near(random), 1.0);
        if (i % 7 == 6) blades_->fields[2].phase += 0.5f;
        draw();
        texels[from_scratch] += counter("shadows.texels_drawn");
        walks[from_scratch].push_back(from_scratch == 1 ? faces_from_scratch() : faces_now());
      }
    }
    for (int i = 0; i < frames && !HasFatalFailure(); ++i) {
      const Faces &parts = walks[0][static_cast<std::size_t>(i)], &whole = walks[1][static_cast<std::size_t>(i)];
      ASSERT_EQ(parts.size(), whole.size());
      ASSERT_GT(parts.size(), 0u);
      for (std::size_t f = 0; f < parts.size(); ++f)
        EXPECT_TRUE(parts[f] == whole[f]) << "frame " << i << " face " << f;
      if (i > 0) {
        EXPECT_FALSE(parts == walks[0][static_cast<std::size_t>(i) - 1]) << "blades sway, frame " << i;
      }
    }
    EXPECT_LT(texels[0], most_share * texels[1]);
  }

  test::BladesModule* blades_ = nullptr;
};

TEST_F(CasterSources, blades_cast_their_shadows_where_geometry_says) {
  test::BladeField& row = field(dvec3(-0.1, -0.1, 0.5), 5, 0.25f, 0.08f, 0.5f);
  row.reach_m = 0.15f;
  row.moving = true;
  lamp("spot", LightKind::spot, dvec3(-0.6, -0.4, 2.6), dvec3(0.15, 0.1, -1.0));
  lamp("point", LightKind::point, dvec3(0.3, 0.5, 2.2));
  for (const float phase : {0.4f, 2.0f}) {
    row.phase = phase;
    expect_true_shadows("spot", dvec3(-0.6, -0.4, 2.6));
    expect_true_shadows("point", dvec3(0.3, 0.5, 2.2));
  }
}

TEST_F(CasterSources, blades_cast_a_suns_shadows_in_a_scene_whose_meshes_are_flat) {
  const test::BladeField& row = field(dvec3(-0.1, -0.1, 0.5), 5, 0.25f, 0.08f, 0.5f);
  const WorldBox bounds = row.bounds();
  world.create(CasterVolume{bounds.min, bounds.max});
  set("shadows.atlas", "4096");
  lamp_of("sun", LightKind::directional, dvec3(0.0), 2048);
  expect_true_shadows("sun", dvec3(0.0, 0.0, 1000.0));
}

TEST_F(CasterSources, blades_far_from_the_worlds_origin_cast_the_same_maps) {
  resting_boxes();
  swaying(dvec3(0.1, -0.2, 0.9)).phase = 0.7f;
  lamp_of("spot", LightKind::spot, dvec3(0.25, 0.125, 2.5), 512);
  draw();
  const Faces here = faces_now();
  const dvec3 away(1048576.0, -524288.0, 2097152.0);
  world.view<WorldTransform>().each([&](WorldTransform& transform) { transform.matrix[3] += dvec4(away, 0.0); });
  settings.world_from_camera[3] += dvec4(away, 0.0);
  blades_->fields[0].origin += away;
  draw();
  const Faces there = faces_now();
  blades_->fields.clear();
  draw();
  const Faces bare = faces_now();
  const std::size_t by_blades = differing(there, bare);
  EXPECT_GT(by_blades, 500u);
  EXPECT_LT(differing(here, there), by_blades / 20) << "only the rounding of world positions differs";
}

TEST_F(CasterSources, casters_that_rest_are_not_drawn_again_while_blades_sway_over_them) {
  resting_boxes();
  swaying(dvec3(0.1, -0.2, 0.9));
  lamp_of("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5), 512);
  draw();
  EXPECT_EQ(counter("shadows.texels_drawn"), 512.0 * 512.0);
  EXPECT_GT(map_draws(), 10u);
  sway(), draw();  // draws the resting casters around the blades once
  for (int i = 0; i < 20; ++i) {
    sway(), draw();
    EXPECT_EQ(map_draws(), 1u) << "only the blades";
    EXPECT_EQ(counter("shadows.faces_drawn"), 1.0);
    EXPECT_GT(counter("shadows.texels_drawn"), 0.0);
    EXPECT_LT(counter("shadows.texels_drawn"), 0.2 * 512.0 * 512.0);
  }
}

TEST_F(CasterSources, casters_that_rest_are_not_drawn_again_while_blades_sway_all_over_the_map) {
  resting_boxes();
  test::BladeField& meadow = field(dvec3(0.0, -1.5, 0.9), 40, 0.12f, 0.03f, 3.0f);
  meadow.moving = true;
  meadow.reach_m = 0.06f;
  lamp_of("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5), 512);
  draw();
  sway(), draw();
  EXPECT_EQ(counter("shadows.texels_drawn"), 2.0 * 512.0 * 512.0) << "the resting casters are kept";
  for (int i = 0; i < 3; ++i) {
    sway(), draw();
    EXPECT_EQ(map_draws(), 1u) << "only the blades";
    EXPECT_EQ(counter("shadows.texels_drawn"), 512.0 * 512.0);
    const Faces kept = faces_now();
    EXPECT_TRUE(kept == faces_from_scratch());
    draw(), draw();
  }
}

TEST_F(CasterSources, blades_that_rest_are_cached_and_drawn_again_when_their_hash_changes) {
  resting_boxes();
  test::BladeField& row = field(dvec3(0.1, -0.2, 0.9), 6, 0.12f, 0.03f, 0.3f);
  lamp_of("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5), 512);
  draw();
  const Faces before = faces_now();
  draw();
  EXPECT_EQ(counter("shadows.texels_drawn"), 0.0);
  EXPECT_EQ(counter("shadows.faces_cached"), 1.0);
  row.resting[2].tip.x += 0.1f;
  draw();
  EXPECT_EQ(counter("shadows.faces_drawn"), 1.0);
  EXPECT_LT(counter("shadows.texels_drawn"), 0.3 * 512.0 * 512.0);
  const Faces after = faces_now();
  EXPECT_FALSE(after == before);
  EXPECT_TRUE(after == faces_from_scratch());
}

TEST_F(CasterSources, of_blades_about_which_nothing_is_told_neither_maps_nor_close_ups_are_kept) {
  set("shadows.mode", "deferred");
  set("shadows.visibility_bits", "8");
  set("closeups.max_pairs", "4");
  resting_boxes();
  const Entity subject = box(dvec3(0.1, -0.1, 0.7), dvec3(0.2, 0.3, 0.1));
  world.add(subject, CloseupSubject{true});
  test::BladeField& row = field(dvec3(0.1, -0.2, 0.7), 3, 0.05f, 0.02f, 0.2f);
  row.entity = subject;
  lamp_of("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5), 512);
  for (int i = 0; i < 4; ++i) draw();
  EXPECT_EQ(counter("closeups.pairs"), 1.0);
  EXPECT_EQ(counter("closeups.maps_drawn"), 0.0) << "it rests, and its hash says so";
  row.told = false;
  for (int i = 0; i < 4; ++i) {
    blades_->recorded = 0;
    draw();
    EXPECT_EQ(counter("closeups.maps_drawn"), 1.0) << i;
    EXPECT_GT(blades_->recorded, 0) << i;
  }
  EXPECT_EQ(map_draws(), 0u) << "the light's own map leaves the subject out";
  row.entity = kNoEntity;
  for (int i = 0; i < 4; ++i) {
    draw();
    EXPECT_EQ(counter("shadows.faces_drawn"), 1.0) << i;
  }
  row.resting[1].tip.x += 0.1f;  // nobody tells
  draw();
  const Faces changed = faces_now();
  EXPECT_TRUE(changed == faces_from_scratch());
}

TEST_F(CasterSources, swaying_blades_leave_a_spots_map_as_drawn_from_scratch) {
  lamp_of("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5), 512);
  expect_equal_walks(24, 0.7);
}

TEST_F(CasterSources, swaying_blades_leave_a_lamps_six_maps_as_drawn_from_scratch) {
  set("shadows.depth", "d16");
  lamp_of("lamp", LightKind::point, dvec3(0.1, 0.0, 1.6), 256);
  expect_equal_walks(12, 0.8);
}

TEST_F(CasterSources, swaying_blades_leave_a_suns_maps_as_drawn_from_scratch) {
  lamp_of("sun", LightKind::directional, dvec3(0.0), 256, dvec3(0.3, -0.5, -1.0));
  expect_equal_walks(12, 0.9);
}

TEST_F(CasterSources, withheld_blades_are_as_if_they_were_not_there) {
  set("shadows.mode", "deferred");
  set("shadows.visibility_bits", "8");
  resting_boxes();
  swaying(dvec3(0.1, -0.2, 0.9)).entity = world.create(WorldTransform{});
  const Entity spot = lamp_of("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5), 512);
  draw();
  const Faces with = faces_now();
  const Entity entity = blades_->fields[0].entity;
  blades_->also = [spot, entity](FrameBuilder& frame, PassPhase phase) {
    if (phase == PassPhase::announce) frame.put(WithheldCasters{{{spot, {entity}}}});
  };
  draw();
  const Faces without = faces_now();
  EXPECT_FALSE(without == with);
  for (int i = 0; i < 3; ++i) {
    sway(), draw();
    EXPECT_EQ(counter("shadows.texels_drawn"), 0.0) << "they sway unseen";
  }
  blades_->also = nullptr;
  sway(), draw();
  EXPECT_GT(counter("shadows.texels_drawn"), 0.0);
  EXPECT_TRUE(faces_now() == faces_from_scratch());
  blades_->fields.clear();
  draw();
  EXPECT_TRUE(faces_now() == without);
}

TEST_F(CasterSources, an_extra_map_holds_the_blades_of_its_entities) {
  set("shadows.mode", "deferred");
  set("shadows.visibility_bits", "8");
  resting_boxes();
  for (const double x : {0.1, -0.7}) swaying(dvec3(x, -0.2, 0.9)).entity = world.create(WorldTransform{});
  lamp_of("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5), 512);
  std::vector<Entity> all;
  world.view<const MeshInstance>().each([&](Entity entity, const MeshInstance&) { all.push_back(entity); });
  for (const test::BladeField& made : blades_->fields) all.push_back(made.entity);
  std::ranges::sort(all, {}, &Entity::index);
  std::vector<Entity> casters = all;
  blades_->also = [&](FrameBuilder& frame, PassPhase phase) {
    if (phase != PassPhase::shading) return;
    const ShadowMapDrawer& drawer = frame.get<ShadowMapDrawer>();
    ExtraMap map{frame.world().view_resource<ViewFaces>(frame.view().id).faces.front(), casters};
    map.face.square.origin = uvec2(0);
    ExtraAtlas atlas = drawer.create(frame, 512);
    drawer.draw(frame, "extra", {&map, 1}, atlas);
    frame.expose(atlas.atlas, "extra_atlas");
  };
  const auto extra = [&] {
    test::FaceTexels texels;
    const ImageBytes image = test::value_of(renderer->read_image(world, ViewId{0}, "extra_atlas"));
    test::append_texels(texels, image.bytes, 512, 0, 0, {uvec2(0), 512});
    return texels;
  };
  draw();
  test::FaceTexels standard = faces_now().at(0);
  test::FaceTexels first = extra();
  standard.resize(first.size());  // mip 0
  EXPECT_TRUE(first == standard);
  std::erase(casters, blades_->fields[1].entity);
  EXPECT_FALSE(extra() == first) << "without the second field";
  blades_->fields.pop_back();
  EXPECT_TRUE(extra() == [&] {
    test::FaceTexels texels = faces_now().at(0);
    texels.resize(first.size());
    return texels;
  }());
}

TEST_F(CasterSources, blades_that_no_light_reaches_cost_nothing) {
  resting_boxes();
  swaying(dvec3(0.0, 0.0, 40.0));
  lamp_of("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5), 512);
  for (int i = 0; i < 3; ++i) {
    sway(), draw();
    EXPECT_EQ(passes_named("sway"), 0u) << "nobody reads their buffer";
    EXPECT_EQ(counter("shadows.texels_drawn"), i == 0 ? 512.0 * 512.0 : 0.0);
  }
  EXPECT_EQ(blades_->declared, 0);
  EXPECT_EQ(blades_->recorded, 0);
  blades_->fields[0].origin.z = 1.0;
  draw();
  EXPECT_EQ(passes_named("sway"), 1u);
  EXPECT_EQ(blades_->recorded, 1);
  set("shadows.mode", "off");
  draw();
  EXPECT_EQ(blades_->recorded, 1) << "without maps";
  EXPECT_EQ(passes_named("sway"), 0u);
}

}  // namespace
}  // namespace gloam
