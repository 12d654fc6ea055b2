// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/modules/shadows/support/hard_shadows.h"

namespace gloam {
namespace {

/// Maps that are kept from frame to frame, with all settings.
class ShadowKept : public test::HardShadows {
 protected:
  [[nodiscard]] double drawn_faces() const { return counter("shadows.faces_drawn") + counter("shadows.faces_skipped"); }

  /// The same scene, drawn by a renderer without earlier frames.
  [[nodiscard]] std::vector<float> fresh(const dmat4& where) {
    World own;
    RendererOptions options;
    options.device = test::shared_device();
    options.executor = executor.get();
    options.log = &log;
    options.modules = make_modules();
    const auto other = test::value_of(Renderer::create(std::move(options)));
    other->prepare_world(own);
    own.get<WorldTransform>(fill(own)).matrix = where;
    const ViewRequest request{settings, {}};
    EXPECT_TRUE(other->render(own, std::span(&request, 1)).ok());
    EXPECT_TRUE(other->wait().ok());
    return test::value_of(other->read_linear(settings.id)).rgba;
  }
};

TEST_F(ShadowKept, while_a_caster_moves_and_returns_pictures_are_those_of_a_fresh_renderer) {
  const Entity mover = fill(world);
  set("shadows.visibility_bits", "8");
  const auto where = [](int frame) {
    const double along = frame < 12 ? frame : 20 - frame;  // forward for twelve frames, back in eight
    return at(0.5 + 0.07 * along, 0.5 + 0.02 * along, -0.05 * along);
  };
  std::vector<float> first;
  double cached = 0.0;
  for (int frame = 0; frame <= 20; ++frame) {
    place(mover, frame == 20 ? where(0) : where(frame));
    const LinearPicture now = drawn();
    if (frame > 0) cached += counter("shadows.faces_cached");
    if (frame == 0) first = now.rgba;
    if (frame == 16) {
      EXPECT_EQ(now.rgba, fresh(where(frame))) << frame;
    } else if (frame == 20) {
      EXPECT_EQ(now.rgba, first);
    }
  }
  EXPECT_GT(cached, 20.0);
  EXPECT_EQ(first, fresh(where(0)));
}

TEST_F(ShadowKept, a_skinned_caster_is_drawn_anew_where_it_is_seen_when_its_joints_move) {
  floor();
  box(dvec3(-0.8, 0.3, 0.0), dvec3(0.1));
  const dmat4 base = at(0.9, 0.2, 0.0) * glm::scale(dmat4(1.0), dvec3(0.15));
  const dmat4 upper = base * at(0.0, 2.0, 0.0);
  scene.node(0, base);
  const Entity joint = scene.node(1, upper);
  scene.assets().skins.push_back({"bar", {0, 1}, {mat4(1.0f), glm::translate(mat4(1.0f), vec3(0.0f, -2.0f, 0.0f))}});
  world.create(WorldTransform{base}, MeshInstance{scene.mesh(test::skinned_bar(stone)), 0});
  const Entity bulb = lamp(point(), dvec3(0.0, 0.5, 0.0), dvec3(0.0, -1.0, 0.0), 512);
  settings = test::look_at(dvec3(0.6, 2.2, 2.4), dvec3(0.6, 0.1, 0.0), 96, 54);
  draw();
  EXPECT_EQ(drawn_faces(), 6.0);
  draw();
  EXPECT_EQ(drawn_faces(), 0.0) << "its joints are where they were";
  for (int frame = 1; frame <= 3; ++frame) {
    place(joint, upper * glm::rotate(dmat4(1.0), 0.1 * frame, dvec3(1.0, 0.0, 0.0)));
    draw();
    EXPECT_GE(counter("shadows.faces_drawn"), 1.0);
    EXPECT_GE(counter("shadows.faces_cached"), 3.0);
  }
  place(joint, upper);
  expect_right("skinned", bulb);
  place(joint, upper * glm::rotate(dmat4(1.0), 1.0, dvec3(1.0, 0.0, 0.0)));
  expect_right("skinned, bent", bulb);
}

TEST_F(ShadowKept, a_light_that_moves_redraws_only_its_own_faces) {
  floor();
  box(dvec3(0.0, 0.3, 0.0), dvec3(0.1));
  const Entity mover = lamp(point(), dvec3(0.5, 1.0, 0.0), dvec3(0.0, -1.0, 0.0), 128);
  lamp(point(), dvec3(-0.5, 1.0, 0.0), dvec3(0.0, -1.0, 0.0), 128);
  lamp(spot(30.0), dvec3(-0.5, 1.5, 0.5), dvec3(0.3, -1.0, -0.2), 128);
  draw();
  EXPECT_EQ(drawn_faces(), 13.0);
  draw();
  EXPECT_EQ(drawn_faces(), 0.0);
  place(mover, at(0.52, 1.0, 0.0));
  draw();
  EXPECT_EQ(drawn_faces(), 6.0);
  EXPECT_EQ(counter("shadows.faces_cached"), 7.0);
  draw();
  EXPECT_EQ(drawn_faces(), 0.0);
  // A change of brightness or width is no movement: maps stay valid.
  world.get<Light>(mover).intensity = 33.0f;
  draw();
  EXPECT_EQ(drawn_faces(), 0.0);
}

/// A full atlas, with a renderer that has not logged a warning yet.
class FullAtlas : public ShadowKept {
 protected:
  [[nodiscard]] test::SharedRenderer& shared() override {
    static test::SharedRenderer made(make_modules());
    return made;
  }
};

// Hard case: shadows.full_atlas
TEST_F(FullAtlas, shrinks_faces_says_so_once_and_gives_them_back) {
  yard();
  set("shadows.atlas", "1024");
  const Entity stays = lamp(point(), dvec3(-1.3, 1.9, 1.1), dvec3(0.0, -1.0, 0.0), 256);
  const LinearPicture before = drawn();
  EXPECT_EQ(counter("shadows.faces_shrunk"), 0.0);
  std::vector<Entity> more;
  for (int i = 0; i < 24; ++i)
    more.push_back(
        lamp(point(), dvec3(1.6 * std::sin(i), 1.2 + 0.05 * i, 1.6 * std::cos(i)), dvec3(0.0, -1.0, 0.0), 512));
  for (int frame = 0; frame < 3; ++frame) draw();
  EXPECT_GT(counter("shadows.faces_shrunk"), 0.0);
  EXPECT_EQ(counter("shadows.faces_left_out"), 0.0);
  EXPECT_EQ(counter("shadows.casting_lights"), 25.0);
  EXPECT_EQ(warnings.size(), 1u);
  expect_finite("full atlas");
  const TracedVisibility traced = trace(1);
  for (const Entity lamp : {stays, more[0], more[11], more[23]}) {
    const ShadowError e = error(lamp, traced);
    print("full atlas", e);
    EXPECT_LE(e.mean(), 0.1);
    EXPECT_LE(e.wrong_share(), 0.05);
    EXPECT_LE(e.acne_share(), 0.01);
  }
  for (const Entity lamp : more) world.destroy(lamp);
  const LinearPicture after = drawn();
  EXPECT_EQ(counter("shadows.faces_shrunk"), 0.0);
  EXPECT_EQ(after.rgba, before.rgba);
  EXPECT_EQ(warnings.size(), 1u);
}

TEST_F(ShadowKept, tiles_show_what_all_lights_show_in_wide_shadows) {
  yard();
  for (int i = 0; i < 6; ++i)
    lamp(i % 2 == 0 ? point(0.1f * static_cast<float>(i)) : spot(40.0, 0.1f), dvec3(0.5 * i - 1.4, 1.6, 0.3 * i - 0.8),
         dvec3(0.2, -1.0, 0.1), 128);
  lamp(sun(0.05f), dvec3(0.0), dvec3(0.5, -0.6, -0.4), 512);
  set("shadows.visibility_bits", "8");
  set("lights.culling", "tiled");
  const LinearPicture tiled = drawn();
  set("lights.culling", "brute");
  EXPECT_EQ(tiled.rgba, drawn().rgba);
}

TEST_F(ShadowKept, glass_is_in_the_shadow_that_an_opaque_pane_is_in) {
  Material glass = exact_material(200, 200, 200, 255, 0);
  glass.alpha_mode = AlphaMode::blend;
  glass.base_color.a = 0.5f;
  const Entity pane = thing(test::quad(1.0f, scene.material(glass)));
  const Entity opaque =
      thing(test::quad(1.0f, scene.material(exact_material(200, 200, 200, 255, 0))), at(0.0, 0.0, -90.0));
  box(dvec3(0.0, 0.0, 0.5), dvec3(0.25, 0.2, 0.05));
  const std::vector<Entity> lamps = {lamp(point(0.2f), dvec3(0.3, 0.4, 1.5), dvec3(0.0, 0.0, -1.0)),
                                     lamp(spot(35.0, 0.1f), dvec3(-0.5, 0.5, 1.6), dvec3(0.3, -0.3, -1.0)),
                                     lamp(sun(0.1f), dvec3(0.0), dvec3(0.3, 0.2, -1.0))};
  settings = test::look_at(dvec3(0.9, 0.7, 1.2), dvec3(0.0), 96, 54);
  for (const Entity lit : lamps) {
    for (const Entity lamp : lamps) world.get<Light>(lamp).intensity = lamp == lit ? 10.0f : 0.0f;
    std::vector<float> shares[2];  // share of the light that shadows leave
    for (const bool blended : {true, false}) {
      place(pane, at(0.0, 0.0, blended ? 0.0 : -90.0));
      place(opaque, at(0.0, 0.0, blended ? -90.0 : 0.0));
      set("shadows.mode", "monolithic");
      const LinearPicture with = drawn();
      set("shadows.mode", "off");
      const LinearPicture without = drawn();
      for (std::size_t i = 0; i < with.rgba.size(); i += 4)
        shares[blended ? 0 : 1].push_back(without.rgba[i] > 1e-4f ? with.rgba[i] / without.rgba[i] : -1.0f);
    }
    double sum = 0.0;
    std::size_t count = 0, soft = 0, far_off = 0;
    for (std::size_t i = 0; i < shares[0].size(); ++i) {
      if (shares[0][i] < 0.0f || shares[1][i] < 0.0f) continue;
      const double off = std::abs(static_cast<double>(shares[0][i]) - static_cast<double>(shares[1][i]));
      sum += off;
      far_off += off > 0.1 ? 1 : 0;
      soft += shares[1][i] > 0.05f && shares[1][i] < 0.95f ? 1 : 0;
      ++count;
    }
    std::printf("glass, %s: %zu pixels, %zu in penumbrae, mean %.5f, %zu off by more than a tenth\n",
                name_of(lit).c_str(), count, soft, sum / static_cast<double>(count), far_off);
    EXPECT_GT(count, 1500u);
    EXPECT_GT(soft, 100u);
    EXPECT_LE(sum, 0.005 * static_cast<double>(count));
    EXPECT_LE(far_off, count / 200);
  }
}

}  // namespace
}  // namespace gloam
