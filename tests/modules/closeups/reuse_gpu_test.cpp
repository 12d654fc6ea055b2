// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/scene/resources.h"
#include "modules/closeups/components.h"
#include "tests/modules/shadows/support/reuse_twins.h"

// shadows.reuse=exact with close-ups: maps of subjects that hold still, and visibilities that they have lowered, are
// kept. Pictures equal those of a renderer that keeps nothing, to the bit.

namespace gloam {
namespace {

using test::Twin;

/// A world with three close-up subjects.
class CloseupReuse : public test::ReuseTwins {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ReuseTwins::SetUp());
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
                                    {"closeups.texels_per_pixel", "8"},  // not all maps find room
                                    {"closeups.texels_per_pixel", "2"},
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

TEST_F(CloseupReuse, a_subject_that_is_posed_otherwise_is_drawn_again) {
  each([](Twin& twin) {
    test::SceneMaker maker(*twin.world);
    Primitive box = test::box(vec3(0.1f), maker.material(exact_material(180, 170, 160, 255, 0)));
    box.morph_targets.push_back({std::vector<vec3>(box.positions.size(), vec3(0.05f, 0.1f, 0.0f)), {}});
    const Entity thing = twin.things.emplace_back(maker.draw(maker.mesh(std::move(box)), at(-0.2, 0.3, -0.5)));
    twin.world->add(thing, MorphInstance{0, 1});
    twin.world->add(thing, CloseupSubject{true});
    twin.world->resource<MorphWeights>().values = {0.0f};
  });
  rest();
  expect_drawn(0.0, "at rest");
  for (const float weight : {0.4f, 0.8f, 0.0f}) {
    each([&](Twin& twin) { twin.world->resource<MorphWeights>().values = {weight}; });
    expect_drawn(4.0, "posed");
    expect_drawn(0.0, "at rest again");
  }
}

TEST_F(CloseupReuse, surfaces_that_are_shaded_from_standard_maps_see_kept_maps) {
  each([](Twin& twin) {
    test::SceneMaker maker(*twin.world);
    Material glass = exact_material(180, 170, 160, 255, 0);
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.a = 0.5f;
    twin.things.push_back(maker.draw(maker.mesh(test::quad(1.5f, maker.material(glass))), flat(0.02)));
  });
  for (int i = 0; i < 4; ++i) draw_both("at rest");
  EXPECT_EQ(maps_drawn(), 0.0);
  move_thing(4, dvec3(0.0, 0.05, 0.0));
  draw_both("the pane moves");
  move_thing(2, dvec3(0.0, 0.05, 0.0));
  draw_both("a subject moves");
  EXPECT_LT(maps_drawn(), pairs());
  both("closeups.standard", "draw");
  for (int i = 0; i < 3; ++i) draw_both("closeups.standard=draw");
  both("closeups.standard", "transfer");
  for (int i = 0; i < 3; ++i) draw_both("closeups.standard=transfer");
  EXPECT_EQ(maps_drawn(), 0.0);
}

TEST_F(CloseupReuse, two_views_of_a_frame_keep_maps_of_their_own) {
  ViewSettings other = settings;
  other.id = ViewId{9};
  other.width = 136;
  other.height = 104;
  other.world_from_camera = at(0.4, 0.1, -0.2) * other.world_from_camera;
  other.camera.orthographic = true;
  other.camera.half_height_m = 1.5f;
  for (int i = 0; i < 12; ++i) {
    if (i == 5) move_thing(1, dvec3(0.05, 0.0, 0.02));
    if (i == 7) move_lamp(3, dvec3(0.0, 0.1, 0.0));
    if (i == 9) other.world_from_camera = at(0.02, 0.0, 0.0) * other.world_from_camera;
    std::vector<float> pictures[2][2];
    std::size_t number = 0;
    each([&](Twin& twin) {
      const ViewRequest requests[] = {{settings, {}}, {other, {}}};
      ASSERT_TRUE(twin.renderer->render(*twin.world, requests).ok());
      ASSERT_TRUE(twin.renderer->wait().ok());
      pictures[number][0] = test::value_of(twin.renderer->read_linear(settings.id)).rgba;
      pictures[number++][1] = test::value_of(twin.renderer->read_linear(other.id)).rgba;
    });
    EXPECT_EQ(pictures[0][0], pictures[1][0]) << "frame " << i;
    EXPECT_EQ(pictures[0][1], pictures[1][1]) << "other view, frame " << i;
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
