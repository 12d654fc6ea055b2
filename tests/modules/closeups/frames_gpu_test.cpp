// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <optional>

#include "tests/modules/closeups/scene.h"

// Close-up shadows against rays, against standard maps of high resolution that hold all casters, and against the frame
// without the subject. A subject must only reduce light, only where it blocks, and change nothing else.

namespace gloam::test {
namespace {

/// Limit of the mean difference from maps of high resolution, which allows for half a pixel of blur on both sides of
/// each silhouette. The limit against rays is kMostMean.
constexpr double kMostFromMaps = 0.015;
constexpr double kMostOppositeToMaps = 0.01;  ///< share of pixels that are dark in one and lit in the other

class CloseupFrames : public CloseupScene {
 protected:
  /// A room with a static block and a figure.
  void put_scene(const dvec3& feet = dvec3(0.15, 0.0, 0.3), double scale = 1.0) {
    put_room();
    put(shapes_[0], glm::scale(glm::rotate(at(-0.9, 0.25, -0.7), 0.5, dvec3(0.0, 1.0, 0.0)), dvec3(0.4, 0.5, 0.4)));
    put_far_boxes();
    figure = put_figure(feet, scale);
  }
  /// Position of a point in a face: texels from its corner, and metres from the light or from the near side.
  [[nodiscard]] static dvec3 place_in(const ShadowFace& face, const dvec3& point) {
    const dvec3 v = point - face.origin;
    const double z = glm::dot(v, dvec3(face.forward)), size = static_cast<double>(face.square.size);
    const double half =
        face.tan_half > 0.0f ? z * static_cast<double>(face.tan_half) : static_cast<double>(face.half_extent_m);
    return {(0.5 + 0.5 * glm::dot(v, dvec3(face.right)) / half) * size,
            (0.5 - 0.5 * glm::dot(v, dvec3(face.up)) / half) * size, z};
  }
  /// Whether the point is certainly outside the close-up face.
  [[nodiscard]] static bool is_outside(const ShadowFace& face, const dvec3& point) {
    constexpr double kMargin = 0.1;  // texels
    const dvec3 p = place_in(face, point);
    if (face.tan_half > 0.0f && p.z < static_cast<double>(face.near_m) * 0.999) return true;
    const double size = static_cast<double>(face.square.size);
    return std::min(p.x, p.y) < -kMargin || std::max(p.x, p.y) > size + kMargin;
  }

  struct Checked {
    std::size_t pairs = 0;
    std::size_t darker = 0;   ///< pixels
    std::size_t outside = 0;  ///< pixels of the pair's tiles that are outside its face
    ShadowError error;
    SeenDifference maps;
  };

  /// All checks of this file, for a light with at most one pair.
  Checked expect_right_closeup(const std::string& what, Entity lamp) {
    Checked checked;
    const CloseupShot close = second_shot();
    checked.pairs = close.views.pairs.size();
    EXPECT_EQ(counted("closeups.pairs"), static_cast<double>(checked.pairs)) << what;
    const TracedVisibility traced = trace();
    const std::vector<float> standard = monolithic(lamp);
    hide(figure);
    const CloseupShot absent = second_shot();
    show(figure);
    EXPECT_FALSE(HasFatalFailure());
    if (HasFatalFailure()) return checked;
    const SeenLight with = seen(close.lists, lamp), without = seen(absent.lists, lamp);
    const auto pair =
        std::ranges::find_if(close.views.pairs, [&](const CloseupView& view) { return view.light == lamp; });
    const bool paired = pair != close.views.pairs.end();
    if (paired) expect_lesser(what, lamp, close, absent, with, without, *pair, checked);
    compare(what, lamp, close, traced, with, standard, checked);
    return checked;
  }
  void expect_lesser(const std::string& what, Entity lamp, const CloseupShot& close, const CloseupShot& absent,
                     const SeenLight& with, const SeenLight& without, const CloseupView& pair, Checked& checked) {
    std::size_t apart = 0, other_light = 0, more = 0, outside = 0;
    for (std::size_t i = 0; i < with.pixels.size(); ++i) {
      const bool same = close.geometry.depth[i] == absent.geometry.depth[i] &&
                        close.geometry.normals[i] == absent.geometry.normals[i];
      if (!same || close.geometry.is_sky(i)) continue;
      const bool given = gives(close.geometry, i, lamp);
      checked.darker += given && with.pixels[i] < without.pixels[i] ? 1 : 0;
      if (!in_tiles(i, pair.tiles)) {
        apart += with.pixels[i] == without.pixels[i] ? 0 : 1;
        for (std::size_t c = 4 * i; c < 4 * i + 3; ++c)
          other_light += close.light.rgba[c] == absent.light.rgba[c] ? 0 : 1;
        continue;
      }
      if (!given) continue;
      more += with.pixels[i] > without.pixels[i] ? 1 : 0;
      const auto x = static_cast<std::uint32_t>(i % settings.width), y = static_cast<std::uint32_t>(i / settings.width);
      if (!is_outside(pair.face, close.geometry.position(x, y) + close.geometry.view.position)) continue;
      ++checked.outside;
      outside += with.pixels[i] == without.pixels[i] ? 0 : 1;
    }
    EXPECT_EQ(apart, 0u) << what << ": pixels of other tiles that see otherwise";
    EXPECT_EQ(other_light, 0u) << what << ": channels of other tiles that are lit otherwise";
    EXPECT_EQ(more, 0u) << what << ": pixels that see more";
    EXPECT_EQ(outside, 0u) << what << ": pixels that see otherwise without being in the map";
  }
  void compare(const std::string& what, Entity lamp, const CloseupShot& close, const TracedVisibility& traced,
               const SeenLight& with, const std::vector<float>& standard, Checked& checked) {
    std::vector<float> judged = with.pixels;
    for (std::size_t i = 0; i < judged.size(); ++i) {
      if (!gives(close.geometry, i, lamp)) judged[i] = -1.0f;
      if (judged[i] >= 0.0f && standard[i] >= 0.0f) checked.maps.add(judged[i], standard[i]);
    }
    const auto layer = traced.layer_of(lamp);
    if (layer) checked.error = compare_visibility(traced, *layer, judged);
    std::printf("%-34s darker %zu  outside %zu  from maps: mean %.6f, opposite %.4f of %zu\n", what.c_str(),
                checked.darker, checked.outside, checked.maps.mean(), checked.maps.half_share(), checked.maps.pixels);
    expect_right(what, checked.error, 200);
    EXPECT_GT(checked.maps.pixels, 200u) << what;
    EXPECT_LE(checked.maps.mean(), kMostFromMaps) << what;
    EXPECT_LE(checked.maps.half_share(), kMostOppositeToMaps) << what;
  }
  Figure figure;
};

TEST_F(CloseupFrames, of_a_lamp_keep_what_rays_and_large_maps_say) {
  for (const float width : {0.0f, 0.12f}) {
    clear_scene();
    put_scene();
    const Entity lamp = put_light(point(width), dvec3(0.8, 1.7, 1.0), dvec3(0.0, -1.0, 0.0), 1024);
    set("shadows.atlas", "4096");
    const Checked checked = expect_right_closeup("lamp " + std::to_string(width), lamp);
    EXPECT_GT(checked.darker, 100u);
    EXPECT_GT(checked.outside, 0u);
  }
}

TEST_F(CloseupFrames, of_a_spot_keep_what_rays_and_large_maps_say) {
  for (const float width : {0.0f, 0.12f}) {
    clear_scene();
    put_scene();
    const Entity lamp = put_light(spot(50.0, width), dvec3(-0.6, 2.0, 1.3), dvec3(0.3, -1.0, -0.5), 2048);
    set("shadows.atlas", "4096");
    const Checked checked = expect_right_closeup("spot " + std::to_string(width), lamp);
    EXPECT_GT(checked.darker, 100u);
    EXPECT_GT(checked.outside, 0u);
  }
}

TEST_F(CloseupFrames, of_a_sun_keep_what_rays_and_large_maps_say) {
  for (const float angle : {0.0f, 0.05f}) {
    clear_scene();
    put_scene();
    const Entity lamp = put_light(sun(angle), dvec3(0.0), dvec3(0.5, -1.0, -0.4), 2048);
    set("shadows.atlas", "4096");
    const Checked checked = expect_right_closeup("sun " + std::to_string(angle), lamp);
    EXPECT_GT(checked.darker, 50u);
    EXPECT_GT(checked.outside, 0u);
  }
}

// A thin pole in front of many tiles: most pixels of these tiles are outside its face.
TEST_F(CloseupFrames, leave_pixels_beside_a_thin_subject_alone) {
  put_room();
  put_far_boxes();
  figure = put_block(dvec3(0.0, 0.5, 0.2), dvec3(0.03, 1.0, 0.03));
  const Entity lamp = put_light(spot(50.0), dvec3(-0.2, 2.0, 1.6), dvec3(0.1, -1.0, -0.6), 2048);
  const Checked checked = expect_right_closeup("pole", lamp);
  EXPECT_GT(checked.darker, 20u);
  EXPECT_GT(checked.outside, 50u);
  const CloseupShot close = shot();
  const SeenLight with = seen(close.lists, lamp);
  for (std::size_t tile = 0; tile < with.slots.size(); ++tile) EXPECT_NE(with.slots[tile], GLOAM_ALL_UNLIT) << tile;
}

// Hard case: shadows.closeup_light_inside
TEST_F(CloseupFrames, of_a_light_inside_the_subject_are_left_to_the_standard_map) {
  put_scene();
  put_light(point(), dvec3(0.15, 0.8, 0.32), dvec3(0.0, -1.0, 0.0), 256);
  set("shadows.atlas", "2048");
  const CloseupShot close = second_shot();
  EXPECT_EQ(close.views.in_view, 1u);
  EXPECT_EQ(counted("closeups.pairs"), 0.0);
  EXPECT_EQ(close.views.skipped, 1u);
  EXPECT_EQ(counted("closeups.skipped"), 1.0);
  EXPECT_FALSE(has_closeup_pass());
  set("closeups.max_pairs", "0");
  const CloseupShot off = second_shot();
  EXPECT_EQ(close.light.rgba, off.light.rgba);
  EXPECT_EQ(close.lists.all(), off.lists.all());
}

TEST_F(CloseupFrames, reach_no_receiver_before_the_subject) {
  put_scene(dvec3(0.15, 0.0, 0.0));
  // Sheets between the lamp and the figure. One of them blocks part of the light that would reach the figure.
  put(shapes_[0], glm::scale(at(0.75, 1.35, 0.7), dvec3(0.3, 0.02, 0.3)));
  const Entity lamp = put_light(point(0.05f), dvec3(0.9, 1.9, 0.9), dvec3(0.0, -1.0, 0.0), 1024);
  set("shadows.atlas", "4096");
  EXPECT_GT(expect_right_closeup("before the subject", lamp).darker, 100u);
}

// Hard case: shadows.closeup_beyond_far
TEST_F(CloseupFrames, end_with_the_reach_of_the_light) {
  for (const double range : {2.1, 2.6}) {
    clear_scene();
    put_scene();
    Light made = point(0.05f);
    made.range_m = static_cast<float>(range);
    made.intensity = 60.0f;
    const Entity lamp = put_light(made, dvec3(0.9, 1.7, 1.0), dvec3(0.0, -1.0, 0.0), 1024);
    set("shadows.atlas", "4096");
    const Checked checked = expect_right_closeup("reach " + std::to_string(range), lamp);
    EXPECT_GT(checked.darker, 5u);
    EXPECT_EQ(checked.pairs, 1u);
  }
}

// Hard case: shadows.closeup_beyond_far
TEST_F(CloseupFrames, of_a_sun_reach_as_far_as_anything_lies) {
  put_scene(dvec3(0.15, 1.4, 0.6), 0.8);
  put(plane_, flat(-3.0) * glm::scale(dmat4(1.0), dvec3(8.0)));
  const Entity lamp = put_light(sun(0.01f), dvec3(0.0), dvec3(0.3, -0.8, -0.7), 2048);
  set("shadows.atlas", "4096");
  EXPECT_GT(expect_right_closeup("far wall", lamp).darker, 50u);
}

// Hard case: shadows.closeup_behind_light
TEST_F(CloseupFrames, of_a_subject_behind_a_spot_change_nothing) {
  put_scene(dvec3(0.2, 1.3, 0.9), 0.5);
  const Entity lamp = put_light(spot(40.0), dvec3(0.2, 1.1, 0.5), dvec3(0.0, -0.6, -1.0), 512);
  const CloseupShot close = second_shot();
  hide(figure);
  const CloseupShot absent = second_shot();
  show(figure);
  const SeenLight with = seen(close.lists, lamp), without = seen(absent.lists, lamp);
  for (std::size_t i = 0; i < with.pixels.size(); ++i) {
    if (close.geometry.depth[i] == absent.geometry.depth[i]) {
      ASSERT_EQ(with.pixels[i], without.pixels[i]) << i;
    }
  }
}

// Hard case: shadows.closeup_behind_camera
TEST_F(CloseupFrames, of_subjects_at_the_camera_are_right) {
  for (const double ahead : {0.6, 0.1}) {
    clear_scene();
    put_room();
    put_far_boxes();
    settings = look_at(dvec3(0.2, 0.9, 1.6), dvec3(0.0, 0.2, 0.0), 160, 96);
    // The subject is beside and behind the camera; its shadow falls into view.
    figure = put_block(dvec3(0.75, 1.1, 1.5 - ahead), dvec3(0.5, 0.3, 1.6));
    const Entity lamp = put_light(spot(65.0, 0.12f), dvec3(1.3, 2.3, 1.9), dvec3(-0.7, -1.0, -0.9), 2048);
    set("shadows.atlas", "4096");
    const Checked checked = expect_right_closeup("at the camera " + std::to_string(ahead), lamp);
    EXPECT_GT(checked.darker, 100u);
    EXPECT_EQ(checked.pairs, 1u);
  }
}

// Hard case: shadows.closeup_larger_than_cone
TEST_F(CloseupFrames, of_subjects_larger_than_a_cone_are_right) {
  put_scene(dvec3(0.1, 0.0, 0.2), 1.5);
  const Entity lamp = put_light(spot(14.0, 0.04f), dvec3(-0.9, 1.9, 1.9), dvec3(0.95, -1.0, -1.5), 2048);
  set("shadows.atlas", "4096");
  const Checked checked = expect_right_closeup("larger than the cone", lamp);
  EXPECT_GT(checked.darker, 50u);
}

TEST_F(CloseupFrames, of_subjects_half_in_the_light_are_right) {
  put_scene(dvec3(-0.2, 0.0, -0.2), 1.0);
  Light made = point(0.05f);
  made.range_m = 1.6f;
  made.intensity = 80.0f;
  const Entity lamp = put_light(made, dvec3(0.3, 1.3, 0.1), dvec3(0.0, -1.0, 0.0), 1024);
  set("shadows.atlas", "4096");
  EXPECT_GT(expect_right_closeup("half in reach", lamp).darker, 10u);
}

// Standard maps lack the subjects of pairs, but shading has their shadows.
TEST_F(CloseupFrames, the_view_of_errors_judges_them_as_they_are_shaded) {
  put_scene();
  const Entity lamp = put_light(point(0.12f), dvec3(0.8, 1.7, 1.0), dvec3(0.0, -1.0, 0.0), 512);
  set("shadows.atlas", "4096");
  draw();
  TracedVisibility traced = trace();
  traced.shades = false;
  const std::optional<std::size_t> layer = traced.layer_of(lamp);
  ASSERT_TRUE(layer);
  double means[2] = {};
  for (const bool with : {false, true}) {
    set("closeups.max_pairs", with ? "8" : "0");
    const CloseupShot close = second_shot();
    EXPECT_EQ(has_closeup_pass(), with);
    const SeenLight drawn = seen(close.lists, lamp);
    world.set_resource(traced);
    settings.visualizer = "error";
    draw();
    settings.visualizer = "none";
    const ImageBytes image = value_of(renderer->read_image(world, settings.id, "shadow_error"));
    world.remove_resource<TracedVisibility>();
    std::vector<float> error(image.bytes.size() / sizeof(float));
    std::memcpy(error.data(), image.bytes.data(), image.bytes.size());
    std::size_t judged = 0;
    for (std::size_t i = 0; i < error.size(); ++i) {
      if (error[i] >= 0.0f) means[with ? 1 : 0] += static_cast<double>(error[i]) / static_cast<double>(error.size());
      const float right = static_cast<float>(traced.visibility[*layer * traced.pixels() + i]) / 255.0f;
      if (!gives(close.geometry, i, lamp) || !traced.is_judged(*layer * traced.pixels() + i)) continue;
      ASSERT_NEAR(error[i], std::abs(drawn.pixels[i] - right), 2e-3) << i;
      ++judged;
    }
    EXPECT_GT(judged, 2000u);
  }
  std::printf("mean error %.5f without and %.5f with close-ups\n", means[0], means[1]);
  EXPECT_LT(means[1], 1.2 * means[0]);
}

}  // namespace
}  // namespace gloam::test
