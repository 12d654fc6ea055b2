// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/shadows/outputs.h"
#include "tests/modules/shadows/support/hard_shadows.h"
#include "tests/modules/shadows/support/held_faces.h"
#include "tests/render/draws/small_scene.h"

// Casters that a later module withholds from maps: the maps must be bit-identical to maps of a scene without them.

namespace gloam {
namespace {

/// Withholds the casters that a test sets.
class Withholder final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "withholder"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::announce) frame.put(withheld);
    if (phase != PassPhase::shading) return;
    const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
    has_lists = shadows != nullptr && shadows->final_lists.has_value();
  }

  WithheldCasters withheld;
  bool has_lists = false;  ///< the last frame had final lists
};

using Faces = std::vector<test::FaceTexels>;

/// A wall, resting boxes, casters that the tests move, and a spot, a point light or a directional light.
class ShadowWithheld : public test::HardShadows {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HardShadows::SetUp());
    if (IsSkipped()) return;
    set("shadows.mode", "deferred");
    set("shadows.visibility_bits", "8");
    set("shadows.filter", "hard");
    set("shadows.atlas", "1024");
    settings = test::look_at(dvec3(0.4, 0.3, 5.0), dvec3(0.0), 63, 41);
    thing(test::quad(4.0f, stone));
    for (int i = 0; i < 12; ++i)
      box(dvec3(-1.8 + 0.33 * i, 0.9 - 0.17 * i, 0.3 + 0.1 * (i % 3)), dvec3(0.12, 0.2, 0.05));
    // Distant boxes keep the casters' bounds, and with them the cascades, constant.
    for (const double side : {-1.0, 1.0}) box(dvec3(3.0 * side, 3.0 * side, 1.5 + 1.5 * side), dvec3(0.1));
    add_movers();
  }
  void TearDown() override {
    withholder_->withheld = {};
    HardShadows::TearDown();
  }
  [[nodiscard]] test::SharedRenderer& shared() override {
    static Withholder* added = nullptr;
    static test::SharedRenderer made([this] {
      ModuleList modules = make_modules();
      std::erase_if(modules, [](const auto& module) { return module->name() == "closeups"; });
      auto last = std::make_unique<Withholder>();
      added = last.get();
      modules.push_back(std::move(last));
      return modules;
    }());
    withholder_ = added;
    return made;
  }

  void add_movers() {
    const std::uint32_t mesh = scene.mesh(test::box(vec3(0.08f, 0.15f, 0.06f), stone));
    for (int i = 0; i < 3; ++i) movers.push_back(world.create(WorldTransform{place_at(i)}, MeshInstance{mesh}));
    Material holes = exact_material(180, 170, 160, 255, 0);
    holes.alpha_mode = AlphaMode::mask;
    holes.base_color_texture.texture =
        scene.texture(2, 2, {255, 0, 0, 255, 0, 255, 0, 0, 0, 0, 255, 0, 255, 255, 255, 255}, true);
    const std::uint32_t outline = scene.mesh(test::quad(0.2f, scene.material(holes)));
    movers.push_back(world.create(WorldTransform{place_at(3)}, MeshInstance{outline}));
    Skin skin;
    skin.joint_nodes = {0, 1};
    skin.inverse_bind = {mat4(1.0f), glm::translate(mat4(1.0f), vec3(0.0f, -2.0f, 0.0f))};
    scene.assets().skins.push_back(std::move(skin));
    for (std::uint32_t i = 0; i < 2; ++i) joints.push_back(scene.node(i, bar_at(0.3 * i)));
    bar = world.create(WorldTransform{}, MeshInstance{scene.mesh(test::skinned_bar(stone)), 0});
  }
  void spot_light() { spot_ = lamp(spot(40.0), dvec3(0.2, 0.1, 2.5), dvec3(0.0, 0.0, -1.0), 512); }
  void point_light() { lamp_ = lamp(point(), dvec3(0.1, 0.0, 0.9), dvec3(0.0, 0.0, -1.0), 128); }
  void sun_light() { sun_ = lamp(sun(), dvec3(0.0), dvec3(0.3, -0.5, -1.0), 256); }
  [[nodiscard]] static dmat4 place_at(double t) {
    return glm::translate(dmat4(1.0), dvec3(std::cos(1.7 * t), 0.8 * std::sin(2.3 * t), 0.7 + 0.3 * std::cos(t)));
  }
  [[nodiscard]] static dmat4 bar_at(double t) {
    return glm::translate(dmat4(1.0), dvec3(-0.5 + 0.5 * std::sin(t), -0.3, 0.9)) *
           glm::rotate(dmat4(1.0), t, dvec3(0.3, 1.0, 0.2)) * glm::scale(dmat4(1.0), dvec3(0.1));
  }
  void turn_bar(double t) {
    for (std::size_t i = 0; i < joints.size(); ++i) place(joints[i], bar_at(t + 0.3 * static_cast<double>(i)));
  }
  void nudge(Entity mover, const dvec3& by) { world.get<WorldTransform>(mover).matrix[3] += dvec4(by, 0.0); }

  static void sort(std::vector<Entity>& entities) {
    std::sort(entities.begin(), entities.end(), [](Entity a, Entity b) { return a.index < b.index; });
  }
  void withhold(std::vector<Entity> lights, std::vector<Entity> casters) {
    sort(lights);
    sort(casters);
    withholder_->withheld = {};
    for (const Entity light : lights) withholder_->withheld.lights.push_back({light, casters});
  }
  [[nodiscard]] std::vector<Entity> lights() const {
    std::vector<Entity> all;
    for (const Entity light : {spot_, lamp_, sun_})
      if (light != kNoEntity) all.push_back(light);
    return all;
  }

  void draw_anew() {
    set("shadows.casters", "simplified");  // no mesh here has simplified triangles, but maps count as different
    draw();
    set("shadows.casters", "full");
    draw();
  }
  [[nodiscard]] Faces faces_now() { return test::held_faces(*renderer, world); }
  [[nodiscard]] Faces held_anew() {
    draw_anew();
    return faces_now();
  }
  [[nodiscard]] double drawn_faces() const { return counter("shadows.faces_drawn") + counter("shadows.faces_skipped"); }

  static void expect_equal(const Faces& a, const Faces& b, const std::string& what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    EXPECT_GT(a.size(), 0u);
    for (std::size_t f = 0; f < a.size(); ++f) EXPECT_TRUE(a[f] == b[f]) << what << ", face " << f;
  }

  /// One caster moves in front of others that mostly rest. The withheld casters of each light change now and then.
  void step(std::mt19937& random, int frame) {
    std::uniform_real_distribution<double> small(-0.05, 0.05), anywhere(-1.2, 1.2);
    nudge(movers[0], dvec3(small(random), small(random), small(random)));
    if (frame % 11 == 10) {
      const unsigned turns = random() % 4;
      const dvec3 jump(anywhere(random), anywhere(random), 0.8 + 0.4 * anywhere(random));
      if (turns < 2) place(movers[1 + random() % 3], glm::translate(dmat4(1.0), jump));
      if (turns > 0) turn_bar(3.0 * anywhere(random));
    }
    if (frame % 3 != 2) return;
    WithheldCasters withheld;
    std::vector<Entity> from = lights(), those = movers;
    sort(from);
    those.push_back(bar);
    sort(those);
    for (const Entity light : from) {
      WithheldCasters::OfLight of_light{light, {}};
      for (const Entity caster : those)
        if (random() % 3 == 0) of_light.casters.push_back(caster);
      if (!of_light.casters.empty()) withheld.lights.push_back(std::move(of_light));
    }
    withholder_->withheld = std::move(withheld);
  }
  [[nodiscard]] std::vector<Faces> walk(std::uint32_t seed, int frames, bool anew, double& texels) {
    for (std::size_t i = 0; i < movers.size(); ++i) place(movers[i], place_at(static_cast<double>(i)));
    turn_bar(0.0);
    withholder_->withheld = {};
    std::mt19937 random(seed);
    std::vector<Faces> walked;
    for (int i = 0; i < frames && !HasFatalFailure(); ++i) {
      step(random, i);
      if (anew)
        draw_anew();
      else
        draw();
      texels += counter("shadows.texels_drawn");
      walked.push_back(faces_now());
    }
    return walked;
  }
  void expect_equal_walks(std::uint32_t seed, int frames, double most_share) {
    draw();
    double part_texels = 0.0, whole_texels = 0.0;
    const std::vector<Faces> parts = walk(seed, frames, false, part_texels),
                             whole = walk(seed, frames, true, whole_texels);
    for (std::size_t i = 0; i < parts.size(); ++i) expect_equal(parts[i], whole[i], "frame " + std::to_string(i));
    EXPECT_GT(part_texels, 0.0);
    EXPECT_LT(part_texels, most_share * whole_texels);
  }

  std::vector<Entity> movers, joints;
  Entity bar, spot_, lamp_, sun_;
  Withholder* withholder_ = nullptr;
};

TEST_F(ShadowWithheld, maps_are_as_if_withheld_casters_were_not_there) {
  spot_light(), point_light(), sun_light();
  draw();
  const Faces with = faces_now();
  const std::vector<Entity> casters = {movers[0], movers[3], bar};
  withhold(lights(), casters);
  draw();
  EXPECT_TRUE(withholder_->has_lists);
  const Faces withheld = faces_now();
  expect_equal(withheld, held_anew(), "drawn anew");
  withholder_->withheld = {};
  for (const Entity caster : casters) world.destroy(caster);
  const Faces without = held_anew();
  expect_equal(withheld, without, "without them");
  ASSERT_EQ(with.size(), without.size());
  EXPECT_FALSE(with == without);
}

TEST_F(ShadowWithheld, withheld_casters_that_move_draw_no_face) {
  spot_light(), point_light(), sun_light();
  withhold(lights(), {movers[0], movers[3], bar});
  draw();
  draw();
  const Faces before = faces_now();
  for (int i = 1; i < 4; ++i) {
    nudge(movers[0], dvec3(0.03, -0.02, 0.02));
    nudge(movers[3], dvec3(-0.02, 0.03, 0.0));
    turn_bar(0.3 * i);
    draw();
    EXPECT_EQ(drawn_faces(), 0.0) << i;
    EXPECT_EQ(counter("shadows.texels_drawn"), 0.0) << i;
    EXPECT_EQ(counter("shadows.faces_cached"), static_cast<double>(before.size())) << i;
  }
  expect_equal(before, faces_now(), "nothing is drawn");
}

TEST_F(ShadowWithheld, other_lights_maps_hold_what_is_withheld_from_one) {
  spot_light(), point_light();
  draw();
  const Faces with = faces_now();
  ASSERT_EQ(with.size(), 7u);
  const std::size_t spot_face = world.view_resource<ViewFaces>(ViewId{0}).faces[0].light == spot_ ? 0 : 6;
  withhold({lamp_}, {movers[0]});
  draw();
  const Faces withheld = faces_now();
  EXPECT_TRUE(withheld[spot_face] == with[spot_face]);
  EXPECT_FALSE(withheld == with) << "the lamp sees it";
  nudge(movers[0], dvec3(0.02, 0.01, 0.0));
  draw();
  EXPECT_EQ(drawn_faces(), 1.0);
  EXPECT_EQ(counter("shadows.faces_cached"), 6.0);
  const Faces moved = faces_now();
  for (std::size_t f = 0; f < moved.size(); ++f) EXPECT_EQ(moved[f] == withheld[f], f != spot_face) << f;
  expect_equal(moved, held_anew(), "drawn anew");
}

TEST_F(ShadowWithheld, what_is_withheld_for_a_while_costs_local_lights_parts_of_their_maps) {
  spot_light(), point_light();
  expect_equal_walks(3, 40, 0.75);
}

TEST_F(ShadowWithheld, what_is_withheld_for_a_while_costs_a_sun_parts_of_its_maps) {
  sun_light();
  expect_equal_walks(5, 30, 0.9);
}

TEST_F(ShadowWithheld, a_caster_that_rests_on_a_background_leaves_it_and_comes_back) {
  spot_light();
  const auto move_on = [&](int frames) {
    for (int i = 0; i < frames; ++i) {
      nudge(movers[0], dvec3(i % 2 == 0 ? 0.02 : -0.02, 0.0, 0.0));
      draw();
    }
  };
  place(movers[1], world.get<WorldTransform>(movers[0]).matrix * glm::translate(dmat4(1.0), dvec3(0.05, 0.02, -0.2)));
  move_on(18);
  const auto expect_as_anew = [&](const char* what) {
    nudge(movers[0], dvec3(0.001, 0.0, 0.0));
    draw();
    EXPECT_LT(counter("shadows.texels_drawn"), 512.0 * 512.0) << what;
    const Faces kept = faces_now();
    const WorldTransform rested = world.get<WorldTransform>(movers[0]);
    expect_equal(kept, held_anew(), what);
    world.get<WorldTransform>(movers[0]) = rested;
    move_on(6);
  };
  expect_as_anew("on a background");
  withhold({spot_}, {movers[1]});
  expect_as_anew("withheld from it");
  withholder_->withheld = {};
  expect_as_anew("back");
  withhold({spot_}, {movers[0], movers[1]});
  expect_as_anew("both withheld");
  withhold({spot_}, {movers[1]});
  expect_as_anew("one is back");
}

TEST_F(ShadowWithheld, maps_hold_everything_in_frames_without_final_lists) {
  spot_light(), point_light();
  draw();
  const Faces with = faces_now();
  withhold(lights(), {movers[0], bar});
  for (const auto& [knob, value, lists] :
       {std::tuple{"shadows.mode", "monolithic", "deferred"}, std::tuple{"shadows.visibility_bits", "exact", "8"}}) {
    draw();
    EXPECT_TRUE(withholder_->has_lists) << knob;
    const Faces withheld = faces_now();
    EXPECT_FALSE(withheld == with) << knob;
    set(knob, value);
    draw();
    EXPECT_FALSE(withholder_->has_lists) << knob;
    expect_equal(faces_now(), with, knob);
    nudge(movers[0], dvec3(0.02, 0.0, 0.0));
    draw();
    EXPECT_GT(drawn_faces(), 0.0) << knob;
    place(movers[0], place_at(0));
    set(knob, lists);
    draw();
    EXPECT_TRUE(withholder_->has_lists) << knob;
    expect_equal(faces_now(), withheld, knob);
  }
}

}  // namespace
}  // namespace gloam
