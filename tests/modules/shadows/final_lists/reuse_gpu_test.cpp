// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "modules/closeups/components.h"
#include "tests/modules/shadows/support/hard_shadows.h"

// shadows.reuse=exact and lighting.reuse=exact: pictures equal those of a renderer that keeps nothing, to the bit.

namespace gloam {
namespace {

/// One of two equal worlds.
struct Twin {
  World* world = nullptr;
  Renderer* renderer = nullptr;
  std::vector<Entity> things, lamps;
};

class ShadowReuse : public test::HardShadows {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HardShadows::SetUp());
    if (IsSkipped()) return;
    static test::SharedRenderer plain(make_all_modules());
    plain.warnings = &warnings;
    other_.emplace();
    plain.renderer->prepare_world(*other_);
    keeping_ = {&world, renderer.get(), {}, {}};
    plain_ = {&*other_, plain.renderer.get(), {}, {}};
    both("shadows.visibility_bits", "8");
    for (const char* knob : {"shadows.reuse", "lighting.reuse"})
      ASSERT_TRUE(plain_.renderer->knobs().set(knob, "off").ok());
    settings = test::look_at(dvec3(0.3, 2.2, 3.4), dvec3(0.0, 0.3, 0.0), 80, 56);
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
    test::SceneMaker maker(into);
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
    lamp(spot(40.0, 0.1f), at(-1.5, 1.5, 1.0) * test::turn_towards(dvec3(1.5, -1.3, -1.0)));
    lamp(sun(0.02f), test::turn_towards(dvec3(0.5, -0.8, -0.4)));
  }

  /// Draws both, and expects equal pictures.
  void draw_both(const std::string& what) {
    std::vector<float> pictures[2];
    std::size_t number = 0;
    each([&](Twin& twin) {
      const ViewRequest request{settings, {}};
      const Status drawn = twin.renderer->render(*twin.world, std::span(&request, 1));
      ASSERT_TRUE(drawn.ok()) << what << ": " << drawn.error().message;
      ASSERT_TRUE(twin.renderer->wait().ok());
      pictures[number++] = test::value_of(twin.renderer->read_linear(settings.id)).rgba;
    });
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

TEST_F(ShadowReuse, at_rest_everything_is_kept_and_only_what_changes_is_made_anew) {
  rest();
  const double all = counted_anew("shadows.tile_lights");
  // A flame flickers: its shadows stay.
  change_lamp(0, [](Light& l) { l.intensity *= 0.7f, l.color = vec3(1.0f, 0.8f, 0.5f); });
  draw_both("flicker");
  EXPECT_EQ(kept(), all);
  // A lamp moves: those of the others stay.
  move_lamp(2, dvec3(0.02, 0.0, 0.01));
  draw_both("lamp");
  EXPECT_GT(kept(), 0.3 * all);
  EXPECT_LT(kept(), all);
  rest();
  // What only the spot sees moves there and back.
  change_lamp(0, [](Light& l) { l.intensity = 0.0f; });
  draw_both("a lamp goes out");
  rest();
  move_thing(2, dvec3(0.0, 0.05, 0.0));
  draw_both("caster");
  EXPECT_LT(kept(), counted_anew("shadows.tile_lights"));
  move_thing(2, dvec3(0.0, -0.05, 0.0));
  draw_both("caster back");
  rest();
}

TEST_F(ShadowReuse, pixels_that_change_are_made_anew_though_no_light_sees_it) {
  // A pane above the floor that casts nothing: its depth, its normals and its material change, one at a time.
  std::vector<std::uint32_t> meshes;
  each([&](Twin& twin) {
    test::SceneMaker maker(*twin.world);
    Material waxen = exact_material(180, 170, 160, 255, 0);
    waxen.subsurface = true;
    const std::uint32_t plain = maker.material(exact_material(180, 170, 160, 255, 0)), wax = maker.material(waxen);
    Primitive smooth = test::quad(0.7f, plain);
    for (vec3& normal : smooth.normals) normal = glm::normalize(normal + vec3(0.4f, 0.0f, 0.0f));
    meshes = {maker.mesh(test::quad(0.7f, plain)), maker.mesh(smooth), maker.mesh(test::quad(0.7f, wax))};
    const Entity pane = twin.things.emplace_back(maker.draw(meshes[0], flat(0.05)));
    twin.world->get<MeshInstance>(pane).casts_shadows = false;
  });
  const std::size_t pane = 4;
  const auto show = [&](std::size_t mesh) {
    each([&](Twin& twin) {
      twin.world->get<MeshInstance>(twin.things[pane]).mesh = meshes[mesh];
      twin.world->mark_changed<MeshInstance>(twin.things[pane]);
    });
  };
  rest();
  const double all = counted_anew("shadows.tile_lights");
  const auto expect_some_anew = [&](const std::string& what) {
    draw_both(what);
    EXPECT_LT(kept(), all) << what;
    EXPECT_GT(kept(), 0.1 * all) << what;
    rest();
  };
  move_thing(pane, dvec3(0.0, 0.004, 0.0));
  expect_some_anew("depth");
  show(1);
  expect_some_anew("shading normal");
  show(0);
  expect_some_anew("shading normal, back");
  show(2);
  expect_some_anew("material");
  move_thing(pane, dvec3(0.3, 0.0, 0.0));
  expect_some_anew("edge");
}

TEST_F(ShadowReuse, light_that_changes_is_computed_anew_where_shadows_are_kept) {
  std::vector<std::uint32_t> meshes;
  each([&](Twin& twin) {
    test::SceneMaker maker(*twin.world);
    Material shining = exact_material(180, 170, 160, 255, 0);
    shining.emissive = vec3(3.0f, 1.0f, 0.2f);
    meshes.clear();
    for (const Material& material : {exact_material(180, 170, 160, 255, 0), exact_material(90, 170, 160, 255, 0),
                                     shining, exact_material(180, 170, 160, 255, 200)})
      meshes.push_back(maker.mesh(test::quad(0.25f, maker.material(material))));
    const Entity pane = twin.things.emplace_back(maker.draw(meshes[0], flat(0.05)));
    twin.world->get<MeshInstance>(pane).casts_shadows = false;
    twin.lamps.push_back(
        twin.world->create(point(0.05f), WorldTransform{at(-0.4, 0.5, 0.6)}, ShadowCaster{false, 128}));
  });
  for (int i = 0; i < 4; ++i) draw_both("at rest");
  const double tiles = lit_kept();  // those that show a surface
  EXPECT_GT(tiles, 40.0);
  const auto expect_some_anew = [&](const std::string& what) {
    draw_both(what);
    EXPECT_EQ(kept(), counted_anew("shadows.tile_lights") - counted_anew("shadows.tile_lights_unshadowed")) << what;
    EXPECT_LT(lit_kept(), tiles) << what;
    EXPECT_GT(lit_kept(), 0.0) << what;
    draw_both(what + ", at rest");
    EXPECT_EQ(lit_kept(), tiles) << what;
  };
  for (const std::size_t mesh : {1u, 2u, 3u, 0u}) {
    each([&](Twin& twin) {
      twin.world->get<MeshInstance>(twin.things[4]).mesh = meshes[mesh];
      twin.world->mark_changed<MeshInstance>(twin.things[4]);
    });
    expect_some_anew("material " + std::to_string(mesh));
  }
  change_lamp(4, [](Light& l) { l.range_m = 0.7f; });
  draw_both("a lamp without shadows");
  draw_both("at rest");
  change_lamp(4, [](Light& l) { l.color = vec3(1.0f, 0.2f, 0.1f); });
  expect_some_anew("colour of a lamp without shadows");
  change_lamp(4, [](Light& l) { l.width_m = 0.3f; });
  expect_some_anew("width of a lamp without shadows");
  each([](Twin& twin) { twin.world->resource<SceneEnvironment>().sky_zenith = vec3(0.3f, 0.1f, 0.2f); });
  draw_both("sky");
  EXPECT_EQ(lit_kept(), 0.0);
  draw_both("sky, at rest");
  draw_both("sky, at rest");
  EXPECT_EQ(lit_kept(), tiles);
}

TEST_F(ShadowReuse, a_camera_that_moves_keeps_nothing_and_costs_no_keys) {
  rest();
  for (int i = 0; i < 3; ++i) {
    settings.world_from_camera = at(0.01, 0.0, 0.0) * settings.world_from_camera;
    draw_both("moving");
    EXPECT_EQ(kept(), 0.0);
  }
  rest();
  settings.camera_cut = true;
  settings.world_from_camera = at(0.5, 0.0, 0.0) * settings.world_from_camera;
  draw_both("cut");
  EXPECT_EQ(kept(), 0.0);
  settings.camera_cut = false;
  rest();
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 1.5f;
  draw_both("orthographic");
  EXPECT_EQ(kept(), 0.0);
  rest();
  settings.width = 61;
  settings.height = 43;
  draw_both("resized");
  rest();
}

TEST_F(ShadowReuse, frames_that_are_given_up_and_read_again_change_nothing) {
  rest();
  move_thing(1, dvec3(0.1, 0.0, 0.0));
  give_up();
  draw_both("after a frame that was given up");
  give_up();
  move_lamp(0, dvec3(0.1, 0.0, 0.0));
  give_up();
  draw_both("after more");
  each([&](Twin& twin) {
    EXPECT_TRUE(
        twin.renderer->read_images(*twin.world, settings.id, std::vector<std::string_view>{"shadow_pyramid"}).ok());
  });
  draw_both("read again");
  rest();
}

TEST_F(ShadowReuse, knobs_of_the_filter_void_what_was_kept) {
  for (const auto& [knob, value] : {std::pair{"shadows.visibility_bits", "4"},
                                    {"shadows.bias_mm", "4"},
                                    {"shadows.slot_limit", "40"},
                                    {"shadows.slot_limit", "4194301"},
                                    {"shadows.mode", "off"},
                                    {"shadows.mode", "deferred"}}) {
    for (int i = 0; i < 3; ++i) draw_both("before " + std::string(knob));
    both(knob, value);
    has_lists_ = std::string_view(value) != "off";
    draw_both(std::string(knob) + "=" + value);
    if (std::string_view(knob) != "shadows.mode") {
      EXPECT_EQ(kept(), 0.0) << knob;
    }
    draw_both(std::string(knob) + "=" + value + ", again");
  }
}

TEST_F(ShadowReuse, two_hundred_random_changes) {
  std::mt19937 random(7);
  const auto some = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
  double all_kept = 0.0;
  int partly = 0;
  for (int i = 0; i < 200; ++i) {
    const dvec3 by(some(0.1), some(0.03), some(0.1));
    switch (const unsigned what = random() % 16; what) {
      case 0:
      case 1:
        move_thing(1 + random() % 3, by);
        break;
      case 2:
        move_lamp(random() % 4, by);
        break;
      case 3: {
        const auto factor = static_cast<float>(1.0 + some(0.5));
        const std::size_t lamp = random() % 4;
        change_lamp(lamp, [&](Light& l) { l.intensity *= factor; });
        break;
      }
      case 4: {
        const std::size_t lamp = random() % 3;
        change_lamp(lamp, [&](Light& l) { l.width_m = l.width_m > 0.05f ? 0.03f : 0.12f; });
        break;
      }
      case 5:
        settings.world_from_camera = glm::translate(dmat4(1.0), by) * settings.world_from_camera;
        break;
      case 6:
        give_up();
        break;
      case 7:
        if (random() % 4 == 0) both("shadows.filter", random() % 2 == 0 ? "pcss" : "chs");
        break;
      case 8: {
        const std::size_t lamp = random() % 3;
        change_lamp(lamp, [&](Light& l) { l.range_m = l.range_m > 2.0f ? 1.5f : 6.0f; });
        break;
      }
      default:
        break;
    }
    draw_both("change " + std::to_string(i));
    if (HasFailure()) break;
    all_kept += kept();
    if (kept() > 0.0 && filtered() > 0.0) ++partly;
  }
  EXPECT_GT(all_kept, 1000.0);
  EXPECT_GE(partly, 10) << "frames that keep some visibilities and make others";
}

/// The same with three close-up subjects: their maps, and what these take from visibilities, are kept as well.
class CloseupReuse : public ShadowReuse {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ShadowReuse::SetUp());
    if (IsSkipped()) return;
    both("closeups.max_pairs", "16");
    each([](Twin& twin) {
      for (std::size_t thing = 1; thing < 4; ++thing) twin.world->add(twin.things[thing], CloseupSubject{true});
    });
  }
  [[nodiscard]] double pairs() const { return count(plain_, "closeups.pairs"); }
  [[nodiscard]] double maps_drawn() const { return count(keeping_, "closeups.maps_drawn"); }
  void expect_drawn(double maps, const std::string& what) {
    draw_both(what);
    EXPECT_EQ(maps_drawn(), maps) << what;
    EXPECT_EQ(counted_anew("closeups.maps_drawn"), pairs()) << what;
  }
};

TEST_F(CloseupReuse, maps_of_subjects_that_hold_still_are_not_drawn_again) {
  rest();
  ASSERT_EQ(pairs(), 12.0) << "three subjects, four lights";
  expect_drawn(0.0, "at rest");
  change_lamp(0, [](Light& l) { l.intensity *= 0.7f; });
  expect_drawn(0.0, "flicker");
  move_thing(2, dvec3(0.0, 0.02, 0.0));
  expect_drawn(4.0, "one subject moves");
  move_lamp(0, dvec3(0.02, 0.0, 0.01));
  expect_drawn(3.0, "one lamp moves");
  change_lamp(1, [](Light& l) { l.width_m = 0.05f; });
  expect_drawn(3.0, "a lamp becomes wider");
  settings.world_from_camera = at(0.01, 0.0, 0.0) * settings.world_from_camera;
  expect_drawn(0.0, "the camera moves");
  each([](Twin& twin) {
    twin.world->get<MeshInstance>(twin.things[1]).mesh = twin.world->get<MeshInstance>(twin.things[2]).mesh;
    twin.world->mark_changed<MeshInstance>(twin.things[1]);
  });
  expect_drawn(4.0, "a subject changes its mesh");
  settings.width = 160;
  settings.height = 112;
  draw_both("resized");
  EXPECT_GT(maps_drawn(), 0.0) << "maps have other sizes";
  rest();
  expect_drawn(0.0, "at rest");
}

TEST_F(CloseupReuse, given_up_frames_cuts_and_other_views_change_nothing) {
  rest();
  move_thing(1, dvec3(0.1, 0.0, 0.0));
  give_up();
  expect_drawn(4.0, "after a frame that was given up");
  settings.camera_cut = true;
  settings.world_from_camera = at(0.5, 0.0, 0.0) * settings.world_from_camera;
  draw_both("cut");
  settings.camera_cut = false;
  each([&](Twin& twin) {
    EXPECT_TRUE(
        twin.renderer->read_images(*twin.world, settings.id, std::vector<std::string_view>{"shadow_pyramid"}).ok());
  });
  rest();
  expect_drawn(0.0, "read again");
  // Another view, with other sizes of maps, between frames of this one.
  const ViewSettings first = settings;
  for (int i = 0; i < 3; ++i) {
    settings.id = ViewId{7};
    settings.width = 200;
    settings.height = 120;
    draw_both("another view");
    settings = first;
    expect_drawn(0.0, "the view again");
  }
  for (std::size_t thing = 1; thing < 4; ++thing)
    each([&](Twin& twin) { twin.world->get<CloseupSubject>(twin.things[thing]).enabled = false; });
  draw_both("no subjects");
  for (std::size_t thing = 1; thing < 4; ++thing)
    each([&](Twin& twin) { twin.world->get<CloseupSubject>(twin.things[thing]).enabled = true; });
  move_thing(1, dvec3(-0.1, 0.0, 0.0));
  draw_both("subjects again");
  rest();
}

TEST_F(CloseupReuse, knobs_void_what_was_kept) {
  for (const auto& [knob, value] : {std::pair{"closeups.filter", "chs"},
                                    {"closeups.texels_per_pixel", "4"},
                                    {"closeups.batch", "2"},
                                    {"closeups.max_pairs", "5"},
                                    {"closeups.max_pairs", "0"},
                                    {"closeups.max_pairs", "16"},
                                    {"shadows.bias_units", "3"},
                                    {"closeups.standard", "draw"}}) {
    for (int i = 0; i < 3; ++i) draw_both("before " + std::string(knob));
    both(knob, value);
    for (int i = 0; i < 3; ++i) draw_both(std::string(knob) + "=" + value);
  }
}

TEST_F(CloseupReuse, two_hundred_random_changes) {
  std::mt19937 random(11);
  const auto some = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
  double all_kept = 0.0, all_maps = 0.0, drawn = 0.0;
  for (int i = 0; i < 200; ++i) {
    const dvec3 by(some(0.1), some(0.03), some(0.1));
    const std::size_t thing = 1 + random() % 3, lamp = random() % 4;
    switch (random() % 14) {
      case 0:
      case 1:
        move_thing(thing, by);
        break;
      case 2:
        move_lamp(lamp, by);
        break;
      case 3:
        change_lamp(lamp % 3, [&](Light& l) { l.width_m = l.width_m > 0.05f ? 0.03f : 0.12f; });
        break;
      case 4:
        settings.world_from_camera = glm::translate(dmat4(1.0), by) * settings.world_from_camera;
        break;
      case 5:
        give_up();
        break;
      case 6:
        each([&](Twin& twin) {
          bool& enabled = twin.world->get<CloseupSubject>(twin.things[thing]).enabled;
          enabled = !enabled;
        });
        break;
      case 7:
        both("closeups.max_pairs", std::to_string(3 + random() % 10));
        break;
      default:
        break;
    }
    draw_both("change " + std::to_string(i));
    if (HasFailure()) break;
    all_kept += kept();
    for (const auto& [name, value] : plain_.renderer->report().counters)
      if (name == "closeups.pairs") all_maps += value, drawn += maps_drawn();
  }
  EXPECT_GT(all_kept, 1000.0);
  EXPECT_LT(drawn, 0.5 * all_maps);
}

}  // namespace
}  // namespace gloam
