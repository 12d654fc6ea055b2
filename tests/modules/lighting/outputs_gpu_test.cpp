// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "modules/lighting/outputs.h"
#include "modules/shadows/outputs.h"
#include "shaders/lighting_test/shaders.h"
#include "tests/modules/lighting/guest_module.h"

// The interface of lighting for other modules: the forward light loop, the specular ambient term, diffuse light.

namespace gloam {
namespace {

struct LightingFace : test::GuestSceneTest {
  Material material = exact_material(200, 120, 60, 102, 128);

  bool final_lists = false;  ///< the last frame of a guest had final lists

  /// A wall at z = 0 that fills the view, 0.4 m thick.
  void wall() {
    scene.draw(scene.mesh(test::box(vec3(50.0f, 50.0f, 0.2f), scene.material(material))),
               glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -0.2)));
  }
  void sky() {
    environment().sky_zenith = vec3(0.4f, 0.6f, 1.2f);
    environment().sky_horizon = vec3(0.9f, 0.5f, 0.3f);
    environment().sky_ground = vec3(0.1f, 0.2f, 0.05f);
  }
  /// Lights of all kinds in front of the wall; all but every tenth reach only a part of it.
  void lights(int count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < count; ++i) {
      Light lamp;
      lamp.intensity = static_cast<float>(2.0 + unit(random));
      lamp.color = vec3(dvec3(0.7) + 0.3 * dvec3(unit(random), unit(random), unit(random)));
      lamp.range_m = i % 10 == 0 ? 0.0f : 1.5f;
      if (i % 3 == 0) lamp.kind = LightKind::spot;
      if (i == 7) lamp.kind = LightKind::directional;
      light(lamp, dvec3(2.5 * unit(random), 1.8 * unit(random), 0.6 + 0.4 * unit(random)),
            dvec3(unit(random), unit(random), -1.5));
    }
  }

  /// Compares an image of the wall with its oracle, pixel by pixel.
  void expect_wall(const std::vector<dvec3>& drawn, double tolerance,
                   const std::function<dvec3(const test::OracleSurface&)>& oracle) {
    ASSERT_EQ(drawn.size(), std::size_t{settings.width} * settings.height);
    std::vector<dvec3> expected;
    double brightest = 0.0;
    for (std::uint32_t y = 0; y < settings.height; ++y) {
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        expected.push_back(oracle(plane_surface(ray(x, y), 0.0, material)));
        brightest = std::max({brightest, expected.back().r, expected.back().g, expected.back().b});
      }
    }
    ASSERT_GT(brightest, 0.0);
    for (std::size_t i = 0; i < drawn.size(); ++i)
      ASSERT_LE(relative_error(drawn[i], expected[i], brightest), tolerance)
          << i % settings.width << "," << i / settings.width << " drawn " << drawn[i].r << ", expected "
          << expected[i].r;
  }
  [[nodiscard]] static std::vector<dvec3> colors_of(const LinearPicture& p) {
    std::vector<dvec3> colors;
    for (std::size_t i = 0; i < p.rgba.size(); i += 4) colors.emplace_back(p.rgba[i], p.rgba[i + 1], p.rgba[i + 2]);
    return colors;
  }

  /// Shades the geometry buffer by the forward light loop.
  void shade_by(const gpu::ShaderCode& shader, bool shadowed) {
    guest = [&shader, shadowed](FrameBuilder& frame, PassPhase phase) {
      if (phase != PassPhase::translucent) return;
      const ForwardLighting version = forward_lighting(frame);
      EXPECT_EQ(version.shadows, shadowed ? ForwardShadows::standard : ForwardShadows::none);
      gpu::ImageDesc desc;
      desc.name = "shaded";
      desc.module = "guest";
      desc.format = gpu::Format::rgba32_float;
      desc.width = frame.view().width;
      desc.height = frame.view().height;
      ComputePass pass(frame, "shade", ComputeProgram{shader, version.constants});
      read_geometry(pass, frame.get<GeometryOutputs>());
      read_lighting(pass, frame);
      const ImageRef shaded = pass.write("shaded_image", frame.graph().create_image(desc));
      pass.dispatch_over(frame.view().width, frame.view().height);
      pass.keep();
      frame.expose(shaded);
    };
  }
  /// The image that shade_by's pass writes.
  [[nodiscard]] std::vector<dvec3> shaded(const gpu::ShaderCode& shader, bool shadowed = false) {
    shade_by(shader, shadowed);
    draw();
    if (HasFatalFailure()) return {};
    const ImageBytes bytes = image("shaded");
    LinearPicture picture{bytes.width, bytes.height, std::vector<float>(bytes.bytes.size() / sizeof(float))};
    std::memcpy(picture.rgba.data(), bytes.bytes.data(), bytes.bytes.size());
    return colors_of(picture);
  }

  /// Asks for diffuse light and exposes it.
  void ask_for_diffuse_light() {
    guest = [this](FrameBuilder& frame, PassPhase phase) {
      if (phase == PassPhase::announce) frame.put(DiffuseLightWanted{});
      if (phase != PassPhase::post) return;
      frame.expose(frame.get<DiffuseLightOutput>().light);
      final_lists = find_final_lists(frame) != nullptr;
    };
  }
  [[nodiscard]] std::vector<dvec3> diffuse_light() {
    const ImageBytes bytes = image("diffuse_light");
    EXPECT_EQ(bytes.format, gpu::Format::rgba16_float);
    std::vector<dvec3> colors(bytes.bytes.size() / sizeof(uvec2));
    for (std::size_t i = 0; i < colors.size(); ++i) {
      uvec2 texel;
      std::memcpy(&texel, &bytes.bytes[i * sizeof(uvec2)], sizeof(uvec2));
      colors[i] = decode_diffuse_light(texel);
    }
    return colors;
  }
  /// Diffuse light of a surface that no light is hidden from.
  [[nodiscard]] dvec3 oracle_diffuse_light(const test::OracleSurface& s) {
    dvec3 sum = test::kPiOracle * test::oracle_hemisphere(environment(), s.normal);
    for (const test::OracleLight& l : oracle_lights) {
      const test::OracleArrival arrival = test::oracle_arrival(s.position, l);
      sum += arrival.illuminance * std::max(glm::dot(s.normal, arrival.to_light), 0.0);
    }
    return sum;
  }

  /// Takes the specular ambient term over. add: adds it again, in another image.
  void take_specular_ambient(bool add) {
    guest = [this, add](FrameBuilder& frame, PassPhase phase) {
      if (phase == PassPhase::announce) frame.put(SpecularAmbientTaken{});
      final_lists = find_final_lists(frame) != nullptr;
      if (phase != PassPhase::shading || !add) return;
      LitOutput& lit = frame.get<LitOutput>();
      DrawPass pass(frame, "add_specular", {shaders::lighting_test::add_specular_frag});
      pass.read("lit_image", lit.color);
      read_geometry(pass, frame.get<GeometryOutputs>());
      read_lighting(pass, frame);
      lit.color = pass.target(create_view_image(frame, "added", gpu::Format::rgba16_float));
      pass.draw_triangle();
    };
  }
  /// Expects the usual picture if the taken term is added again, and less light if it is not.
  void expect_specular_ambient_can_be_taken(const char* what) {
    guest = {};
    settings.without = {"reflections"};  // the guest takes their place
    ASSERT_NO_FATAL_FAILURE(draw());
    const std::vector<dvec3> usual = colors_of(linear());
    take_specular_ambient(false);
    ASSERT_NO_FATAL_FAILURE(draw());
    const std::vector<dvec3> without = colors_of(linear());
    take_specular_ambient(true);
    ASSERT_NO_FATAL_FAILURE(draw());
    const std::vector<dvec3> added = colors_of(linear());
    std::size_t darker = 0;
    for (std::size_t i = 0; i < usual.size(); ++i) {
      darker += without[i].r < 0.99 * usual[i].r ? 1 : 0;
      for (int c = 0; c < 3; ++c)  // rounded to 11 bits three times
        ASSERT_LE(std::abs(added[i][c] - usual[i][c]), 1.5 * usual[i][c] / 1024.0 + 1e-6) << what << ", pixel " << i;
    }
    EXPECT_GT(darker, usual.size() / 4) << what;
  }
  /// Smooth and rough boxes before the sky.
  void boxes() {
    for (int i = 0; i < 6; ++i) {
      const Material one = exact_material(220, 180, 140, static_cast<std::uint8_t>(20 + 45 * i), i % 2 == 0 ? 255 : 0);
      scene.draw(scene.mesh(test::box(vec3(0.45f), scene.material(one))),
                 glm::rotate(glm::translate(dmat4(1.0), dvec3(i % 3 - 1.0, i / 3 - 0.5, 0.0)), 0.5 * i,
                             glm::normalize(dvec3(1.0, 0.7, 0.2))));
    }
  }
};

struct ShadowedLightingFace : LightingFace {
  [[nodiscard]] bool with_shadows() const override { return true; }
};

TEST_F(LightingFace, forward_light_loop_sums_all_lights_of_the_view) {
  wall();
  sky();
  lights(60);
  const auto oracle = [&](const test::OracleSurface& s) { return test::oracle_shade(s, oracle_lights, environment()); };
  const std::vector<dvec3> tiled = shaded(shaders::lighting_test::shade_tiled_comp);
  expect_wall(tiled, 1e-2, oracle);
  const std::vector<dvec3> all = shaded(shaders::lighting_test::shade_comp);
  expect_wall(all, 1e-2, oracle);
  EXPECT_EQ(differences(tiled, all), 0u) << "masks and zBins leave out only lights that do not reach a point";
}

TEST_F(LightingFace, forward_light_loop_works_in_a_scene_without_lights) {
  wall();
  sky();
  expect_wall(shaded(shaders::lighting_test::shade_comp), 1e-2,
              [&](const test::OracleSurface& s) { return test::oracle_ambient(s, environment()); });
}

TEST_F(LightingFace, forward_light_loop_takes_a_response_of_the_shader) {
  wall();
  lights(40);
  Light behind;
  behind.intensity = 20.0f;
  light(behind, dvec3(0.3, 0.2, -1.0));
  expect_wall(shaded(shaders::lighting_test::illuminance_tiled_comp), 1e-2, [&](const test::OracleSurface& s) {
    dvec3 sum(0.0);
    for (const test::OracleLight& l : oracle_lights) sum += test::oracle_arrival(s.position, l).illuminance;
    return sum;
  });
}

TEST_F(ShadowedLightingFace, forward_light_loop_shows_the_shadows_of_deferred_lighting) {
  set("shadows.mode", "monolithic");
  wall();
  scene.draw(scene.mesh(test::box(vec3(0.2f))), glm::translate(dmat4(1.0), dvec3(0.1, 0.1, 0.5)));
  sky();
  Light lamp;
  lamp.intensity = 20.0f;
  lamp.width_m = 0.1f;
  light(lamp, dvec3(0.6, 0.5, 1.5));
  lamp.kind = LightKind::directional;
  lamp.intensity = 3.0f;
  light(lamp, dvec3(0.0), dvec3(-0.4, -0.3, -1.0));
  const std::vector<dvec3> forward = shaded(shaders::lighting_test::shade_tiled_shadowed_comp, true);
  const std::vector<dvec3> deferred = colors_of(linear());
  const std::vector<dvec3> unshadowed = shaded(shaders::lighting_test::shade_tiled_comp, true);
  ASSERT_EQ(forward.size(), deferred.size());
  std::size_t dark = 0;
  for (std::size_t i = 0; i < forward.size(); ++i) {
    ASSERT_LE(relative_error(forward[i], deferred[i], 5.0), 2e-3) << "pixel " << i;
    dark += forward[i].r < 0.8 * unshadowed[i].r ? 1 : 0;
  }
  EXPECT_GT(dark, 100u);
}

TEST_F(ShadowedLightingFace, light_from_behind_a_surface_passes_its_shadows_too) {
  set("shadows.mode", "monolithic");
  wall();
  Light behind;
  behind.intensity = 20.0f;
  light(behind, dvec3(0.3, 0.2, -2.0));
  for (const dvec3& color : shaded(shaders::lighting_test::illuminance_tiled_comp, true)) ASSERT_GT(color.r, 0.1);
  for (const dvec3& color : shaded(shaders::lighting_test::illuminance_tiled_shadowed_comp, true))
    ASSERT_EQ(color.r, 0.0) << "the wall is between the light and its front";
}

TEST_F(LightingFace, specular_ambient_light_can_be_taken_over) {
  sky();
  boxes();
  lights(20);
  for (const char* culling : {"tiled", "brute"}) {
    set("lights.culling", culling);
    ASSERT_NO_FATAL_FAILURE(expect_specular_ambient_can_be_taken(culling));
  }
}

TEST_F(ShadowedLightingFace, specular_ambient_light_can_be_taken_over_with_final_lists) {
  sky();
  boxes();
  lights(6);
  ASSERT_NO_FATAL_FAILURE(expect_specular_ambient_can_be_taken("deferred"));
  EXPECT_TRUE(final_lists);
}

TEST_F(LightingFace, light_without_specular_ambient_light_is_that_of_the_formulas) {
  wall();
  sky();
  lights(20);
  settings.without = {"reflections"};  // the guest takes their place
  take_specular_ambient(false);
  ASSERT_NO_FATAL_FAILURE(draw());
  expect_wall(colors_of(linear()), 1e-2, [&](const test::OracleSurface& s) {
    dvec3 sum = (1.0 - s.metallic) * s.base_color * test::oracle_hemisphere(environment(), s.normal);
    for (const test::OracleLight& l : oracle_lights) sum += test::oracle_light(s, l);
    return sum;
  });
}

TEST_F(LightingFace, diffuse_light_is_the_illuminance_of_the_surface) {
  wall();
  sky();
  lights(60);
  ask_for_diffuse_light();
  for (const char* culling : {"tiled", "brute"}) {
    set("lights.culling", culling);
    ASSERT_NO_FATAL_FAILURE(draw());
    expect_wall(diffuse_light(), 2e-3, [&](const test::OracleSurface& s) { return oracle_diffuse_light(s); });
  }
}

TEST_F(LightingFace, diffuse_light_of_the_sky_is_0) {
  sky();
  light(Light{}, dvec3(0.0, 0.0, 1.0));
  ask_for_diffuse_light();
  ASSERT_NO_FATAL_FAILURE(draw());
  for (const dvec3& color : diffuse_light()) ASSERT_EQ(color, dvec3(0.0));
}

TEST_F(ShadowedLightingFace, diffuse_light_of_a_shadow_is_that_of_the_surroundings) {
  wall();
  sky();
  Light lamp;
  lamp.intensity = 20.0f;
  light(lamp, dvec3(0.0, 0.0, 1.5));
  // A square of 0.4 m at z = 0.5 … 0.9 hides the middle of the wall from the lamp: to 0.3 m or more from the axis.
  scene.draw(scene.mesh(test::box(vec3(0.2f))), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 0.7)));
  settings = test::look_at(dvec3(2.0, 0.0, 1.0), dvec3(0.3, 0.0, 0.0), 61, 43);
  ask_for_diffuse_light();
  const auto check = [&](const char* what) {
    ASSERT_NO_FATAL_FAILURE(draw());
    const std::vector<dvec3> drawn = diffuse_light();
    std::size_t dark = 0, lit = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y) {
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const Ray r = ray(x, y);
        if (r.direction.z > -0.1) continue;  // sees the wall far away or not at all
        const test::OracleSurface s = plane_surface(r, 0.0, material);
        // The point where the ray passes the box's front, to leave out pixels that show the box.
        const dvec3 before = r.origin + r.direction * ((0.9 - r.origin.z) / r.direction.z);
        if (std::min({s.position.x, before.x}) < 0.25) continue;
        const double from_axis = std::max(std::abs(s.position.x), std::abs(s.position.y));
        if (from_axis > 0.25 && from_axis < 0.45) {
          const dvec3 expected = test::kPiOracle * test::oracle_hemisphere(environment(), s.normal);
          ASSERT_LE(relative_error(drawn[y * settings.width + x], expected, expected.r), 2e-3) << what;
          ++dark;
        }
        if (from_axis > 0.65) {
          const dvec3 expected = oracle_diffuse_light(s);
          ASSERT_LE(relative_error(drawn[y * settings.width + x], expected, expected.r), 2e-3) << what;
          ++lit;
        }
      }
    }
    EXPECT_GT(dark, 20u) << what;
    EXPECT_GT(lit, 100u) << what;
  };
  check("deferred");
  EXPECT_TRUE(final_lists);
  set("shadows.slot_limit", "0");
  check("fallback tiles");
  EXPECT_GT(renderer->report().counters.at("shadows.fallback_tiles"), 0.0);
  EXPECT_TRUE(final_lists);
  set("shadows.mode", "monolithic");
  check("monolithic");
  EXPECT_FALSE(final_lists);
}

TEST_F(ShadowedLightingFace, diffuse_light_that_nobody_asks_for_costs_nothing) {
  wall();
  sky();
  lights(6);
  guest = [](FrameBuilder& frame, PassPhase) { EXPECT_EQ(frame.find<DiffuseLightOutput>(), nullptr); };
  ASSERT_NO_FATAL_FAILURE(draw());
  const LinearPicture usual = linear();
  const std::uint32_t pipelines = module_state("lighting").pipelines;
  EXPECT_EQ(renderer->describe().find("diffuse_light"), std::string::npos);
  ask_for_diffuse_light();
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_EQ(differences(linear().rgba, usual.rgba), 0u) << "light is the same with the second target";
  EXPECT_GT(module_state("lighting").pipelines, pipelines);
  EXPECT_NE(renderer->describe().find("diffuse_light"), std::string::npos);
}

}  // namespace
}  // namespace gloam
