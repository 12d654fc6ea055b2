// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/render/readback/capture.h"
#include "engine/scene/assets.h"
#include "tests/modules/shadows/support/reuse_twins.h"

// scene.reuse=exact: frames that are kept as a whole equal those of a renderer that keeps nothing, to the bit.

namespace gloam {
namespace {

using test::Twin;

class WholeFrameReuse : public test::ReuseTwins {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ReuseTwins::SetUp());
    if (IsSkipped()) return;
    ASSERT_TRUE(keeping_.renderer->knobs().set("scene.reuse", "exact").ok());
  }
  [[nodiscard]] bool kept() const { return keeping_.renderer->report().kept; }
  void rest(const std::string& after) {
    for (int i = 0; i < 8; ++i) draw_both(after + ", at rest, frame " + std::to_string(i));
    EXPECT_TRUE(kept()) << after;
  }
  /// Changes something, draws, and expects that the frame was drawn and comes to rest.
  template <class Change>
  void expect_drawn(const std::string& what, Change&& change) {
    change();
    draw_both(what);
    EXPECT_FALSE(kept()) << what;
    rest(what);
  }
  /// Changes the material of a box.
  void paint(const vec4& color) {
    each([&](Twin& twin) {
      auto& assets = twin.world->resource<SceneAssets>();
      const std::uint32_t mesh = twin.world->get<MeshInstance>(twin.things[1]).mesh;
      const std::uint32_t material = assets.meshes[mesh].primitives.front().material;
      assets.materials[material].base_color = color;
      assets.mark_changed(AssetKind::material, material);
    });
  }
};

TEST_F(WholeFrameReuse, what_changes_is_drawn_and_what_rests_is_kept) {
  auto counted = keeping_.renderer->report().counters;
  for (int i = 0; i < 8 && !kept(); ++i) {
    counted = keeping_.renderer->report().counters;
    draw_both("new scene");
  }
  const FrameReport report = keeping_.renderer->report();
  EXPECT_TRUE(report.kept);
  EXPECT_FALSE(plain_.renderer->report().kept);
  EXPECT_FALSE(report.passes.empty()) << "those of the last frame that was drawn";
  EXPECT_EQ(counted.at("scene.kept"), 0.0);
  counted["scene.kept"] = 1.0;
  EXPECT_EQ(report.counters, counted);

  expect_drawn("caster", [&] { move_thing(1, dvec3(0.1, 0.0, 0.0)); });
  expect_drawn("lamp", [&] { move_lamp(0, dvec3(0.0, 0.1, 0.0)); });
  expect_drawn("flicker", [&] { change_lamp(0, [](Light& l) { l.intensity *= 0.7f; }); });
  expect_drawn("camera", [&] { settings.world_from_camera = at(0.02, 0.0, 0.0) * settings.world_from_camera; });
  expect_drawn("sky", [&] {
    each([](Twin& twin) { twin.world->resource<SceneEnvironment>().sky_zenith = vec3(0.3f, 0.1f, 0.2f); });
  });
  expect_drawn("exposure",
               [&] { each([](Twin& twin) { twin.world->resource<SceneEnvironment>().exposure_ev100 += 0.5f; }); });
  expect_drawn("size", [&] { settings.width += 5; });
  expect_drawn("knob", [&] { both("lighting.tone_map", "reinhard"); });
  expect_drawn("colour of a material", [&] { paint(vec4(0.2f, 0.6f, 0.3f, 1.0f)); });
  expect_drawn("a new light",
               [&] { each([](Twin& twin) { twin.world->create(point(0.05f), WorldTransform{at(0.4, 0.6, 0.6)}); }); });
}

TEST_F(WholeFrameReuse, frames_with_other_owners_or_knobs_are_drawn) {
  rest("new scene");
  for (const char* knob : {"scene.reuse", "shadows.reuse", "lighting.reuse"}) {
    ASSERT_TRUE(keeping_.renderer->knobs().set(knob, "off").ok());
    for (int i = 0; i < 7; ++i) {
      draw_both(knob);
      EXPECT_FALSE(kept()) << knob;
    }
    ASSERT_TRUE(keeping_.renderer->knobs().set(knob, "exact").ok());
    rest(knob);
  }
  // The caller draws over the picture.
  ViewRequest covered{settings, {}};
  covered.target.overlay = [](FrameGraph&, ImageRef&) -> Status { return {}; };
  for (int i = 0; i < 7; ++i) {
    ASSERT_TRUE(keeping_.renderer->render(world, std::span(&covered, 1)).ok());
    EXPECT_FALSE(kept());
  }
  rest("after overlays");
}

TEST_F(WholeFrameReuse, an_image_that_only_the_view_writes_is_kept) {
  gpu::Device& device = *test::shared_device();
  const auto make = [&] {
    return test::value_of(
        device.create_image({.name = "window",
                             .module = "test",
                             .format = gpu::Format::rgba8_unorm,
                             .width = settings.width,
                             .height = settings.height,
                             .usage = gpu::ImageUsage::color_target | gpu::ImageUsage::transfer_source}));
  };
  std::array images = {make(), make()};
  const auto draw_into_images = [&](const std::string& what, bool keeps) {
    std::array<std::vector<std::byte>, 2> shown;
    std::size_t number = 0;
    each([&](Twin& twin) {
      ViewRequest request{settings, {}};
      request.target.image = images[number];
      request.target.keeps_image = keeps;
      request.target.after = gpu::Access::transfer_read;
      ASSERT_TRUE(twin.renderer->render(*twin.world, std::span(&request, 1)).ok()) << what;
      ASSERT_TRUE(twin.renderer->wait().ok());
      shown[number] = test::value_of(read_image_now(device, images[number]));
      ++number;
    });
    EXPECT_EQ(shown[0], shown[1]) << what;
  };
  const auto rest_in_images = [&](const std::string& after) {
    for (int i = 0; i < 8; ++i) draw_into_images(after, true);
    EXPECT_TRUE(kept()) << after;
  };
  rest_in_images("new scene");
  move_thing(1, dvec3(0.1, 0.0, 0.0));
  draw_into_images("caster", true);
  EXPECT_FALSE(kept());
  rest_in_images("caster");
  device.destroy(images[0]);
  images[0] = make();
  draw_into_images("another image", true);
  EXPECT_FALSE(kept()) << "nothing is in it yet";
  rest_in_images("another image");
  draw_both("the renderer's own picture");
  EXPECT_FALSE(kept());
  rest_in_images("after the renderer's own picture");
  for (int i = 0; i < 7; ++i) {
    draw_into_images("an image that others may write", false);
    EXPECT_FALSE(kept());
  }
  for (const gpu::ImageHandle image : images) device.destroy(image);
}

TEST_F(WholeFrameReuse, what_goes_to_and_fro_is_drawn) {
  rest("new scene");
  for (int i = 0; i < 14; ++i) {
    move_thing(1, dvec3(i % 2 == 0 ? 0.1 : -0.1, 0.0, 0.0));
    draw_both("to and fro, frame " + std::to_string(i));
    EXPECT_FALSE(kept()) << i;
  }
  // Two pictures in turn.
  for (int i = 0; i < 14; ++i) {
    settings.world_from_camera = at(i % 2 == 0 ? 0.1 : -0.1, 0.0, 0.0) * settings.world_from_camera;
    draw_both("camera to and fro, frame " + std::to_string(i));
    EXPECT_FALSE(kept()) << i;
  }
  rest("at last");
}

TEST_F(WholeFrameReuse, pictures_that_accumulate_are_drawn) {
  both("lighting.antialiasing", "taa");
  for (int i = 0; i < 24; ++i) {
    draw_both("taa " + std::to_string(i));
    EXPECT_FALSE(kept()) << i;
  }
}

TEST_F(WholeFrameReuse, reading_and_giving_up_frames_changes_nothing) {
  rest("new scene");
  give_up();
  draw_both("after a frame that was given up");
  rest("given up");
  each([&](Twin& twin) {
    EXPECT_TRUE(
        twin.renderer->read_images(*twin.world, settings.id, std::vector<std::string_view>{"shadow_pyramid"}).ok());
  });
  rest("read again");
  move_thing(1, dvec3(0.1, 0.0, 0.0));
  give_up();
  draw_both("after a frame with a change was given up");
  rest("given up with a change");
  each([](Twin& twin) { twin.renderer->free_idle_memory(); });
  rest("freed memory");
}

TEST_F(WholeFrameReuse, a_second_view_comes_and_goes) {
  const auto two_views = [&](double turn) {
    ViewSettings other = settings;
    other.id = ViewId{5};
    other.world_from_camera = at(turn, 0.2, 0.1) * other.world_from_camera;
    const std::array<ViewRequest, 2> requests = {ViewRequest{settings, {}}, ViewRequest{other, {}}};
    std::vector<float> pictures[2];
    std::size_t number = 0;
    each([&](Twin& twin) {
      ASSERT_TRUE(twin.renderer->render(*twin.world, requests).ok());
      ASSERT_TRUE(twin.renderer->wait().ok());
      for (const ViewRequest& request : requests) {
        const auto picture = test::value_of(twin.renderer->read_linear(request.settings.id)).rgba;
        pictures[number].insert(pictures[number].end(), picture.begin(), picture.end());
      }
      ++number;
    });
    EXPECT_EQ(pictures[0], pictures[1]);
  };
  rest("one view");
  two_views(0.1);
  EXPECT_FALSE(kept());
  for (int i = 0; i < 7; ++i) two_views(0.1);
  EXPECT_TRUE(kept());
  two_views(0.2);
  EXPECT_FALSE(kept());
  for (int i = 0; i < 7; ++i) two_views(0.2);
  rest("one view again");
  each([](Twin& twin) { twin.renderer->release_view(*twin.world, ViewId{5}); });
  rest("released");
}

TEST_F(WholeFrameReuse, random_changes_and_rests) {
  std::mt19937 random(11);
  const auto some = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
  int frames_kept = 0;
  for (int change = 0; change < 40 && !HasFailure(); ++change) {
    const dvec3 by(some(0.1), some(0.03), some(0.1));
    switch (random() % 9) {
      case 0:
        move_thing(1 + random() % 3, by);
        break;
      case 1:
        move_lamp(random() % 4, by);
        break;
      case 2: {
        const auto factor = static_cast<float>(1.0 + some(0.5));
        const std::size_t lamp = random() % 4;
        change_lamp(lamp, [&](Light& l) { l.intensity *= factor; });
        break;
      }
      case 3:
        settings.world_from_camera = glm::translate(dmat4(1.0), by) * settings.world_from_camera;
        break;
      case 4:
        give_up();
        break;
      case 5:
        both("scene.culling", random() % 2 == 0 ? "frustum" : "occlusion");
        break;
      case 6:
        paint(vec4(0.5f + static_cast<float>(some(0.4)), 0.5f, 0.5f, 1.0f));
        break;
      case 7:
        settings.height = 50 + random() % 8;
        break;
      default:
        settings.camera_cut = true;
        break;
    }
    for (std::size_t rests = 1 + random() % 9; rests > 0 && !HasFailure(); --rests) {
      draw_both("change " + std::to_string(change));
      settings.camera_cut = false;
      frames_kept += kept() ? 1 : 0;
    }
  }
  EXPECT_GE(frames_kept, 30);
}

}  // namespace
}  // namespace gloam
