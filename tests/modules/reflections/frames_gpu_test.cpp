// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "modules/accuracy/module.h"
#include "modules/reflections/override.h"
#include "modules/reflections/reference/reflection_tracing.h"
#include "modules/reflections/relighting/light_states.h"
#include "tests/modules/reflections/support/grazing_view.h"
#include "tests/modules/reflections/support/reflection_frames.h"

namespace gloam::test {
namespace {

TEST_F(ReflectionFrames, mode_off_is_the_picture_without_the_module) {
  furnish();
  probe(vec3(6.0f), {0.0, 1.0, 0.0});
  capture(world, {}, {vec4(1.0f)});
  set("reflections.mode", "off");
  draw();
  const Picture off = picture();
  settings.without = {"reflections"};
  draw();
  const Picture without = picture();
  int worst = 0;
  for (std::size_t i = 0; i < off.rgba.size(); ++i)
    worst = std::max(worst, std::abs(int{off.rgba[i]} - int{without.rgba[i]}));
  EXPECT_LE(worst, 1);
  settings.without.clear();
  set("reflections.mode", "tiers");
  draw();
  EXPECT_GT(differences(picture().rgba, off.rgba), 1000u) << "the floor shows the boxes";
}

TEST_F(ReflectionFrames, in_a_white_surrounding_the_weights_of_all_tiers_sum_to_1) {
  sky(vec3(1.0f));
  mirror_floor(0.2f);
  shining_box({-0.9, 0.5, 0.0}, vec3(0.4f, 0.5f, 0.3f), vec3(1.0f));
  shining_box({0.8, 0.35, -0.6}, vec3(0.3f, 0.35f, 0.5f), vec3(1.0f));
  std::vector<vec4> proxies;
  for (int i = 0; i < 6; ++i) {
    proxy(vec2(2.0f, 1.5f), at(-2.0 + 0.8 * i, 0.8, -1.0 - 0.5 * i));
    proxies.emplace_back(static_cast<float>(i % 4) / 3.0f);  // premultiplied: white at several opacities
  }
  probe(vec3(3.0f), {0.0, 0.5, 0.0});
  probe(vec3(9.0f), {1.0, 0.5, 0.0});
  probe({}, {}, true);
  capture(world, proxies, {vec4(1.0f), vec4(1.0f), vec4(1.0f)});
  const std::vector<std::pair<const char*, const char*>> changes = {{"reflections.tiers", "cube"},
                                                                    {"reflections.tiers", "ssr+cube"},
                                                                    {"reflections.tiers", "ibr+cube"},
                                                                    {"reflections.tiers", "all"},
                                                                    {"ibr.layers", "1"},
                                                                    {"ibr.layers", "2"},
                                                                    {"ibr.layers", "3"},
                                                                    {"ibr.sort", "off"},
                                                                    {"ssr.resolution", "full"},
                                                                    {"reflections.normal", "pixel"},
                                                                    {"reflections.normal", "up"},
                                                                    {"reflections.bump", "off"},
                                                                    {"reflections.dilation", "off"},
                                                                    {"reflections.blur", "off"},
                                                                    {"reflections.roughness", "constant"}};
  set("reflections.mode", "off");
  const LinearPicture expected = shot();
  set("reflections.mode", "tiers");
  EXPECT_LT(worst_difference(shot(), expected), 4e-3);
  for (const auto& [knob, value] : changes) {
    set(knob, value);
    EXPECT_LT(worst_difference(shot(), expected), 4e-3) << knob << " = " << value;
  }
}

TEST_F(ReflectionFrames, screen_space_shows_what_traced_rays_meet) {
  furnish();
  set("reflections.tiers", "ssr+cube");
  set("reflections.blur", "off");
  for (const char* march : {"hierarchical", "constant"})
    for (const char* resolution : {"full", "half"}) {
      set("ssr.march", march);
      set("ssr.resolution", resolution);
      const Agreement found = compare_with_traced();
      EXPECT_GT(found.confident, 250u) << march << ", " << resolution;
      // The edges of boxes fall into one pixel or its neighbour; a block of a half-size image has one ray. A shift by
      // half a pixel would make 0.22 different.
      const double most = std::string(resolution) == "full" ? 0.05 : 0.18;
      EXPECT_LT(static_cast<double>(found.different), most * static_cast<double>(found.confident))
          << march << ", " << resolution;
    }
}

// Hard case: reflections.grazing_floor
TEST_F(ReflectionFrames, screen_space_shows_what_traced_rays_meet_where_the_camera_grazes_the_mirror) {
  environment() = {.sky_zenith = {0.2f, 0.4f, 1.0f}, .sky_horizon = {0.7f, 0.6f, 0.5f}, .sky_ground = vec3(0.3f)};
  mirror_floor();
  set("reflections.tiers", "ssr+cube");
  set("reflections.blur", "off");
  set("ssr.resolution", "full");
  for (const double degrees : {0.1, 0.3, 1.0, 3.0}) {
    const GrazingView grazing(degrees);
    std::vector<Entity> pile;
    for (int band = 0; band < GrazingView::kBands; ++band)
      pile.push_back(scene.draw(scene.mesh(box(vec3(1.0f), shining(GrazingView::light(band)))), grazing.box(band)));
    settings = grazing.camera();
    for (const char* march : {"hierarchical", "constant"}) {
      set("ssr.march", march);
      const Agreement found = compare_with_traced();
      EXPECT_GT(found.confident, 250u) << march << ", " << degrees;
      // Edges fall into one pixel or its neighbour. Traced rays begin above the floor by 4e-5 of their distance, which
      // moves the three upper edges of boxes in half of the picture's columns.
      const double moved =
          3.0 * 0.5 * grazing.picture_share(4e-5 * GrazingView::kAway) * settings.width * settings.height;
      EXPECT_LT(static_cast<double>(found.different), 0.05 * static_cast<double>(found.confident) + moved)
          << march << ", " << degrees;
    }
    for (const Entity entity : pile) world.destroy(entity);
  }
}

TEST_F(ReflectionFrames, a_contact_is_sharp) {
  // The floor beside a box shows the box, also with a rough floor: the blur is narrow there.
  sky(vec3(0.05f));
  mirror_floor(0.25f);
  shining_box({0.0, 0.5, 0.0}, vec3(0.8f, 0.5f, 0.3f), vec3(2.0f));
  const LinearPicture picture = shot();
  const GeometryPicture seen = geometry();
  for (std::uint32_t x = 38; x < 56; ++x) {
    std::uint32_t y = settings.height - 1;
    const auto is_floor = [&](std::uint32_t row) {
      return std::abs(seen.position(x, row).y + seen.view.position.y) < 1e-3;
    };
    while (is_floor(y)) --y;
    EXPECT_GT(pixel(picture, x, y + 2).g, 1.4) << x << ", the second row of the floor";
  }
}

TEST_F(ReflectionFrames, pictures_are_reproducible_and_do_not_depend_on_the_number_of_threads) {
  furnish(0.3f);
  for (int i = 0; i < 40; ++i) proxy(vec2(0.7f, 0.9f), at(-3.0 + 0.15 * i, 0.6, -2.0 - 0.1 * i));
  probe(vec3(6.0f), {0.0, 1.0, 0.0});
  std::vector<vec4> colors;
  for (int i = 0; i < 40; ++i) colors.push_back(0.25f * vec4(static_cast<float>(i % 5), 1.0f, 0.5f, 4.0f));
  capture(world, colors, {vec4(0.3f)});
  const LinearPicture first = shot();
  EXPECT_EQ(shot().rgba, first.rgba);
  for (const std::uint32_t threads : {1u, 8u}) {
    renderer.reset();
    executor = make_pool_executor(threads);
    RendererOptions options;
    options.device = shared_device();
    options.executor = executor.get();
    options.log = &log;
    options.modules = make_modules();
    renderer = value_of(Renderer::create(std::move(options)));
    set("shadows.mode", "off");
    EXPECT_EQ(shot().rgba, first.rgba) << threads << " threads";
  }
}

// Hard case: reflections.odd_sizes
TEST_F(ReflectionFrames, odd_sizes_and_resizing_draw_what_a_view_of_that_size_draws) {
  furnish(0.2f);
  proxy(vec2(3.0f), at(0.0, 1.0, -3.0));
  capture(world, {vec4(0.5f, 0.25f, 1.0f, 1.0f)}, {});
  const auto sized = [&](std::uint32_t width, std::uint32_t height, std::uint32_t view) {
    settings = look_at(dvec3(0.4, 1.2, 4.0), dvec3(0.0, 0.3, 0.0), width, height);
    settings.id = ViewId{view};
    draw();
    return linear(view);
  };
  static_cast<void>(sized(96, 64, 0));
  std::uint32_t id = 1;
  for (const auto& [width, height] : {std::pair{61u, 37u}, {7u, 5u}, {1u, 1u}, {96u, 64u}}) {
    const LinearPicture resized = sized(width, height, 0), fresh = sized(width, height, id++);
    EXPECT_EQ(resized.rgba, fresh.rgba) << width << " x " << height;
    for (const float value : fresh.rgba) ASSERT_TRUE(std::isfinite(value)) << width << " x " << height;
  }
}

// Hard case: reflections.nan_light
TEST_F(ReflectionFrames, light_that_is_no_number_does_not_spread) {
  furnish(0.3f);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  shining_box({0.0, 0.4, 0.6}, vec3(0.2f, 0.4f, 0.2f), vec3(nan));
  for (const char* resolution : {"half", "full"}) {
    set("ssr.resolution", resolution);
    const LinearPicture picture = shot();
    const GeometryPicture seen = geometry();
    std::size_t bad = 0, floor = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        if (seen.is_sky(std::size_t{y} * settings.width + x)) continue;
        if (std::abs(seen.position(x, y).y + seen.view.position.y) > 1e-3) continue;
        const dvec3 light = pixel(picture, x, y);
        ++floor;
        for (int c = 0; c < 3; ++c) bad += std::isfinite(light[c]) && light[c] >= 0.0 ? 0 : 1;
      }
    EXPECT_EQ(bad, 0u) << resolution;
    EXPECT_GT(floor, 2000u);
  }
}

TEST_F(ReflectionFrames, two_worlds_of_a_renderer_keep_their_captures_apart) {
  // Both captures have version 1.
  World other;
  renderer->prepare_world(other);
  const auto fill = [&](World& what, const vec4& proxy_color, const vec4& probe_color) {
    SceneMaker maker(what);
    Material mirror = exact_material(255, 255, 255, 0, 255);
    mirror.reflectivity = 1.0f;
    maker.draw(maker.mesh(quad(8.0f, maker.material(mirror))),
               glm::rotate(dmat4(1.0), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0)));
    IbrProxy wall;
    wall.size_m = vec2(3.0f);
    what.create(wall, WorldTransform{at(0.0, 1.0, -3.0)});
    CubeProbe box;
    box.size_m = vec3(12.0f);
    what.create(box, WorldTransform{at(0.0, 1.0, 0.0)});
    capture(what, {proxy_color}, {probe_color});
  };
  fill(world, vec4(1.0f, 0.0f, 0.0f, 1.0f), vec4(0.0f, 0.0f, 0.5f, 1.0f));
  fill(other, vec4(0.0f, 1.0f, 0.0f, 1.0f), vec4(0.25f, 0.25f, 0.0f, 1.0f));
  ViewSettings second = settings;
  second.id = ViewId{7};
  for (int i = 0; i < 3; ++i) {
    draw(world, settings);
    const LinearPicture a = linear();
    draw(other, second);
    const LinearPicture b = linear(7);
    std::size_t red = 0, green = 0, blue = 0, yellow = 0, wrong = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const dvec3 p = pixel(a, x, y), q = pixel(b, x, y);
        red += p.r > 0.5 ? 1 : 0, blue += p.b > 0.3 ? 1 : 0, wrong += p.g <= 1e-3 ? 0 : 1;
        green += q.g > 0.5 ? 1 : 0, yellow += q.r > 0.15 ? 1 : 0, wrong += q.b <= 1e-3 ? 0 : 1;
      }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(std::min({red, green, blue, yellow}), 200u);
  }
  renderer->release_world(other);
}

TEST_F(ReflectionFrames, other_captures_of_a_world_are_uploaded) {
  mirror_floor();
  proxy(vec2(3.0f), at(0.0, 1.0, -3.0));
  capture(world, {vec4(1.0f, 0.0f, 0.0f, 1.0f)}, {}, 1);
  const auto brightest = [&](const LinearPicture& picture, std::size_t channel) {
    float most = 0.0f;
    for (std::size_t i = channel; i < picture.rgba.size(); i += 4) most = std::max(most, picture.rgba[i]);
    return most;
  };
  EXPECT_GT(brightest(shot(), 0), 0.5f);
  capture(world, {vec4(0.0f, 1.0f, 0.0f, 1.0f)}, {}, 2);
  const LinearPicture green = shot();
  EXPECT_EQ(brightest(green, 0), 0.0f);
  EXPECT_GT(brightest(green, 1), 0.5f);
  world.set_resource(ReflectionCaptures{});
  EXPECT_EQ(brightest(shot(), 1), 0.0f) << "without captures the proxy is not shown";
}

TEST_F(ReflectionFrames, lights_as_captured_leave_the_picture_as_it_is) {
  furnish(0.1f);
  proxy(vec2(3.0f), at(0.0, 1.0, -3.0));
  probe(vec3(8.0f), {0.0, 1.0, 0.0});
  Light lamp;
  lamp.intensity = 8.0f;
  lamp.range_m = 20.0f;
  const Entity entity = light(lamp, {1.0, 2.5, 2.0});
  capture(world, {vec4(0.5f)}, {vec4(0.25f)});
  auto& captures = world.resource<ReflectionCaptures>();
  captures.lights = light_states(world);
  PlacedProxy placed;
  ASSERT_EQ(place_proxy(captures.proxy_entities[0], world.get<IbrProxy>(captures.proxy_entities[0]), at(0.0, 1.0, -3.0),
                        placed),
            ProxyPlacement::placed);
  captures.proxy_parts.resize(1);
  captures.proxy_parts[0].lamps_lux = illuminances(captures.lights, proxy_patches(placed, 0.0f));
  const LinearPicture on = shot();
  set("reflections.light_scale", "off");
  EXPECT_EQ(shot().rgba, on.rgba);
  set("reflections.light_scale", "on");
  world.get<Light>(entity).intensity = 0.0f;
  const LinearPicture dark = shot();
  set("reflections.light_scale", "off");
  const LinearPicture unscaled = shot();
  double with = 0.0, without = 0.0;
  for (std::size_t i = 0; i < dark.rgba.size(); ++i) {
    EXPECT_LE(dark.rgba[i], unscaled.rgba[i] + 1e-3f);
    with += static_cast<double>(dark.rgba[i]), without += static_cast<double>(unscaled.rgba[i]);
  }
  EXPECT_LT(with, 0.98 * without) << "captured colours are dimmed";
}

// Hard case: reflections.camera_on_plane
TEST_F(ReflectionFrames, any_camera_and_any_knobs_give_numbers) {
  furnish(0.2f);
  proxy(vec2(3.0f), at(0.0, 1.0, -3.0));
  proxy(vec2(4.0f), glm::rotate(at(0.0, 3.0, 0.0), 1.57079632679489661923, dvec3(1.0, 0.0, 0.0)));
  probe(vec3(6.0f), {0.0, 1.0, 0.0});
  probe(vec3(0.0f), {0.0, 1.0, 0.0});
  capture(world, {vec4(0.5f), vec4(0.2f)}, {vec4(0.3f), vec4(99.0f)});
  const ViewSettings usual = settings;
  std::vector<ViewSettings> cameras = {
      look_at({0.0, 3.0, 0.0}, {0.0, 0.0, 0.001}, 48, 32), look_at({0.0, 1.0, 0.0}, {0.0, 3.0, 0.001}, 48, 32),
      look_at({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 48, 32),   look_at({0.0, 0.001, 4.0}, {0.0, 0.0, 0.0}, 48, 32),
      look_at({0.0, -1.0, 4.0}, {0.0, 0.0, 0.0}, 48, 32),  look_at({0.0, 1.0, 400.0}, {0.0, 0.0, 0.0}, 48, 32)};
  cameras.push_back(usual);
  cameras.back().camera.orthographic = true;
  cameras.back().camera.half_height_m = 2.0f;
  for (const auto& [knob, value] :
       std::vector<std::pair<const char*, const char*>>{{"ssr.march", "hierarchical"},
                                                        {"ssr.march", "constant"},
                                                        {"reflections.normal", "pixel"},
                                                        {"reflections.roughness", "constant"}}) {
    set(knob, value);
    for (const ViewSettings& camera : cameras) {
      settings = camera;
      for (const float light : shot().rgba) ASSERT_TRUE(std::isfinite(light) && light >= 0.0f) << knob << value;
    }
  }
}

}  // namespace
}  // namespace gloam::test
