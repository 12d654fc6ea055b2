// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/umbra/umbra_projection.h"

#include <gtest/gtest.h>

#include <limits>

#include "modules/lights/outputs.h"
#include "tests/modules/closeups/cases.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

/// A camera given by its pose and lens alone.
struct Eye {
  dmat4 pose;
  Camera camera;
  uvec2 size = uvec2(640, 360);

  [[nodiscard]] RenderView view() const {
    ViewSettings settings;
    settings.width = size.x;
    settings.height = size.y;
    settings.follow_camera = false;
    settings.world_from_camera = pose;
    settings.camera = camera;
    return make_view(settings, 0);
  }
  /// The pixel position of a point, with fractions; none if it is not visible.
  [[nodiscard]] std::optional<glm::dvec2> pixel(const dvec3& world) const {
    const dvec3 to = world - dvec3(pose[3]);
    const double depth = -glm::dot(dvec3(pose[2]), to);
    if (depth < static_cast<double>(camera.near_m)) return std::nullopt;
    const double half = camera.orthographic ? static_cast<double>(camera.half_height_m)
                                            : depth * std::tan(0.5 * static_cast<double>(camera.fov_y));
    const double side = size.y / (2.0 * half);
    const glm::dvec2 at(0.5 * size.x + glm::dot(dvec3(pose[0]), to) * side,
                        0.5 * size.y - glm::dot(dvec3(pose[1]), to) * side);
    if (at.x < 0.0 || at.y < 0.0 || at.x >= size.x || at.y >= size.y) return std::nullopt;
    return at;
  }
};

struct Case {
  Eye eye;
  CloseupLight light;
  WorldBox subject;
  WorldBox receivers;
};

class UmbraProjection : public ::testing::Test {
 protected:
  [[nodiscard]] CloseupLight light_at(const dvec3& at, const dvec3& forward) {
    Light light;
    const int kind = static_cast<int>(cases_.in(0.0, 3.0));
    light.kind = kind == 0 ? LightKind::point : kind == 1 ? LightKind::spot : LightKind::directional;
    light.range_m = static_cast<float>(cases_.in(0.5, 20.0));
    light.outer_angle = static_cast<float>(cases_.in(0.02, 1.6));
    light.width_m = cases_.chance(0.4) ? 0.0f : static_cast<float>(cases_.in(0.0, 1.0));
    light.apparent_angle =
        cases_.chance(0.3) ? 0.0f : static_cast<float>(cases_.in(0.0, cases_.chance(0.1) ? 3.0 : 0.2));
    return *closeup_light(light, cases_.looking(at, forward));
  }
  [[nodiscard]] Camera lens() {
    Camera camera;
    camera.orthographic = cases_.chance(0.3);
    camera.fov_y = static_cast<float>(cases_.in(0.1, 2.4));
    camera.half_height_m = static_cast<float>(cases_.in(0.5, 20.0));
    camera.near_m = cases_.chance(0.5) ? 0.1f : static_cast<float>(cases_.in(0.001, 2.0));
    camera.far_m = 1000.0f;
    return camera;
  }
  /// Arbitrary cases: cameras in the shadow volume, subjects behind lights and cameras, lights inside subjects.
  [[nodiscard]] Case any() {
    Case made;
    const dvec3 world = cases_.chance(0.2) ? cases_.point(1e5) : dvec3(0.0);
    const dvec3 at = world + cases_.point(6.0);
    made.subject = cases_.box(at, cases_.chance(0.1) ? 0.0 : 0.05, 3.0);
    const dvec3 lamp = world + cases_.point(cases_.chance(0.2) ? 1.0 : 8.0);
    made.light =
        light_at(lamp, cases_.chance(0.7) ? glm::normalize(at - lamp + cases_.point(2.0)) : cases_.direction());
    made.receivers = cases_.box(world, 10.0, 40.0);
    made.receivers.min = glm::min(made.receivers.min, made.subject.min);
    made.receivers.max = glm::max(made.receivers.max, made.subject.max);
    made.eye = {cases_.looking(world + cases_.point(8.0), cases_.direction()), lens()};
    if (cases_.chance(0.5)) {  // camera inside the shadow
      const auto hidden = cases_.hidden(made.light, made.subject, made.receivers, cases_.in(0.0, 1.0));
      if (hidden) made.eye.pose[3] = dvec4(hidden->receiver, 1.0);
    }
    if (cases_.chance(0.1)) made.eye.size = {7, 5};
    return made;
  }
  /// A subject in front of the camera, lit from any side.
  [[nodiscard]] Case in_view() {
    Case made;
    made.subject = cases_.box(cases_.point(0.5), 0.3, 2.0);
    const dvec3 eye = cases_.direction() * cases_.in(4.0, 12.0);
    made.eye = {cases_.looking(eye, glm::normalize(cases_.point(1.5) - eye)), lens()};
    made.eye.camera.fov_y = static_cast<float>(cases_.in(0.6, 1.4));
    made.eye.camera.half_height_m = static_cast<float>(cases_.in(3.0, 8.0));
    made.eye.camera.near_m = 0.1f;
    const dvec3 lamp = cases_.direction() * cases_.in(2.5, 6.0);
    made.light = light_at(lamp, glm::normalize(cases_.point(0.5) - lamp));
    made.light.emitter_radius_m = std::min(made.light.emitter_radius_m, 0.15);
    made.light.spread = std::min(made.light.spread, 0.05);
    made.light.range_m = std::max(made.light.range_m, 4.0);
    made.receivers = cases_.box(dvec3(0.0), 8.0, 20.0);
    return made;
  }

  test::CloseupCases cases_{11};
};

bool contains(const TileRange& range, const glm::dvec2& pixel) {
  const uvec2 tile = uvec2(pixel) / kShadowTile;
  return !range.empty() && tile.x >= range.begin.x && tile.y >= range.begin.y && tile.x < range.end.x &&
         tile.y < range.end.y;
}

TEST_F(UmbraProjection, holds_every_pixel_that_can_lose_light) {
  std::size_t shown = 0;
  std::size_t narrower = 0;
  const int count = test::scaled(10000);
  for (int round = 0; round < count; ++round) {
    const Case made = any();
    const RenderView view = made.eye.view();
    const TileRange range = umbra_tiles(made.light, made.subject, made.receivers, view);
    narrower += range.tiles() < 80u * 45u ? 1 : 0;
    for (int sample = 0; sample < 40; ++sample) {
      const double share = sample % 3 == 0 ? 1.0 : cases_.in(0.0, 1.0);
      const bool by_cone = made.light.kind == LightKind::spot && sample % 2 == 0;
      const auto hidden = by_cone ? cases_.hidden_in_cone(made.light, made.subject)
                                  : cases_.hidden(made.light, made.subject, made.receivers, share);
      if (!hidden) continue;
      const auto pixel = made.eye.pixel(hidden->receiver);
      if (!pixel) continue;
      ++shown;
      ASSERT_TRUE(contains(range, *pixel)) << "case " << round << ", kind " << static_cast<int>(made.light.kind)
                                           << ", pixel " << pixel->x << ", " << pixel->y << ", tiles " << range.begin.x
                                           << ", " << range.begin.y << " to " << range.end.x << ", " << range.end.y;
    }
  }
  EXPECT_GT(shown, static_cast<std::size_t>(count) * 4);
  EXPECT_GT(narrower, static_cast<std::size_t>(count) / 4);
}

TEST_F(UmbraProjection, has_few_tiles_more_than_the_shadow_touches) {
  double sum[3] = {};
  int found[3] = {};
  for (int round = 0; round < 240; ++round) {
    const Case made = in_view();
    const TileRange range = umbra_tiles(made.light, made.subject, made.receivers, made.eye.view());
    TileRange touched{uvec2(~0u), uvec2(0)};
    for (int sample = 0; sample < 12000; ++sample) {
      const double share = sample % 4 == 0 ? 1.0 : sample % 4 == 1 ? 0.0 : cases_.in(0.0, 1.0);
      const bool by_cone = made.light.kind == LightKind::spot && sample % 2 == 0;
      const auto hidden = by_cone ? cases_.hidden_in_cone(made.light, made.subject)
                                  : cases_.hidden(made.light, made.subject, made.receivers, share);
      const auto pixel = hidden ? made.eye.pixel(hidden->receiver) : std::nullopt;
      if (!pixel) continue;
      const uvec2 tile = uvec2(*pixel) / kShadowTile;
      touched.begin = glm::min(touched.begin, tile);
      touched.end = glm::max(touched.end, tile + 1u);
    }
    if (touched.empty()) continue;
    const auto kind = static_cast<std::size_t>(made.light.kind);
    sum[kind] += static_cast<double>(range.tiles()) / static_cast<double>(touched.tiles());
    ++found[kind];
  }
  for (std::size_t kind = 0; kind < 3; ++kind) {
    ASSERT_GT(found[kind], 40);
    EXPECT_LT(sum[kind] / found[kind], 1.3) << "kind " << kind;
    RecordProperty("mean_area_" + std::to_string(kind), std::to_string(sum[kind] / found[kind]));
  }
}

TEST_F(UmbraProjection, is_empty_where_nothing_shows) {
  Light lamp;
  lamp.range_m = 5.0f;
  const CloseupLight light = *closeup_light(lamp, dmat4(1.0));
  Eye away{glm::translate(dmat4(1.0), dvec3(0, 0, -20.0)), {}};  // looks along −Z, away from the subject
  const WorldBox subject{dvec3(0.5, -0.5, -2.0), dvec3(1.5, 0.5, -1.0)};
  EXPECT_TRUE(umbra_tiles(light, subject, {}, away.view()).empty());
  const WorldBox far{dvec3(10.0), dvec3(11.0)};
  EXPECT_TRUE(umbra_tiles(light, far, {}, Eye{glm::translate(dmat4(1.0), dvec3(10, 10, 20)), {}}.view()).empty())
      << "out of the light's range";
}

TEST_F(UmbraProjection, is_the_whole_view_where_numbers_are_none) {
  const RenderView view = Eye{dmat4(1.0), {}}.view();
  const TileRange whole{uvec2(0), uvec2(80, 45)};
  const WorldBox subject{dvec3(50.0), dvec3(51.0)};
  Light lamp;
  lamp.range_m = 5.0f;
  const CloseupLight light = *closeup_light(lamp, dmat4(1.0));
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    CloseupLight lost = light;
    lost.position.y = bad;
    EXPECT_EQ(umbra_tiles(lost, subject, {}, view), whole);
    EXPECT_EQ(umbra_tiles(light, {subject.min, dvec3(51.0, bad, 51.0)}, {}, view), whole);
    RenderView nowhere = view;
    nowhere.position.z = bad;
    EXPECT_EQ(umbra_tiles(light, subject, {}, nowhere), whole);
  }
  EXPECT_EQ(umbra_tiles(light, {}, {}, view), whole) << "a subject that may be anywhere";
}

}  // namespace
}  // namespace gloam
