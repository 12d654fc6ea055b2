// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/particles/components.h"
#include "tests/modules/lighting/antialiasing/antialiased_frame.h"

namespace gloam {
namespace {

/// lighting.antialiasing=taa. One metre is 20 pixels, as in AntialiasedFrame.
struct AccumulatedFrame : test::AntialiasedFrame {
  /// A plane that glows as bright as `glow`, at a place, turned by an angle.
  Entity plane(float glow, const dvec3& at, const glm::dvec2& half, double angle = 0.0) {
    Material material{.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f), .metallic = 0.0f, .roughness = 1.0f};
    material.emissive = vec3(glow);
    const dmat4 turned = glm::rotate(glm::translate(dmat4(1.0), at), angle, dvec3(0.0, 0.0, 1.0));
    return scene.draw(scene.mesh(test::quad(1.0f, scene.material(material))), glm::scale(turned, dvec3(half, 1.0)));
  }
  /// Slanted edges, wires down to 0.3 pixels, and a wall of stripes behind them.
  void wires_before_stripes() {
    for (int i = 0; i < 9; ++i) plane(0.12f, {-2.2 + 0.55 * i, 0.0, -0.5}, {0.15, 2.0}, 0.06);
    for (int i = 0; i < 5; ++i) plane(0.8f, {-1.2 + 0.6 * i, 0.2, 0.0}, {0.0075 * (i + 1), 1.2}, 0.1 * i - 0.25);
    plane(0.5f, {0.0, -0.9, 0.2}, {1.3, 0.3}, 0.13);
  }
  /// Bars above a floor that mirrors them.
  void bars_over_a_mirror() {
    settings = test::look_at(dvec3(0.3, 1.0, 3.0), dvec3(0.0, 0.1, 0.0), 96, 64);
    Material mirror{.base_color = vec4(1.0f), .metallic = 1.0f, .roughness = 0.0f};
    mirror.reflectivity = 1.0f;
    const double quarter_turn = std::acos(0.0);
    scene.draw(scene.mesh(test::quad(20.0f, scene.material(mirror))),
               glm::rotate(dmat4(1.0), -quarter_turn, dvec3(1.0, 0.0, 0.0)));
    for (int i = 0; i < 7; ++i) plane(0.7f, {-1.2 + 0.4 * i, 0.7, -0.5}, {0.03 + 0.02 * i, 0.5}, 0.15 * i - 0.4);
    set("reflections.mode", "planar");
    set("reflections.blur", "off");
  }
  /// The picture after some frames that are accumulated from the first one on.
  [[nodiscard]] Picture accumulated(std::uint32_t frames) {
    set("lighting.antialiasing", "taa");
    settings.camera_cut = true;
    for (std::uint32_t i = 0; i < frames; ++i) {
      draw();
      settings.camera_cut = false;
    }
    return picture();
  }
  /// Draws a frame at a scale; its picture has the size of the settings.
  void draw_scaled(double scale) {
    ViewRequest request = {.settings = settings, .target = {.width = settings.width, .height = settings.height}};
    request.settings.width = static_cast<std::uint32_t>(std::lround(settings.width * scale));
    request.settings.height = static_cast<std::uint32_t>(std::lround(settings.height * scale));
    request.settings.aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
    ASSERT_TRUE(renderer->render(world, {&request, 1}).ok());
    ASSERT_TRUE(renderer->wait().ok());
    settings.camera_cut = false;
  }
  [[nodiscard]] Picture enlarged(std::uint32_t frames, double scale) {
    set("lighting.antialiasing", "taa");
    settings.camera_cut = true;
    for (std::uint32_t i = 0; i < frames; ++i) draw_scaled(scale);
    return picture();
  }
  /// The greatest trace that a box leaves at places that it left more than four frames before, in 1/255.
  [[nodiscard]] int ghost_of_a_box(double scale, double pan_m = 0.0);
  [[nodiscard]] const RenderView& view(std::uint32_t id = 0) { return world.view_resource<RenderView>(ViewId{id}); }
  [[nodiscard]] static double psnr(const Picture& a, const Picture& b) {
    return 20.0 * std::log10(255.0 / root_mean_square(a, b));
  }
  [[nodiscard]] static int greatest_difference(const Picture& a, const Picture& b) {
    int most = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) most = std::max(most, std::abs(a.rgba[i] - b.rgba[i]));
    return most;
  }
};

TEST_F(AccumulatedFrame, converges_at_rest_to_the_supersampled_picture) {
  wires_before_stripes();
  for (const bool orthographic : {true, false}) {
    settings.camera.orthographic = orthographic;
    const Picture right = supersampled(64);
    const double smoothed = psnr(drawn("smaa"), right);
    EXPECT_GT(psnr(accumulated(16), right), smoothed + 6.0) << orthographic;
    EXPECT_GT(psnr(accumulated(64), right), smoothed + 6.0) << "and stays there";
  }
}

TEST_F(AccumulatedFrame, begins_with_the_picture_without_antialiasing) {
  wires_before_stripes();
  const Picture plain = drawn("off"), first = accumulated(1);
  // Accumulated light is rounded to half floats.
  EXPECT_LE(greatest_difference(plain, first), 1);
  EXPECT_EQ(view().jitter, vec2(0.0f));
}

TEST_F(AccumulatedFrame, has_two_passes_and_motion_only_if_it_is_chosen) {
  glow(0.2);
  static_cast<void>(accumulated(2));
  EXPECT_EQ(antialiasing_passes(), 2u);
  EXPECT_TRUE(view().jittered);
  static_cast<void>(drawn("smaa"));
  EXPECT_EQ(antialiasing_passes(), 3u);
  EXPECT_FALSE(view().jittered);
  for (const PassTime& pass : renderer->report().passes) EXPECT_NE(pass.name, "sky_motion");
}

TEST_F(AccumulatedFrame, shows_views_without_a_history_of_pictures_as_they_are) {
  glow(0.2);
  settings.visualizer = "albedo";
  static_cast<void>(accumulated(3));
  EXPECT_FALSE(view().jittered) << "a view of the geometry is not shaken";
  EXPECT_EQ(antialiasing_passes(), 0u);
  settings.visualizer = "none";
  settings.purpose = ViewPurpose::reference;
  static_cast<void>(accumulated(3));
  EXPECT_FALSE(view().jittered);
  settings.purpose = ViewPurpose::main;
  settings.lens = LensPoint{kNoEntity, {0.01, 0.0}, 3.0};
  static_cast<void>(accumulated(3));
  EXPECT_FALSE(view().jittered) << "a sample of another mean";
  EXPECT_EQ(antialiasing_passes(), 3u) << "smoothed as by smaa";
}

TEST_F(AccumulatedFrame, captures_light_without_jitter) {
  wires_before_stripes();
  set("lighting.antialiasing", "taa");
  gpu::ImageDesc desc{.name = "capture", .module = "test", .format = gpu::Format::rgba16_float};
  desc.width = settings.width;
  desc.height = settings.height;
  desc.usage = gpu::ImageUsage::color_target | gpu::ImageUsage::sampled;
  const gpu::ImageHandle image = test::value_of(test::shared_device()->create_image(desc));
  std::vector<ViewRequest> requests = {{settings, {}}, {settings, {}}, {settings, {}}};
  requests[0].settings.id = ViewId{7};
  requests[0].target.light = LightTarget{.image = image};
  requests[1].settings.id = ViewId{8};
  requests[1].settings.purpose = ViewPurpose::capture;
  LinearPicture first[2];
  for (int frame = 0; frame < 4; ++frame) {
    ASSERT_TRUE(renderer->render(world, requests).ok());
    ASSERT_TRUE(renderer->wait().ok());
    EXPECT_FALSE(view(7).jittered);
    EXPECT_FALSE(view(8).jittered);
    EXPECT_TRUE(view(0).jittered) << "beside a picture that is";
    const LinearPicture light = test::value_of(renderer->read_linear(ViewId{8}));
    if (frame == 0) first[0] = light;
    EXPECT_EQ(light.rgba, first[0].rgba) << frame;
  }
  test::shared_device()->destroy(image);
}

TEST_F(AccumulatedFrame, mirrors_the_points_that_the_picture_shows) {
  bars_over_a_mirror();
  for (const char* resolution : {"full", "half"}) {
    set("ssr.resolution", resolution);
    const Picture right = supersampled(64);
    const double smoothed = psnr(drawn("smaa"), right), found = psnr(accumulated(32), right);
    EXPECT_GT(found, smoothed + 6.0) << resolution << ": " << found;
    const RenderView& mirrored = view(CompanionViews::ids_of(ViewId{0})[0].value);
    EXPECT_TRUE(mirrored.jittered);
    EXPECT_FLOAT_EQ(mirrored.jitter.x / static_cast<float>(mirrored.width), view().jitter.x / 96.0f);
    EXPECT_FLOAT_EQ(mirrored.jitter.y / static_cast<float>(mirrored.height), view().jitter.y / 64.0f);
  }
}

TEST_F(AccumulatedFrame, shows_sprites_at_once_and_no_trace_of_them_after_four_frames) {
  plane(0.5f, {0.0, 0.0, -0.5}, {9.0, 9.0});
  settings.camera.orthographic = false;
  world.resource<SceneClock>().time_s = 4.0;
  const Picture without = accumulated(20);
  ParticleEmitter smoke{.kind = EmitterKind::smoke, .rate = 200.0f, .lifetime_s = 2.0f, .size_m = 0.8f};
  const Entity emitter = world.create(smoke, WorldTransform{glm::translate(dmat4(1.0), dvec3(0.0, -0.8, 0.5))});
  draw();
  const Picture at_once = picture(), with = drawn("off");
  // Where the smoke is densest.
  std::size_t densest = 0;
  const auto change = [&](const Picture& p, std::size_t i) {
    return std::abs(srgb_to_linear(p.rgba[i] / 255.0) - srgb_to_linear(without.rgba[i] / 255.0));
  };
  for (std::size_t i = 0; i < with.rgba.size(); ++i) densest = change(with, i) > change(with, densest) ? i : densest;
  EXPECT_GT(change(with, densest), 0.3);
  EXPECT_GT(change(at_once, densest), 0.45 * change(with, densest)) << "half of the light is that of the frame";
  static_cast<void>(accumulated(20));
  world.destroy(emitter);
  for (int frame = 0; frame < 5; ++frame) draw();
  EXPECT_LE(greatest_difference(picture(), without), 2);
}

TEST_F(AccumulatedFrame, begins_anew_after_a_cut) {
  wires_before_stripes();
  set("lighting.antialiasing", "taa");
  static_cast<void>(accumulated(7));
  // A second view, which no frame has drawn before, sees the same from the frame of the cut on.
  settings.world_from_camera[3].x += 0.37;
  settings.camera_cut = true;
  for (int frame = 0; frame < 5; ++frame) {
    ViewRequest requests[] = {{settings, {}}, {settings, {}}};
    requests[1].settings.id = ViewId{1};
    requests[1].settings.camera_cut = false;
    ASSERT_TRUE(renderer->render(world, requests).ok());
    ASSERT_TRUE(renderer->wait().ok());
    EXPECT_EQ(picture(0).rgba, picture(1).rgba) << frame;
    settings.camera_cut = false;
  }
}

TEST_F(AccumulatedFrame, begins_anew_with_another_size_and_with_other_knobs) {
  wires_before_stripes();
  set("lighting.antialiasing", "taa");
  for (int frame = 0; frame < 6; ++frame) {
    const bool last = frame == 5;
    // In the last frame the first view has lost its history because of the knob, the second because of its size.
    set("lighting.tone_map", last ? "reinhard" : "filmic");
    ViewRequest requests[] = {{settings, {}}, {settings, {}}};
    requests[1].settings.id = ViewId{1};
    if (!last) requests[1].settings.height -= 2;
    ASSERT_TRUE(renderer->render(world, requests).ok());
    ASSERT_TRUE(renderer->wait().ok());
  }
  EXPECT_EQ(view(0).jitter, view(1).jitter);
  EXPECT_NE(view(0).jitter, vec2(0.0f));
  EXPECT_EQ(picture(0).rgba, picture(1).rgba);
}

TEST_F(AccumulatedFrame, is_the_same_twice) {
  wires_before_stripes();
  const Picture first = accumulated(11);
  EXPECT_EQ(first.rgba, accumulated(11).rgba);
  for (const auto& [width, height] : {std::pair{1u, 1u}, {2u, 2u}, {1u, 33u}, {65u, 3u}, {97u, 61u}}) {
    settings.width = width;
    settings.height = height;
    const Picture one = accumulated(5);
    EXPECT_EQ(one.rgba, accumulated(5).rgba) << width << "x" << height;
  }
}

TEST_F(AccumulatedFrame, reads_the_same_frame_again_without_a_step) {
  wires_before_stripes();
  const Picture shown = accumulated(6);
  static_cast<void>(test::value_of(renderer->read_image(world, settings.id, "depth")));
  EXPECT_EQ(picture().rgba, shown.rgba);
}

/// By how much a pixel leaves the range of another picture's pixels up to a distance from it.
int beyond_range(const Picture& picture, const Picture& range, int x, int y, int distance) {
  const auto at = [](const Picture& p, int px, int py, int c) {
    const int column = std::clamp(px, 0, static_cast<int>(p.width) - 1);
    const int row = std::clamp(py, 0, static_cast<int>(p.height) - 1);
    return int{p.rgba[static_cast<std::size_t>((row * static_cast<int>(p.width) + column) * 4 + c)]};
  };
  int most = 0;
  for (int c = 0; c < 3; ++c) {
    int low = 255, high = 0;
    for (int dy = -distance; dy <= distance; ++dy)
      for (int dx = -distance; dx <= distance; ++dx) {
        low = std::min(low, at(range, x + dx, y + dy, c));
        high = std::max(high, at(range, x + dx, y + dy, c));
      }
    const int own = at(picture, x, y, c);
    most = std::max({most, own - high, low - own});
  }
  return most;
}

/// At a reduced scale, pixels that the box has left show few points of the wall at first. So they are compared with the
/// range of the wall over a pixel of the frame.
int AccumulatedFrame::ghost_of_a_box(double scale, double pan_m) {
  for (int i = 0; i < 16; ++i) plane(i % 2 == 0 ? 0.1f : 0.3f, {-2.25 + 0.3 * i, 0.0, -0.5}, {0.15, 2.0});
  const Entity box = plane(3.0f, {-1.8, 0.0, 0.5}, {0.3, 0.6});
  set("lighting.antialiasing", "taa");
  // Each frame as it would be if the box had never been there: the same frames of the wall alone.
  std::vector<Picture> with_box, without_box;
  for (const bool shown : {true, false}) {
    settings.camera_cut = true;
    for (int frame = 0; frame < 14; ++frame) {
      const double x = shown ? -1.8 + 0.3 * frame : 100.0;
      settings.world_from_camera[3].x = pan_m * frame;
      world.get<WorldTransform>(box).matrix =
          glm::scale(glm::translate(dmat4(1.0), dvec3(x, 0.0, 0.5)), dvec3(0.3, 0.6, 1.0));
      draw_scaled(scale);
      (shown ? with_box : without_box).push_back(picture());
    }
  }
  int most = 0;
  for (int frame = 4; frame < 14; ++frame) {
    // The left edge of the box four frames ago: everything to the left of it has been free for more than four frames.
    const double left_edge = -1.8 + 0.3 * (frame - 4) - 0.3;
    const int columns = static_cast<int>(48 + 20.0 * (left_edge - pan_m * frame) - 1.0 / scale);
    const Picture &a = with_box[static_cast<std::size_t>(frame)], &b = without_box[static_cast<std::size_t>(frame)];
    for (int y = 0; y < static_cast<int>(a.height); ++y)
      for (int x = 0; x < columns; ++x) most = std::max(most, beyond_range(a, b, x, y, scale < 1.0 ? 2 : 0));
  }
  return most;
}

TEST_F(AccumulatedFrame, keeps_no_ghost_of_a_box_for_more_than_four_frames) {
  EXPECT_LE(ghost_of_a_box(1.0), 12);
  EXPECT_LE(ghost_of_a_box(1.0, 0.07), 12) << "the camera moves, too";
}

TEST_F(AccumulatedFrame, keeps_no_ghost_for_more_than_four_frames_at_half_the_size) {
  EXPECT_LE(ghost_of_a_box(0.5), 12);
}

TEST_F(AccumulatedFrame, enlarges_frames_of_half_the_size_to_more_than_smaa_shows_at_full_size) {
  wires_before_stripes();
  const Picture right = supersampled(64), smoothed = drawn("smaa");
  const Picture half = enlarged(32, 0.5);
  ASSERT_EQ(half.width, settings.width);
  EXPECT_GT(psnr(half, right), psnr(smoothed, right));
  EXPECT_EQ(half.rgba, enlarged(32, 0.5).rgba) << "the same twice";
}

TEST_F(AccumulatedFrame, keeps_its_history_when_the_scale_changes) {
  wires_before_stripes();
  const Picture right = supersampled(64);
  const double before = psnr(enlarged(32, 0.5), right);
  for (const double scale : {0.7, 1.0, 0.35, 0.5}) {
    draw_scaled(scale);
    EXPECT_GT(psnr(picture(), right), before - 1.5) << "no flash at " << scale;
  }
}

TEST_F(AccumulatedFrame, samples_textures_for_the_pixels_of_an_enlarged_picture) {
  // A checkerboard whose squares are 1.5 pixels wide: pixels of half the size show little but its mean.
  Material material{.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f), .metallic = 0.0f, .roughness = 1.0f};
  material.emissive = vec3(0.8f);
  std::vector<std::uint8_t> texels;
  for (int i = 0; i < 86 * 86; ++i) {
    const std::uint8_t value = (i % 86 + i / 86) % 2 == 0 ? 255 : 0;
    texels.insert(texels.end(), {value, value, value, 255});
  }
  material.emissive_texture.texture = scene.texture(86, 86, texels, false);
  scene.assets().textures.back().nearest = false;
  scene.draw(scene.mesh(test::quad(3.2f, scene.material(material))),
             glm::rotate(dmat4(1.0), 0.2, dvec3(0.0, 0.0, 1.0)));
  EXPECT_EQ(enlarged(1, 1.0).width, 96u);
  EXPECT_EQ(view().mip_bias, 0.0f);
  const Picture right = supersampled(64);
  static_cast<void>(enlarged(1, 0.5));
  EXPECT_FLOAT_EQ(view().mip_bias, -1.0f);
  EXPECT_GT(psnr(enlarged(32, 0.5), right), 20.0);
  set("lighting.antialiasing", "smaa");
  draw_scaled(0.5);
  EXPECT_EQ(view().mip_bias, 0.0f) << "without accumulation a sharper mip would flicker";
}

TEST_F(AccumulatedFrame, leaves_a_picture_that_is_not_accumulated_in_the_size_of_its_view) {
  glow(0.2);
  set("lighting.antialiasing", "smaa");
  draw_scaled(0.5);
  EXPECT_EQ(picture().width, settings.width / 2);
  static_cast<void>(enlarged(2, 0.5));
  EXPECT_EQ(picture().width, settings.width);
  settings.visualizer = "albedo";
  draw_scaled(0.5);
  EXPECT_EQ(picture().width, settings.width / 2) << "a view of the geometry is not enlarged";
}

TEST_F(AccumulatedFrame, enlarges_odd_sizes_and_an_empty_view) {
  for (const auto& [width, height] : {std::pair{2u, 2u}, {5u, 33u}, {65u, 3u}, {97u, 61u}}) {
    settings.width = width;
    settings.height = height;
    EXPECT_EQ(enlarged(3, 0.5).width, width) << "nothing but sky";
  }
  plane(0.2f, dvec3(0.0), {9.0, 9.0});
  const Picture even = enlarged(9, 0.35);
  EXPECT_EQ(greatest_difference(even, enlarged(1, 1.0)), 0) << "an even surface has no border";
}

TEST_F(AccumulatedFrame, follows_light_that_changes_at_rest_within_four_frames) {
  Material white{.base_color = vec4(0.8f, 0.8f, 0.8f, 1.0f), .metallic = 0.0f, .roughness = 1.0f};
  scene.draw(scene.mesh(test::quad(2.0f, scene.material(white))));
  const Entity lamp = light({.intensity = 3.0f}, {0.0, 0.0, 1.5});
  static_cast<void>(accumulated(20));
  const Picture bright = picture();
  world.get<Light>(lamp).intensity = 0.3f;
  for (int frame = 0; frame < 4; ++frame) draw();
  const Picture after = picture();
  const Picture right = accumulated(20);
  EXPECT_GT(greatest_difference(bright, right), 60);
  EXPECT_LE(greatest_difference(after, right), 4);
}

TEST_F(AccumulatedFrame, forgets_light_that_is_not_finite) {
  plane(0.2f, dvec3(0.0), {1.5, 1.5});
  const Picture right = accumulated(8);
  for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    const Entity spot = plane(bad, {0.3, 0.2, 0.3}, {0.4, 0.4});
    static_cast<void>(accumulated(3));
    world.destroy(spot);
    for (int frame = 0; frame < 8; ++frame) draw();
    EXPECT_LE(greatest_difference(picture(), right), 1) << bad;
  }
}

}  // namespace
}  // namespace gloam
