// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/render/readback/geometry_picture.h"
#include "engine/scene/resources.h"
#include "modules/reflections/override.h"
#include "tests/modules/reflections/support/reflection_frames.h"

namespace gloam::test {
namespace {

/// A floor before a box, with a wall as a proxy and two probes.
class ReflectionViews : public ReflectionFrames {
 protected:
  void SetUp() override {
    ReflectionFrames::SetUp();
    if (IsSkipped()) return;
    furnish();
    wall = proxy(vec2(20.0f, 8.0f), at(0.0, 3.0, -4.0));
    world.resource<SceneNames>().add("ibr_proxy", "wall", wall);
    probe(vec3(6.0f, 6.0f, 6.0f), {0.0, 1.0, 0.0});
    probe({}, {}, true);
    capture(world, {vec4(0.25f, 0.25f, 0.25f, 0.5f)}, {vec4(2.0f), vec4(0.5f)});
  }
  [[nodiscard]] bool is_floor(const GeometryPicture& seen, std::size_t pixel) const {
    if (seen.is_sky(pixel)) return false;
    const dvec3 p = seen.position(static_cast<std::uint32_t>(pixel % settings.width),
                                  static_cast<std::uint32_t>(pixel / settings.width));
    return std::abs(p.y + seen.view.position.y) < 1e-3;
  }
  [[nodiscard]] std::vector<std::string> lines(std::uint32_t x, std::uint32_t y) {
    draw();
    return value_of(renderer->pick(world, settings.id, x, y));
  }

  Entity wall;
};

TEST_F(ReflectionViews, shares_of_the_tiers_are_a_part_of_1_where_something_reflects) {
  const std::vector<vec4> shares = shown("reflection_tier");
  const GeometryPicture seen = geometry();
  ASSERT_EQ(shares.size(), std::size_t{settings.width} * settings.height);
  double most[3] = {};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const vec4 s = shares[i];
    if (!is_floor(seen, i)) {
      ASSERT_EQ(s, vec4(0.0f)) << i;
      continue;
    }
    ASSERT_EQ(s.w, 1.0f);
    ASSERT_LE(s.x + s.y + s.z, 1.002f) << i;
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(s[k], 0.0f);
      most[k] = std::max(most[k], static_cast<double>(s[k]));
    }
  }
  EXPECT_GT(most[0], 0.9) << "screen space";
  EXPECT_NEAR(most[1], 0.5, 0.1) << "the proxy is half transparent";
  EXPECT_GT(most[2], 0.4) << "the probe with a box";
}

TEST_F(ReflectionViews, each_view_shows_values_that_make_sense) {
  const std::vector<vec4> confidence = shown("reflection_confidence"), tiles = shown("ibr_tiles"),
                          layers = shown("ibr_layers"), probes = shown("probes");
  const GeometryPicture seen = geometry();
  bool one = false, two = false, bright = false, dim = false;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    ASSERT_TRUE(confidence[i].x >= 0.0f && confidence[i].x <= 1.0f);
    ASSERT_TRUE(tiles[i].x == 0.0f || tiles[i].x == 1.0f);
    ASSERT_LE(layers[i].x, 2.0f);
    if (!is_floor(seen, i)) {
      ASSERT_EQ(layers[i].x, 0.0f);
      continue;
    }
    one |= layers[i].x == 1.0f, two |= layers[i].x == 2.0f;
    ASSERT_TRUE(probes[i].x >= 0.499f && probes[i].x <= 2.001f) << "the global probe covers what the other leaves";
    bright |= probes[i].x > 1.99f, dim |= probes[i].x < 0.51f;
  }
  EXPECT_TRUE(one && two) << "the wall alone, and the wall behind a hit of screen space";
  EXPECT_TRUE(bright && dim) << "inside the box and outside";
}

TEST_F(ReflectionViews, work_with_every_set_of_tiers) {
  for (const char* tiers : {"cube", "ssr+cube", "ibr+cube"}) {
    set("reflections.tiers", tiers);
    for (const char* view : {"reflection_tier", "reflection_confidence", "ibr_tiles", "ibr_layers", "probes"})
      for (const vec4& value : shown(view)) ASSERT_TRUE(value.x >= 0.0f && value.x <= 65504.0f) << tiers << view;
    const std::vector<vec4> shares = shown("reflection_tier");
    const GeometryPicture seen = geometry();
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (!is_floor(seen, i)) continue;
      ASSERT_LE(shares[i].x + shares[i].y + shares[i].z, 1.002f) << tiers;
      if (std::string(tiers) != "ssr+cube") {
        ASSERT_EQ(shares[i].x, 0.0f);
      }
      if (std::string(tiers) != "ibr+cube") {
        ASSERT_NEAR(shares[i].y, 0.0f, 0.02f) << tiers << i;
      }
    }
  }
}

/// A strip that is smooth beside one that is rough, both reflective, with a tilted card and the sky: most tiles of the
/// reflection images are not drawn. Values must not depend on what earlier frames have left in the device's memory.
// Hard case: reflections.unwritten
TEST_F(ReflectionViews, show_nothing_of_memory_that_the_frame_has_not_written) {
  shining_box({0.0, 2.5, -3.0}, vec3(2.0f, 0.5f, 0.1f), {900.0f, 700.0f, 800.0f});
  Material rough = exact_material(255, 255, 255, 0, 255);
  rough.roughness = 0.8f;
  rough.reflectivity = 1.0f;
  const dmat4 flat = glm::rotate(at(0.0, 0.01, 1.2), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
  scene.draw(scene.mesh(quad(1.2f, scene.material(rough))), flat);
  rough.roughness = 0.0f;
  scene.draw(scene.mesh(quad(0.5f, scene.material(rough))), glm::rotate(at(1.2, 0.5, 1.0), -0.7, dvec3(1.0, 0.0, 0.0)));
  // Frames that fill memory with other values: another mirror all over the picture, seen from elsewhere.
  const ViewSettings wanted = settings;
  const auto fill = [&](const dvec3& eye) {
    settings = look_at(eye, dvec3(0.0), wanted.width, wanted.height);
    for (const char* tiers : {"all", "ibr+cube", "ssr+cube"}) {
      set("reflections.tiers", tiers);
      draw();
    }
    settings = wanted;
  };
  for (const char* tiers : {"cube", "ssr+cube", "ibr+cube", "all"})
    for (const char* view : {"reflection_tier", "reflection_confidence", "ibr_tiles", "ibr_layers", "probes"}) {
      fill({0.0, 3.0, 0.5});
      set("reflections.tiers", tiers);
      const std::vector<vec4> first = shown(view);
      fill({1.0, 0.4, 2.0});
      set("reflections.tiers", tiers);
      const std::vector<vec4> second = shown(view);
      ASSERT_EQ(first.size(), second.size());
      const GeometryPicture seen = geometry();
      for (std::size_t i = 0; i < first.size(); ++i) {
        ASSERT_EQ(first[i], second[i]) << tiers << " " << view << " " << i;
        if (std::string(view) == "probes" || std::string(view) == "ibr_tiles" || seen.is_sky(i)) continue;
        const bool mirrors = seen.texel(i).roughness < 0.39f && seen.texel(i).reflectivity > 0.0f;
        if (mirrors) continue;
        ASSERT_EQ(vec2(first[i]), vec2(0.0f)) << tiers << " " << view << " " << i;
      }
    }
}

// Hard case: reflections.unwritten
TEST_F(ReflectionViews, show_no_screen_space_and_no_proxies_where_no_mirror_is_in_view) {
  draw();
  for (Material& material : scene.assets().materials) material.roughness = 0.8f;
  ++scene.assets().version;
  for (const char* mode : {"tiers", "planar"}) {
    set("reflections.mode", mode);
    for (const char* view : {"reflection_tier", "reflection_confidence", "ibr_layers"})
      for (const vec4& value : shown(view)) ASSERT_EQ(vec2(value), vec2(0.0f)) << mode << " " << view;
  }
}

// Hard case: reflections.room_tiers
TEST_F(ReflectionViews, the_picture_from_a_room_with_fewer_tiers_is_that_of_the_knob) {
  const Entity room = world.create(IbrRoom{.size_m = vec3(20.0f)}, WorldTransform{at(0.0, 1.0, 0.0)});
  const LinearPicture all = shot();
  for (const auto& [tiers, knob] :
       {std::pair(IbrRoomTiers::ibr_cube, "ibr+cube"), std::pair(IbrRoomTiers::ssr_cube, "ssr+cube"),
        std::pair(IbrRoomTiers::cube, "cube")}) {
    set("reflections.tiers", "all");
    world.get<IbrRoom>(room).tiers = tiers;
    const LinearPicture by_room = shot();
    world.get<IbrRoom>(room).tiers = IbrRoomTiers::all;
    set("reflections.tiers", knob);
    EXPECT_EQ(worst_difference(by_room, shot()), 0.0) << knob;
    EXPECT_GT(worst_difference(by_room, all), 0.01) << knob;
  }
}

TEST_F(ReflectionViews, work_in_a_mirrored_picture_and_with_every_proxy_tested) {
  const std::vector<vec4> usual = shown("ibr_layers");
  set("ibr.loop", "naive");
  const std::vector<vec4> naive = shown("ibr_layers");
  for (std::size_t i = 0; i < usual.size(); ++i) ASSERT_EQ(usual[i], naive[i]) << i;
  set("ibr.loop", "tiles");
  set("reflections.mode", "planar");
  for (const char* view : {"ibr_tiles", "ibr_layers"})
    for (const vec4& value : shown(view)) ASSERT_EQ(value.x, 0.0f) << view;
}

TEST_F(ReflectionViews, the_view_of_probes_has_a_sphere_at_each_probe_that_mirrors_its_map) {
  ReflectionCaptures captures = world.resource<ReflectionCaptures>();
  captures.probes = flat_layers({vec4(7.0f), vec4(0.5f)});
  captures.version = 2;
  world.set_resource(captures);
  const auto spheres = [&] {
    const std::vector<vec4> light = shown("probes");
    std::size_t count = 0;
    const GeometryPicture seen = geometry();
    for (std::size_t i = 0; i < light.size(); ++i) count += seen.is_sky(i) && light[i].w > 0.0f ? 1 : 0;
    return count;
  };
  settings = look_at({0.0, 0.8, 3.0}, {0.0, 1.2, 0.0}, 96, 64);
  EXPECT_GT(spheres(), 4u) << "before the sky";
  EXPECT_LT(spheres(), 400u);
  shining_box({0.0, 1.0, 1.5}, vec3(0.5f), vec3(0.1f));
  EXPECT_EQ(spheres(), 0u) << "behind the box";
}

TEST_F(ReflectionViews, the_view_of_probes_shows_radiance_in_whatever_scale_captures_and_frames_are) {
  const std::vector<vec4> usual = shown("probes");
  ReflectionCaptures captures = world.resource<ReflectionCaptures>();
  captures.probes = flat_layers({vec4(0.5f), vec4(0.125f)});
  captures.light_scale = 0.25f;
  captures.version = 2;
  world.set_resource(captures);
  environment().has_exposure = true;
  environment().exposure_ev100 = 14.0f;
  const std::vector<vec4> scaled = shown("probes");
  for (std::size_t i = 0; i < usual.size(); ++i) ASSERT_EQ(usual[i], scaled[i]) << i;
}

TEST_F(ReflectionViews, a_proxy_that_serves_no_surface_at_the_height_is_not_picked) {
  using testing::Contains;
  using testing::HasSubstr;
  set("reflections.tiers", "ibr+cube");
  const IbrRoom room{.size_m = vec3(20.0f)};
  ReflectingHeights heights;
  heights.count = 1;
  const Entity box = world.create(room, heights, WorldTransform{at(0.0, 1.0, 0.0)});
  const std::uint32_t x = settings.width / 2, y = settings.height - 6;
  EXPECT_THAT(lines(x, y), Contains(HasSubstr("proxy: wall, met after")));
  world.get<ReflectingHeights>(box).heights_m[0] = 0.5f;
  EXPECT_THAT(lines(x, y), Contains("proxy: none is met"));
  set("reflections.tiers", "ssr+cube");
  EXPECT_THAT(lines(x, y), testing::Not(Contains(HasSubstr("proxy: wall"))));
}

// Hard case: reflections.two_floors
TEST_F(ReflectionViews, floors_at_several_heights_of_two_rooms_show_and_pick_the_proxies_that_serve_them) {
  const auto strip = [&](double x, double y) {
    Material mirror = exact_material(255, 255, 255, 0, 255);
    mirror.roughness = 0.0f;
    mirror.reflectivity = 1.0f;
    const dmat4 flat = glm::rotate(at(x, y, 3.0), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
    scene.draw(scene.mesh(quad(0.5f, scene.material(mirror))), flat);
  };
  strip(-1.0, 0.25);
  strip(0.2, 0.5);
  strip(1.4, 0.75);
  ReflectingHeights hall, landing;
  hall.count = landing.count = 2;
  hall.heights_m = {0.0f, 0.25f};
  landing.heights_m = {0.75f, 9.0f};
  world.create(IbrRoom{.size_m = vec3(20.0f)}, hall, WorldTransform{at(0.0, 1.0, 0.0)});
  world.create(IbrRoom{.size_m = vec3(16.0f)}, landing, WorldTransform{at(0.0, 1.0, 0.0)});
  set("reflections.tiers", "ibr+cube");
  settings = look_at({0.2, 2.0, 6.5}, {0.2, 0.5, 2.8}, 96, 64);
  const std::vector<vec4> layers = shown("ibr_layers");
  const GeometryPicture seen = geometry();
  std::map<int, std::size_t> pixels;  // by height in quarters of a metre
  std::map<int, uvec2> picked;
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const std::size_t i = std::size_t{y} * settings.width + x;
      if (seen.is_sky(i) || seen.texel(i).reflectivity == 0.0f) continue;
      const double height = seen.position(x, y).y + seen.view.position.y;
      const int quarter = static_cast<int>(std::lround(4.0 * height));
      const bool edge = y % 2 == 1;  // texels show the pixels of even rows and columns
      if (std::abs(height - 0.25 * quarter) > 1e-3 || edge || x % 2 == 1) continue;
      const dvec3 from = seen.position(x, y) + seen.view.position, ray = seen.position(x, y) * dvec3(1.0, -1.0, 1.0);
      const double met_at = from.y + ray.y / ray.z * (-4.0 - from.z);  // the wall reaches up to 7 m
      if (std::abs(met_at - 7.0) < 0.05) continue;
      const bool meets = ray.z < 0.0 && from.z > -4.0 && met_at < 7.0;
      ASSERT_EQ(layers[i].x, meets && quarter != 2 ? 1.0f : 0.0f) << x << " " << y << " " << quarter;
      if (!meets) continue;
      ++pixels[quarter];
      picked[quarter] = {x, y};
    }
  for (int quarter = 0; quarter < 4; ++quarter) {
    ASSERT_GT(pixels[quarter], 20u) << quarter;
    const char* line = quarter == 2 ? "proxy: none is met" : "proxy: wall, met after";
    EXPECT_THAT(lines(picked[quarter].x, picked[quarter].y), testing::Contains(testing::HasSubstr(line))) << quarter;
  }
}

/// A mirror with two sides between two storeys, whose probes reach a little beyond it.
class MirrorBetweenStoreys : public ReflectionFrames {
 protected:
  void SetUp() override {
    ReflectionFrames::SetUp();
    if (IsSkipped()) return;
    sky({0.0f, 0.0f, 5.0f});
    Material mirror = exact_material(255, 255, 255, 0, 255);
    mirror.roughness = 0.0f;
    mirror.reflectivity = 1.0f;
    mirror.double_sided = true;
    const dmat4 flat = glm::rotate(at(0.0, 3.0, 0.0), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
    scene.draw(scene.mesh(quad(4.0f, scene.material(mirror))), flat);
    probe({8.4f, 3.4f, 8.4f}, {0.0, 1.5, 0.0});
    probe({8.2f, 3.4f, 8.2f}, {0.0, 4.5, 0.0});
    capture(world, {}, {vec4(0.0f, 3.0f, 0.0f, 1.0f), vec4(3.0f, 0.0f, 0.0f, 1.0f)});
  }
  /// Sum over the middle of the picture, and that of the view of probes.
  [[nodiscard]] std::pair<vec3, vec3> middle_from(const dvec3& eye, const dvec3& target) {
    settings = look_at(eye, target, 96, 64);
    const LinearPicture drawn = shot();
    const std::vector<vec4> probes = shown("probes");
    vec3 sum(0.0f), mapped(0.0f);
    for (std::uint32_t y = 28; y < 36; ++y)
      for (std::uint32_t x = 40; x < 56; ++x) {
        sum += vec3(pixel(drawn, x, y));
        mapped += vec3(probes[std::size_t{y} * settings.width + x]);
      }
    return {sum, mapped};
  }
};

// Hard case: reflections.from_below
TEST_F(MirrorBetweenStoreys, shows_on_each_side_the_storey_of_that_side) {
  for (const auto& [sum, mapped] :
       {middle_from({0.3, 1.2, 1.5}, {0.0, 3.0, 0.0}), middle_from({0.3, 1.2, 3.0}, {0, 3, 0})}) {
    EXPECT_GT(sum.y, 100.0f) << "from below, the lower storey";
    EXPECT_EQ(sum.x, 0.0f);
    EXPECT_EQ(mapped.x, 0.0f);
  }
  const auto [sum, mapped] = middle_from({0.3, 4.6, 3.0}, {0.0, 3.0, 0.0});
  EXPECT_GT(sum.x, 100.0f) << "from above, the upper storey";
  EXPECT_EQ(sum.y, 0.0f);
  EXPECT_EQ(mapped.y, 0.0f);
}

TEST_F(ReflectionViews, picked_pixels_name_their_tier) {
  using testing::Contains;
  using testing::HasSubstr;
  const std::vector<vec4> shares = shown("reflection_tier");
  const auto pixel_of = [&](int tier) {
    const auto best = std::ranges::max_element(shares, {}, [&](const vec4& s) { return s[tier]; });
    const auto index = static_cast<std::uint32_t>(best - shares.begin());
    return uvec2(index % settings.width, index / settings.width);
  };
  const uvec2 screen = pixel_of(0), box = pixel_of(2);
  EXPECT_THAT(lines(screen.x, screen.y), Contains(HasSubstr("reflection: screen space")));
  EXPECT_THAT(lines(box.x, box.y), Contains(HasSubstr("reflection: ")));
  EXPECT_THAT(lines(screen.x, screen.y), Contains(HasSubstr("proxy: wall, met after")));
  set("reflections.tiers", "cube");
  EXPECT_THAT(lines(box.x, box.y), Contains("reflection: probes"));
  settings.visualizer = "none";
  EXPECT_THAT(lines(0, 0), testing::Not(Contains(HasSubstr("reflection: ")))) << "the sky";
}

TEST_F(ReflectionViews, a_picked_distance_is_that_of_the_traced_ray) {
  set("reflections.tiers", "ibr+cube");
  const std::vector<vec4> shares = shown("reflection_tier");
  const GeometryPicture seen = geometry();
  std::size_t compared = 0;
  for (const std::uint32_t x : {20u, 48u, 70u}) {
    const std::uint32_t y = settings.height - 6;
    if (!is_floor(seen, std::size_t{y} * settings.width + x)) continue;
    const dvec3 from = seen.position(x, y) + seen.view.position;
    const dvec3 ray = glm::normalize(seen.position(x, y) * dvec3(1.0, -1.0, 1.0));
    const double expected = (-4.0 - from.z) / ray.z;
    for (const std::string& line : lines(x, y)) {
      const std::size_t at = line.find("met after ");
      if (at == std::string::npos) continue;
      EXPECT_NEAR(std::stod(line.substr(at + 10)), expected, 0.02);
      ++compared;
    }
  }
  EXPECT_GT(compared, 0u);
}

TEST_F(ReflectionViews, the_picture_with_traced_reflections_is_antialiased_as_the_picture_is) {
  draw();
  const GeometryPicture seen = geometry();
  const auto tracer = value_of(make_scene_tracer(world, *executor, seen.view.position));
  world.set_resource(trace_radiance(
      {.world = world, .geometry = seen, .tracer = *tracer, .executor = *executor, .settings = {.rays = 1}}));
  const auto shown_as = [&](const char* visualizer, const char* antialiasing) {
    set("lighting.antialiasing", antialiasing);
    settings.visualizer = visualizer;
    draw();
    return picture().rgba;
  };
  const auto smooth = shown_as("none", "smaa");
  EXPECT_EQ(shown_as("reflection_reference", "smaa"), smooth);
  EXPECT_GT(differences(shown_as("reflection_reference", "off"), smooth), 50u) << "edges are smoothed";
  world.remove_resource<TracedReflections>();
}

TEST_F(ReflectionFrames, references_show_reflections_of_rough_surfaces_without_a_probe) {
  sky(vec3(0.1f));
  mirror_floor(0.6f);
  shining_box({0.0, 0.5, 0.0}, vec3(0.4f, 0.5f, 0.3f), vec3(4.0f));
  const LinearPicture usual = shot();
  EXPECT_FALSE(module_state("reflections").demanded);
  const GeometryPicture seen = geometry();
  const auto tracer = value_of(make_scene_tracer(world, *executor, seen.view.position));
  const TracedReflections rays = trace_radiance(
      {.world = world, .geometry = seen, .tracer = *tracer, .executor = *executor, .settings = {.rays = 32}});
  world.set_resource(rays);
  const LinearPicture traced = shot();
  world.remove_resource<TracedReflections>();
  world.set_resource(ReflectionOverride::no_specular);
  const LinearPicture composed = compose_reflections(shot(), seen, world, rays);
  world.remove_resource<ReflectionOverride>();
  EXPECT_GT(worst_difference(traced, usual), 0.5);
  EXPECT_LT(worst_difference(traced, composed), 0.02) << "rounded values of the geometry buffer";
}

}  // namespace
}  // namespace gloam::test
