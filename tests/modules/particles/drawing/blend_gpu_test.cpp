// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "modules/particles/emitters/kinds.h"
#include "tests/modules/particles/support/particle_stage.h"
#include "tests/support/worse.h"

namespace gloam::test {
namespace {

double wave(double x) {
  const double t = 2.0 * (x - std::floor(x)) - 1.0;
  return 4.0 * t * (1.0 - std::abs(t));
}

/// Share of a sprite's opacity at a corner-relative place.
double shape(double x, double y, double u, double v, double erosion) {
  const double inside = std::max(1.0 - x * x - y * y, 0.0);
  const double wu = u + 0.22 * wave(1.3 * v + 0.37), wv = v + 0.22 * wave(1.3 * u + 0.37);
  const double noise =
      0.5 + 0.16 * (wave(0.55 * wu) + wave(0.61 * wv)) + 0.09 * (wave(1.37 * wv + 0.19) + wave(1.21 * wu + 0.19));
  const double body = std::clamp((inside + (noise - 1.0) * erosion) / (1.0 - 0.6 * erosion), 0.0, 1.0);
  return inside * body * (2.0 - body);
}

/// The particles over a picture, in double: each over those behind it.
std::vector<double> blended(const ParticleCopy& copy, const std::vector<float>& before, EmitterKind kind) {
  const KindProperties& properties = kind_properties(kind);
  std::vector<shaders::Particle> particles = copy.drawn();
  std::ranges::stable_sort(particles, [&](const auto& a, const auto& b) { return copy.depth(a) > copy.depth(b); });
  std::vector<double> picture(before.begin(), before.end());
  const glm::dmat4 clip(copy.view.clip_from_relative);
  const std::uint32_t width = copy.view.width, height = copy.view.height;
  for (const shaders::Particle& p : particles) {
    const double depth = copy.depth(p), cool = static_cast<double>(p.life) * static_cast<double>(p.life);
    const dvec4 middle = clip * dvec4(dvec3(p.position), 1.0);
    const double half_width = 0.5 * width * static_cast<double>(p.radius_m * copy.view.clip_from_view[0][0]) / depth;
    const double half_height = 0.5 * height * static_cast<double>(p.radius_m * copy.view.clip_from_view[1][1]) / depth;
    const double x0 = (0.5 + 0.5 * middle.x / middle.w) * width, y0 = (0.5 - 0.5 * middle.y / middle.w) * height;
    const dvec3 emission = dvec3(properties.emission) * glm::mix(dvec3(1.0), dvec3(0.55, 0.2, 0.06), cool);
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) {
        const double cx = (x + 0.5 - x0) / half_width, cy = -(y + 0.5 - y0) / half_height;
        if (cx * cx + cy * cy >= 1.0) continue;
        const double c = std::cos(static_cast<double>(p.angle)), s = std::sin(static_cast<double>(p.angle));
        const double u = c * cx - s * cy + 0.173 * ((p.look >> 16) & 0xFFu);
        const double v = s * cx + c * cy + 0.173 * (p.look >> 24);
        const double alpha =
            static_cast<double>(p.opacity) * shape(cx, cy, u, v, static_cast<double>(properties.erosion));
        const double cover = alpha * static_cast<double>(properties.cover);
        for (int i = 0; i < 3; ++i) {
          double& value = picture[4 * (std::size_t{y} * width + x) + static_cast<std::size_t>(i)];
          const double light = static_cast<double>(copy.constants.unlit[i] * properties.albedo[i]);
          value = light * cover + emission[i] * alpha + (1.0 - cover) * value;
        }
      }
  }
  return picture;
}

using ParticleBlend = ParticleTest;

TEST_F(ParticleBlend, particles_lie_over_each_other_in_the_order_of_their_depths) {
  for (const EmitterKind kind : {EmitterKind::smoke, EmitterKind::fog, EmitterKind::fire, EmitterKind::dust}) {
    ParticleStage stage;
    stage.set("particles.light", "off");
    auto& sky = stage.world.resource<SceneEnvironment>();
    sky.sky_zenith = sky.sky_horizon = vec3(0.7f, 0.3f, 0.2f);
    sky.sky_ground = vec3(0.2f, 0.5f, 1.3f);
    stage.emitter(cloud(kind, 180.0f));
    ViewSettings view = front();
    view.without = {"particles"};
    stage.draw(view);
    const std::vector<float> before = stage.linear();
    view.without.clear();
    stage.draw(view);
    const ParticleCopy copy = stage.copy();
    ASSERT_GT(copy.draws.drawn, 100u);
    const std::vector<double> expected = blended(copy, before, kind);
    const std::vector<float> found = stage.linear();
    double worst = 0.0, changed = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (i % 4 == 3) continue;
      // The target rounds to half floats after each sprite.
      worst = worse(worst, std::abs(static_cast<double>(found[i]) - expected[i]) / (0.1 + expected[i]));
      changed = std::max(changed, std::abs(expected[i] - static_cast<double>(before[i])));
    }
    EXPECT_LT(worst, 0.02) << static_cast<int>(kind);
    EXPECT_GT(changed, 0.05);
  }
}

/// No drawn particle is farther than one before it by more than a quantum.
void expect_order(const ParticleCopy& copy, double quantum_m) {
  double nearest = std::numeric_limits<double>::infinity();
  std::uint32_t last_key = 0;
  for (std::uint32_t i = 0; i < copy.draws.drawn; ++i) {
    const std::uint32_t place = copy.order.at(i);
    EXPECT_GE(copy.keys.at(place), last_key);
    last_key = copy.keys.at(place);
    const double depth = copy.depth(copy.particles.at(place));
    EXPECT_LE(depth, nearest + quantum_m * 1.01 + 1e-5);
    nearest = std::min(nearest, depth);
  }
  std::vector<std::uint32_t> all = copy.order;
  std::ranges::sort(all);
  for (std::uint32_t i = 0; i < all.size(); ++i) ASSERT_EQ(all[i], i) << "each place is there once";
}

TEST_F(ParticleBlend, order_is_right_to_one_quantum_with_one_and_with_two_digits) {
  for (const float rate : {200.0f, 3000.0f}) {
    ParticleStage stage;
    stage.emitter(cloud(EmitterKind::smoke, rate));
    stage.draw(front());
    const ParticleCopy copy = stage.copy();
    const VisibleEmitter& seen = stage.world.view_resource<VisibleEmitters>(ViewId{0}).emitters.at(0);
    EXPECT_EQ(copy.two_digits, rate > 256.0f);
    EXPECT_GT(copy.draws.drawn, rate * 0.9f);
    expect_order(copy, (seen.far_m - seen.near_m) / (copy.two_digits ? 65280.0 : 255.0));
  }
}

TEST_F(ParticleBlend, emitters_that_overlap_are_one_cloud_and_others_lie_behind_each_other) {
  ParticleStage stage;
  stage.emitter(cloud(EmitterKind::smoke, 300.0f), {0.0, 0.0, 0.0});
  stage.emitter(cloud(EmitterKind::fog, 300.0f), {0.3, 0.0, 0.4});
  stage.emitter(cloud(EmitterKind::fire, 300.0f), {0.0, 0.0, -30.0});
  stage.draw(front());
  const ParticleCopy copy = stage.copy();
  EXPECT_GT(copy.draws.drawn, 700u);
  expect_order(copy, 12.0 / 32640.0);
}

TEST_F(ParticleBlend, the_picture_repeats_to_the_bit_for_every_number_of_threads_and_way_to_a_time) {
  std::vector<float> first;
  for (const std::uint32_t threads : {2u, 1u, 5u}) {
    ParticleStage stage(make_pool_executor(threads));
    stage.emitter(cloud(EmitterKind::smoke, 700.0f));
    stage.emitter(cloud(EmitterKind::fire, 200.0f), {0.5, 0.0, 0.5});
    stage.lamp({-2.0, 0.0, 0.0}, vec3(1.0f, 0.6f, 0.3f), 30.0f);
    double time = 0.0;
    if (threads != 1)  // frames on the way do not matter
      for (; time < 0.5 - 1e-6; time += threads == 2 ? 1.0 / 60.0 : 1.0 / 24.0) {
        stage.set_time(time);
        stage.draw(front());
      }
    stage.set_time(threads == 1 ? 0.5 : time);
    stage.draw(front());
    if (first.empty()) first = stage.linear();
    EXPECT_TRUE(stage.linear() == first) << threads << " threads";
  }
  EXPECT_GT(first.size(), 0u);
}

// Hard case: further.time_backwards
TEST_F(ParticleBlend, time_that_runs_backwards_shows_what_it_showed) {
  ParticleStage stage;
  stage.emitter(cloud(EmitterKind::smoke, 300.0f));
  stage.lamp({-2.0, 0.0, 0.0}, vec3(1.0f, 0.6f, 0.3f), 30.0f);
  std::vector<std::vector<float>> shown;
  for (int frame = 0; frame < 8; ++frame) {
    stage.set_time(0.25 * frame - 1.0);
    stage.draw(front());
    shown.push_back(stage.linear());
  }
  for (int frame = 7; frame-- > 0;) {
    stage.set_time(0.25 * frame - 1.0);
    stage.draw(front());
    EXPECT_TRUE(stage.linear() == shown[static_cast<std::size_t>(frame)]) << frame;
    EXPECT_FALSE(stage.linear() == shown[static_cast<std::size_t>(frame) + 1]) << frame;
  }
}

TEST_F(ParticleBlend, an_emitter_that_was_out_of_view_looks_as_if_it_had_been_in_view) {
  const auto show = [&](bool away) {
    ParticleStage stage;
    stage.emitter(cloud(EmitterKind::smoke, 300.0f));
    for (int i = 0; i < 40; ++i) {
      stage.set_time(i / 60.0);
      const bool hidden = away && i > 3 && i < 39;
      stage.draw(hidden ? look_at(dvec3(0.0, 0.3, 9.0), dvec3(0.0, 0.3, 20.0), 64, 48) : front());
      EXPECT_EQ(stage.has_particles(), !hidden);
    }
    return stage.linear();
  };
  EXPECT_TRUE(show(true) == show(false));
}

// Hard case: particles.camera_inside, further.camera_inside_emitter
TEST_F(ParticleBlend, a_camera_inside_the_cloud_sees_finite_light_and_no_sprite_before_the_near_plane) {
  ParticleStage stage;
  ParticleEmitter fog = cloud(EmitterKind::fog, 400.0f);
  fog.size_m = 1.5f;
  stage.emitter(fog);
  stage.lamp({-0.2, 0.1, 0.0}, vec3(1.0f), 1e6f);
  std::vector<float> before;
  for (int i = 0; i < 60; ++i) {
    const double z = 1.0 - 0.033 * i;
    stage.draw(look_at(dvec3(0.0, 0.0, z), dvec3(0.0, 0.0, z - 1.0), 64, 48));
    const ParticleCopy copy = stage.copy();
    for (const shaders::Particle& p : copy.drawn()) EXPECT_GT(copy.depth(p), static_cast<double>(copy.view.near_m));
    for (const float value : stage.linear()) ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
  }
}

TEST_F(ParticleBlend, sprites_fade_where_they_meet_a_surface_and_are_hidden_behind_it) {
  ParticleStage stage;
  stage.set("particles.light", "off");
  stage.world.resource<SceneEnvironment>().sky_ground = vec3(4.0f);
  Material black;
  black.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  black.metallic = 0.0f;
  stage.scene.draw(stage.scene.mesh(quad(30.0f, stage.scene.material(black))));
  ParticleEmitter one = cloud(EmitterKind::dust, 200.0f);
  one.size_m = 1.0f;
  one.speed = 0.0f;
  one.box_m = vec3(1.0f, 1.0f, 0.0f);
  const auto light_at = [&](double z) {
    ParticleStage& s = stage;
    const Entity emitter = s.emitter(one, {0.0, 0.0, z});
    s.draw(look_at(dvec3(0.0, 0.0, 5.0), dvec3(0.0), 64, 48));
    ViewSettings without = look_at(dvec3(0.0, 0.0, 5.0), dvec3(0.0), 64, 48);
    const std::vector<float> with = s.linear();
    without.without = {"particles"};
    s.draw(without);
    const std::vector<float> plain = s.linear();
    double sum = 0.0;
    for (std::size_t i = 0; i < with.size(); ++i) sum += static_cast<double>(with[i] - plain[i]);
    s.world.destroy(emitter);
    return sum;
  };
  const double before = light_at(1.0), touching = light_at(0.12), behind = light_at(-0.5);
  EXPECT_GT(before, 100.0);
  EXPECT_GT(touching, 0.05 * before);
  EXPECT_LT(touching, 0.8 * before);
  EXPECT_EQ(behind, 0.0);
}

// Hard case: particles.million
TEST_F(ParticleBlend, a_million_particles_are_sorted_and_more_are_thinned) {
  ParticleStage stage;
  ParticleEmitter dust = cloud(EmitterKind::dust, 1e6f, 3.0f);
  dust.size_m = 0.004f;
  stage.emitter(dust);
  stage.draw(front());
  const ParticleCopy copy = stage.copy();
  EXPECT_GT(copy.draws.drawn, 800000u);
  EXPECT_LE(copy.draws.drawn, 1000000u);
  EXPECT_EQ(stage.world.view_resource<VisibleEmitters>(ViewId{0}).alive, 1000000u - 1u);
  EXPECT_NEAR(stage.world.resource<EmitterSet>().left_out, 2e6, 10.0);
  std::uint32_t last = 0;
  for (std::uint32_t i = 0; i < copy.draws.drawn; ++i) {
    ASSERT_GE(copy.keys[copy.order[i]], last);
    last = copy.keys[copy.order[i]];
  }
}

TEST_F(ParticleBlend, a_picked_pixel_counts_the_sprites_of_each_emitter) {
  ParticleStage stage;
  const Entity smoke = stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  stage.emitter(cloud(EmitterKind::fire, 100.0f), {0.0, 0.0, -20.0});
  stage.world.resource<SceneNames>().add("node", "chimney", smoke);
  stage.lamp({-2.0, 0.0, 0.0}, vec3(1.0f), 30.0f);
  const std::vector<vec4> shown = stage.shown(front(), "overdraw");
  const auto lines_at = [&](std::uint32_t x, std::uint32_t y) {
    std::vector<std::string> lines;
    for (const std::string& line : value_of(stage.renderer->pick(stage.world, ViewId{0}, x, y)))
      if (line.starts_with("particles")) lines.push_back(line);
    return lines;
  };
  std::size_t most = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) most = shown[i].x > shown[most].x ? i : most;
  const auto lines = lines_at(static_cast<std::uint32_t>(most % 64), static_cast<std::uint32_t>(most / 64));
  unsigned counted = 0;
  for (const std::string& line : lines) {
    unsigned sprites = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "particles: %u sprites", &sprites), 1) << line;
    counted += sprites;
  }
  EXPECT_GE(static_cast<float>(counted), shown[most].x);
  EXPECT_LE(static_cast<float>(counted), 2.0f * shown[most].x) << "noise hides some";
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines[0].find("smoke \"chimney\" (150 alive, 1 lights)"), std::string::npos) << lines[0];
  EXPECT_TRUE(lines_at(0, 0).empty());
}

TEST_F(ParticleBlend, overdraw_counts_the_sprites_at_each_pixel) {
  ParticleStage stage;
  stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  const std::vector<vec4> shown = stage.shown(front(), "overdraw");
  const ParticleCopy copy = stage.copy();
  const glm::dmat4 clip(copy.view.clip_from_relative);
  double worst = 0.0, most = 0.0, all = 0.0;
  for (std::uint32_t y = 0; y < 48; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      int discs = 0;
      for (const shaders::Particle& p : copy.drawn()) {
        const dvec4 c = clip * dvec4(dvec3(p.position), 1.0);
        const double r = 0.5 * 48 * static_cast<double>(p.radius_m * copy.view.clip_from_view[1][1]) / copy.depth(p);
        const double dx = x + 0.5 - (0.5 + 0.5 * c.x / c.w) * 64, dy = y + 0.5 - (0.5 - 0.5 * c.y / c.w) * 48;
        discs += dx * dx + dy * dy < r * r ? 1 : 0;
      }
      const double found = static_cast<double>(shown[y * 64 + x].x);
      worst = worse(worst, found - discs);
      most = std::max(most, found);
      all += discs > 0 ? found / discs : 0.0;
    }
  EXPECT_LE(worst, 0.0) << "no more sprites than discs";
  EXPECT_GT(most, 5.0);
  EXPECT_GT(all, 100.0);
}

}  // namespace
}  // namespace gloam::test
