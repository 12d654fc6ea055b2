// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/modules/shadows/support/hard_shadows.h"

namespace gloam::test {

/// One of two equal worlds.
struct Twin {
  World* world = nullptr;
  Renderer* renderer = nullptr;
  std::vector<Entity> things, lamps;
};

/// Draws equal worlds with a renderer that keeps what has not changed and with one that keeps nothing.
class ReuseTwins : public HardShadows {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HardShadows::SetUp());
    if (IsSkipped()) return;
    static SharedRenderer plain(make_all_modules());
    plain.warnings = &warnings;
    other_.emplace();
    plain.renderer->prepare_world(*other_);
    keeping_ = {&world, renderer.get(), {}, {}};
    plain_ = {&*other_, plain.renderer.get(), {}, {}};
    both("shadows.visibility_bits", "8");
    both("scene.reuse", "off");  // only parts of frames are kept
    for (const char* knob : {"shadows.reuse", "lighting.reuse"})
      ASSERT_TRUE(plain_.renderer->knobs().set(knob, "off").ok());
    settings = look_at(dvec3(0.3, 2.2, 3.4), dvec3(0.0, 0.3, 0.0), 80, 56);
    each([this](Twin& twin) { build(twin); });
  }
  void TearDown() override {
    if (other_) {
      const std::vector<Knob> knobs = plain_.renderer->knobs().knobs();
      for (const Knob& knob : knobs)
        EXPECT_TRUE(plain_.renderer->knobs().set(knob.name, value_text(knob, knob.default_number)).ok());
      plain_.renderer->release_world(*other_);
      other_.reset();
    }
    HardShadows::TearDown();
  }

  template <class Change>
  void each(Change&& change) {
    change(keeping_);
    change(plain_);
  }
  void both(const std::string& knob, const std::string& value) {
    each([&](Twin& twin) { EXPECT_TRUE(twin.renderer->knobs().set(knob, value).ok()) << knob; });
  }
  static void build(Twin& twin) {
    World& into = *twin.world;
    SceneMaker maker(into);
    into.resource<SceneEnvironment>().has_exposure = true;
    const std::uint32_t plain = maker.material(exact_material(180, 170, 160, 255, 0));
    Material thin = exact_material(150, 180, 90, 255, 0);
    thin.subsurface = true;
    const std::uint32_t skin = maker.material(thin);
    twin.things.push_back(maker.draw(maker.mesh(test::quad(3.0f, plain)), flat(0.0)));
    twin.things.push_back(maker.draw(maker.mesh(test::box(vec3(0.2f), plain)), at(-0.6, 0.2, 0.1)));
    twin.things.push_back(maker.draw(maker.mesh(test::ball(0.15f, plain)), at(0.5, 0.5, 0.0)));
    twin.things.push_back(maker.draw(maker.mesh(test::box(vec3(0.1f, 0.2f, 0.05f), skin)), at(0.0, 0.2, 0.9)));
    const auto lamp = [&](const Light& light, const dmat4& where) {
      twin.lamps.push_back(into.create(light, WorldTransform{where}, ShadowCaster{true, 128}));
    };
    lamp(point(0.1f), at(0.2, 1.8, 0.4));
    lamp(point(0.0f), at(-1.4, 0.7, -0.8));
    lamp(spot(40.0, 0.1f), at(-1.5, 1.5, 1.0) * turn_towards(dvec3(1.5, -1.3, -1.0)));
    lamp(sun(0.02f), turn_towards(dvec3(0.5, -0.8, -0.4)));
  }

  /// Draws both. pictures: that of the keeping renderer, then the other one.
  void draw_pictures(const std::string& what, std::array<std::vector<float>, 2>& pictures) {
    std::size_t number = 0;
    each([&](Twin& twin) {
      const ViewRequest request{settings, {}};
      const Status drawn = twin.renderer->render(*twin.world, std::span(&request, 1));
      ASSERT_TRUE(drawn.ok()) << what << ": " << drawn.error().message;
      ASSERT_TRUE(twin.renderer->wait().ok());
      pictures[number++] = value_of(twin.renderer->read_linear(settings.id)).rgba;
    });
  }
  /// Draws both, and expects equal pictures.
  void draw_both(const std::string& what) {
    std::array<std::vector<float>, 2> pictures;
    ASSERT_NO_FATAL_FAILURE(draw_pictures(what, pictures));
    EXPECT_EQ(pictures[0], pictures[1]) << what;
    if (has_lists_) {
      EXPECT_EQ(counted_anew("shadows.tile_lights_kept"), 0.0);
    }
  }
  void give_up() {
    ViewRequest lost{settings, {}};
    lost.target.overlay = [](FrameGraph&, ImageRef&) -> Status { return Error{ErrorKind::failed, "given up"}; };
    each([&](Twin& twin) { EXPECT_FALSE(twin.renderer->render(*twin.world, std::span(&lost, 1)).ok()); });
  }
  [[nodiscard]] static double count(const Twin& twin, const std::string& name) {
    for (const auto& [found, value] : twin.renderer->report().counters)
      if (found == name) return value;
    ADD_FAILURE() << "no counter " << name;
    return 0.0;
  }
  /// Tiles that kept their light; 0 in frames that compared none.
  [[nodiscard]] double lit_kept() const {
    for (const auto& [found, value] : keeping_.renderer->report().counters)
      if (found == "lighting.tiles_kept") return value;
    return 0.0;
  }
  [[nodiscard]] double kept() const { return count(keeping_, "shadows.tile_lights_kept"); }
  [[nodiscard]] double filtered() const { return count(keeping_, "shadows.tile_lights_filtered"); }
  [[nodiscard]] double counted_anew(const std::string& name) const { return count(plain_, name); }
  /// Draws until everything is kept, or fails.
  void rest() {
    for (int i = 0; i < 6; ++i) draw_both("at rest, frame " + std::to_string(i));
    EXPECT_EQ(filtered(), 0.0);
    EXPECT_EQ(kept(), counted_anew("shadows.tile_lights"));
  }
  void move_thing(std::size_t thing, const dvec3& by) {
    each([&](Twin& twin) {
      WorldTransform& where = twin.world->get<WorldTransform>(twin.things[thing]);
      where.matrix = glm::translate(dmat4(1.0), by) * where.matrix;
      twin.world->mark_changed<WorldTransform>(twin.things[thing]);
    });
  }
  void move_lamp(std::size_t lamp, const dvec3& by) {
    each([&](Twin& twin) {
      WorldTransform& where = twin.world->get<WorldTransform>(twin.lamps[lamp]);
      where.matrix = glm::translate(dmat4(1.0), by) * where.matrix;
      twin.world->mark_changed<WorldTransform>(twin.lamps[lamp]);
    });
  }
  template <class Change>
  void change_lamp(std::size_t lamp, Change&& change) {
    each([&](Twin& twin) {
      change(twin.world->get<Light>(twin.lamps[lamp]));
      twin.world->mark_changed<Light>(twin.lamps[lamp]);
    });
  }

  bool has_lists_ = true;  ///< frames have final lists
  std::optional<World> other_;
  Twin keeping_, plain_;
};

}  // namespace gloam::test
