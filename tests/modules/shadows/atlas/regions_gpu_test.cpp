// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "tests/modules/shadows/support/held_faces.h"
#include "tests/modules/shadows/support/shadowed_scene.h"
#include "tests/render/draws/small_scene.h"

// Regions of maps that are redrawn where casters move: the maps must be bit-identical to maps that are drawn whole.

namespace gloam {
namespace {

struct WalkedFrame {
  std::vector<test::FaceTexels> faces;
  double texels = 0.0;
};

class ShadowRegions : public test::ShadowedScene {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ShadowedScene::SetUp());
    if (IsSkipped()) return;
    set("shadows.atlas", "1024");
    settings = test::look_at(dvec3(0.4, 0.3, 5.0), dvec3(0.0), 95, 63);
    for (int i = 0; i < 12; ++i)
      box(dvec3(-1.8 + 0.33 * i, 0.9 - 0.17 * i, 0.3 + 0.1 * (i % 3)), dvec3(0.12, 0.2, 0.05));
    mesh = scene.mesh(test::box(vec3(0.08f, 0.15f, 0.06f), stone));
    outline = scene.mesh(test::quad(0.2f, holes()));
  }

  /// A cut-out material with a hole in every other texel.
  std::uint32_t holes() {
    Material material = exact_material(180, 170, 160, 255, 0);
    material.alpha_mode = AlphaMode::mask;
    material.base_color_texture.texture =
        scene.texture(2, 2, {255, 0, 0, 255, 0, 255, 0, 0, 0, 0, 255, 0, 255, 255, 255, 255}, true);
    return scene.material(material);
  }

  /// Adds the casters that the tests move.
  void add_movers() {
    for (int i = 0; i < 3; ++i) movers.push_back(world.create(WorldTransform{place(i)}, MeshInstance{mesh}));
    movers.push_back(world.create(WorldTransform{place(3)}, MeshInstance{outline}));
    Skin skin;
    skin.joint_nodes = {0, 1};
    skin.inverse_bind = {mat4(1.0f), glm::translate(mat4(1.0f), vec3(0.0f, -2.0f, 0.0f))};
    scene.assets().skins.push_back(std::move(skin));
    for (std::uint32_t i = 0; i < 2; ++i) joints.push_back(scene.node(i, bar_at(0.3 * i)));
    world.create(WorldTransform{}, MeshInstance{scene.mesh(test::skinned_bar(stone)), 0});
  }
  [[nodiscard]] static dmat4 place(double t) {
    return glm::translate(dmat4(1.0), dvec3(std::cos(1.7 * t), 0.8 * std::sin(2.3 * t), 0.7 + 0.3 * std::cos(t)));
  }
  [[nodiscard]] static dmat4 bar_at(double t) {
    return glm::translate(dmat4(1.0), dvec3(-0.5 + 0.5 * std::sin(t), -0.3, 0.9)) *
           glm::rotate(dmat4(1.0), t, dvec3(0.3, 1.0, 0.2)) * glm::scale(dmat4(1.0), dvec3(0.1));
  }

  /// One step of a random walk: small moves, jumps, jumps to behind all other casters; boxes that appear and disappear;
  /// joints that turn or rest.
  void step(std::mt19937& random) {
    std::uniform_real_distribution<double> anywhere(-1.5, 1.5), nudge(-0.02, 0.02);
    for (Entity& mover : movers) {
      const unsigned choice = random() % 8;
      const dvec3 jump(anywhere(random), anywhere(random), 0.8 + 0.5 * anywhere(random));
      const dvec3 small(nudge(random), nudge(random), nudge(random));
      if (choice < 3) continue;
      WorldTransform& transform = world.get<WorldTransform>(mover);
      if (choice < 6) transform.matrix[3] += dvec4(small, 0.0);
      if (choice == 6) transform.matrix[3] = dvec4(jump, 1.0);
      if (choice == 7) {
        const MeshInstance shape = world.get<MeshInstance>(mover);
        world.destroy(mover);
        mover = world.create(WorldTransform{glm::translate(dmat4(1.0), jump)}, shape);
      }
    }
    if (random() % 3 == 0) guests.push_back(world.create(WorldTransform{place(anywhere(random))}, MeshInstance{mesh}));
    if (random() % 3 == 0 && !guests.empty()) {
      world.destroy(guests.back());
      guests.pop_back();
    }
    const double t = 3.0 * anywhere(random);
    if (random() % 4 != 0)
      for (std::size_t i = 0; i < joints.size(); ++i)
        world.get<WorldTransform>(joints[i]).matrix = bar_at(t + 0.3 * static_cast<double>(i));
  }

  /// The contents of the view's faces.
  [[nodiscard]] WalkedFrame walked_frame() {
    WalkedFrame frame;
    frame.texels = counter("shadows.texels_drawn");  // first, because reading images draws frames
    frame.faces = test::held_faces(*renderer, world);
    return frame;
  }

  /// One step of a walk.
  using Step = std::function<void(std::mt19937& random, int frame)>;
  /// Most casters rest long enough to count as resting, while one moves in front of them.
  void resting_step(std::mt19937& random, int frame) {
    if (frame % 12 == 11) return step(random);
    std::uniform_real_distribution<double> nudge(-0.05, 0.05);
    world.get<WorldTransform>(movers[0]).matrix[3] += dvec4(nudge(random), nudge(random), nudge(random), 0.0);
  }

  /// The frames of a walk. anew: no map is reused, each frame draws all maps whole.
  [[nodiscard]] std::vector<WalkedFrame> walk(std::uint32_t seed, int frames, bool anew, const Step& one_step) {
    for (const Entity guest : guests) world.destroy(guest);
    guests.clear();
    for (std::size_t i = 0; i < movers.size(); ++i)
      world.get<WorldTransform>(movers[i]).matrix = place(static_cast<double>(i));
    for (const Entity joint : joints) world.get<WorldTransform>(joint).matrix = bar_at(0.0);
    std::mt19937 random(seed);
    std::vector<WalkedFrame> walked;
    for (int i = 0; i < frames && !HasFatalFailure(); ++i) {
      one_step(random, i);
      if (anew) {
        set("shadows.casters", "simplified");  // no mesh here has simplified triangles, but maps count as different
        draw();
        set("shadows.casters", "full");
      }
      draw();
      walked.push_back(walked_frame());
    }
    return walked;
  }

  void expect_equal_walks(std::uint32_t seed, int frames, double most_share, const Step& one_step) {
    add_movers();
    draw();
    const std::vector<WalkedFrame> parts = walk(seed, frames, false, one_step),
                                   whole = walk(seed, frames, true, one_step);
    double part_texels = 0.0, whole_texels = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      ASSERT_EQ(parts[i].faces.size(), whole[i].faces.size());
      EXPECT_GT(parts[i].faces.size(), 0u);
      for (std::size_t f = 0; f < parts[i].faces.size(); ++f) {
        EXPECT_TRUE(parts[i].faces[f] == whole[i].faces[f]) << "frame " << i << " face " << f;
      }
      part_texels += parts[i].texels;
      whole_texels += whole[i].texels;
    }
    EXPECT_GT(part_texels, 0.0);
    EXPECT_LT(part_texels, most_share * whole_texels);
  }

  void expect_equal_walks(std::uint32_t seed, int frames, double most_share) {
    expect_equal_walks(seed, frames, most_share, [this](std::mt19937& random, int) { step(random); });
  }
  void expect_equal_resting_walks(std::uint32_t seed, int frames, double most_share) {
    expect_equal_walks(seed, frames, most_share,
                       [this](std::mt19937& random, int frame) { resting_step(random, frame); });
  }

  std::uint32_t mesh = 0, outline = 0;
  std::vector<Entity> movers, guests, joints;
};

TEST_F(ShadowRegions, parts_of_a_spots_map_equal_the_whole) {
  world.get<ShadowCaster>(lamp("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5))).resolution = 512;
  expect_equal_walks(3, 24, 0.6);
}

TEST_F(ShadowRegions, parts_of_a_lamps_six_maps_equal_the_whole) {
  world.get<ShadowCaster>(lamp("lamp", LightKind::point, dvec3(0.1, 0.0, 0.9))).resolution = 256;
  expect_equal_walks(5, 24, 0.8);
}

TEST_F(ShadowRegions, parts_of_a_suns_maps_equal_the_whole) {
  world.get<ShadowCaster>(lamp("sun", LightKind::directional, dvec3(0.0), dvec3(0.3, -0.5, -1.0))).resolution = 256;
  // Distant boxes keep the casters' bounds, and with them the cascades, constant.
  for (const double side : {-1.0, 1.0}) box(dvec3(3.0 * side, 3.0 * side, 1.5 + 1.5 * side), dvec3(0.1));
  expect_equal_walks(7, 24, 0.8);
}

TEST_F(ShadowRegions, parts_of_maps_of_sixteen_bits_and_means_equal_the_whole) {
  set("shadows.depth", "d16");
  set("shadows.mip_operator", "average");
  world.get<ShadowCaster>(lamp("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5))).resolution = 512;
  expect_equal_walks(9, 8, 0.7);
}

TEST_F(ShadowRegions, casters_that_rest_and_move_again_leave_maps_as_the_whole) {
  world.get<ShadowCaster>(lamp("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5))).resolution = 512;
  world.get<ShadowCaster>(lamp("lamp", LightKind::point, dvec3(0.1, 0.0, 0.9))).resolution = 128;
  expect_equal_resting_walks(11, 60, 0.6);
}

TEST_F(ShadowRegions, casters_that_rest_leave_maps_of_sixteen_bits_as_the_whole) {
  set("shadows.depth", "d16");
  world.get<ShadowCaster>(lamp("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5))).resolution = 512;
  expect_equal_resting_walks(13, 26, 0.6);
}

TEST_F(ShadowRegions, a_small_box_draws_few_texels_and_a_rested_scene_none) {
  world.get<ShadowCaster>(lamp("spot", LightKind::spot, dvec3(0.2, 0.1, 2.5))).resolution = 1024;
  add_movers();
  draw();
  EXPECT_EQ(counter("shadows.texels_drawn"), 1024.0 * 1024.0);
  draw();
  EXPECT_EQ(counter("shadows.texels_drawn"), 0.0) << "joints rest";
  EXPECT_EQ(counter("shadows.faces_cached"), 1.0);
  world.get<WorldTransform>(movers[0]).matrix[3].x += 0.01;
  draw();
  EXPECT_EQ(counter("shadows.faces_drawn"), 1.0);
  EXPECT_GT(counter("shadows.texels_drawn"), 0.0);
  EXPECT_LT(counter("shadows.texels_drawn"), 0.1 * 1024.0 * 1024.0);
  world.get<WorldTransform>(joints[1]).matrix = bar_at(0.4);
  draw();
  EXPECT_EQ(counter("shadows.faces_drawn"), 1.0) << "joints move";
  EXPECT_LT(counter("shadows.texels_drawn"), 0.2 * 1024.0 * 1024.0);
}

}  // namespace
}  // namespace gloam
