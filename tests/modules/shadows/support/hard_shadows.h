// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "modules/accuracy/module.h"
#include "modules/shadows/components.h"
#include "modules/shadows/reference/adapter.h"
#include "modules/shadows/reference/statistics.h"
#include "tests/modules/lighting/lit_scene.h"
#include "tests/render/draws/small_scene.h"

namespace gloam::test {

/// Largest mean difference between drawn and traced visibility, over pixels that the light reaches.
inline constexpr double kMostMean = 0.02;
inline constexpr double kMostPenumbraMean = 0.08;           ///< where traced visibility is 0.05…0.95
inline constexpr std::uint64_t kFewestPenumbraPairs = 100;  ///< with fewer, the penumbra mean is not checked
/// Largest share of pixels, more than a pixel away from traced silhouettes, that differ by more than 0.5.
inline constexpr double kMostWrong = 0.001;

/// A rotation that takes −Z to `direction`.
[[nodiscard]] inline dmat4 turn_towards(const dvec3& direction) {
  const dvec3 z = -glm::normalize(direction);
  const dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0), z));
  dmat4 turn(1.0);
  turn[0] = dvec4(x, 0.0);
  turn[1] = dvec4(glm::cross(z, x), 0.0);
  turn[2] = dvec4(z, 0.0);
  return turn;
}

/// A ball around the origin with smooth normals.
[[nodiscard]] inline Primitive ball(float radius, std::uint32_t material) {
  return round_ball(radius, 24, 12, material);
}

/// One renderer for all tests of this program, because making its pipelines takes longer than drawing all frames.
struct SharedRenderer {
  explicit SharedRenderer(ModuleList modules) {
    RendererOptions options;
    options.device = shared_device();
    options.executor = executor.get();
    options.log = &log;
    options.modules = std::move(modules);
    renderer = value_of(Renderer::create(std::move(options)));
  }
  std::vector<std::string>* warnings = nullptr;  ///< of the running test
  FunctionLog log{[this](LogLevel level, std::string_view line) {
    if (level >= LogLevel::warning && warnings != nullptr) warnings->emplace_back(line);
  }};
  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  std::unique_ptr<Renderer> renderer;  ///< null while a test uses it
};

/// Whole frames whose shadows are compared with traced visibility.
class HardShadows : public LitSceneTest {
 protected:
  /// Fills a world with a small scene. Returns its second box, which tests move.
  static Entity fill(World& into) {
    test::SceneMaker maker(into);
    into.resource<SceneEnvironment>().has_exposure = true;
    const std::uint32_t material = maker.material(exact_material(180, 170, 160, 255, 0));
    maker.draw(maker.mesh(test::quad(3.0f, material)), flat(0.0));
    maker.draw(maker.mesh(test::box(vec3(0.2f), material)), at(-0.6, 0.2, 0.1));
    const Entity mover = maker.draw(maker.mesh(test::box(vec3(0.15f), material)), at(0.5, 0.5, 0.0));
    into.create(point(0.1f), WorldTransform{at(0.2, 1.8, 0.4)}, ShadowCaster{true, 256});
    Light cone = spot(40.0, 0.1f);
    into.create(cone, WorldTransform{at(-1.5, 1.5, 1.0) * test::turn_towards(dvec3(1.5, -1.3, -1.0))},
                ShadowCaster{true, 256});
    Light day = sun(0.02f);
    into.create(day, WorldTransform{test::turn_towards(dvec3(0.5, -0.8, -0.4))}, ShadowCaster{true, 256});
    return mover;
  }

  [[nodiscard]] bool with_shadows() const override { return true; }
  void SetUp() override {
    GLOAM_REQUIRE_GPU(shared_device());
    GLOAM_REQUIRE_DEPTH_TESTS(shared_device());
    shared().warnings = &warnings;
    renderer = std::move(shared().renderer);
    ASSERT_NE(renderer, nullptr);
    renderer->prepare_world(world);
    environment().has_exposure = true;
    stone = scene.material(exact_material(180, 170, 160, 255, 0));
    settings = look_at(dvec3(0.3, 2.2, 3.4), dvec3(0.0, 0.3, 0.0), 96, 54);
    set("shadows.visibility_bits", "exact");
  }

  void TearDown() override {
    if (renderer != nullptr) {
      renderer->release_world(world);
      const std::vector<Knob> knobs = renderer->knobs().knobs();
      for (const Knob& knob : knobs) set(knob.name, value_text(knob, knob.default_number));
      shared().renderer = std::move(renderer);
      shared().warnings = nullptr;
    }
    LitSceneTest::TearDown();
  }
  [[nodiscard]] virtual SharedRenderer& shared() {
    static SharedRenderer made(make_modules());
    return made;
  }

  [[nodiscard]] static dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }
  /// The transform that lays a quad flat, facing up.
  [[nodiscard]] static dmat4 flat(double height) {
    return glm::rotate(at(0.0, height, 0.0), glm::radians(-90.0), dvec3(1.0, 0.0, 0.0));
  }
  Entity thing(Primitive shape, const dmat4& matrix = dmat4(1.0)) {
    return things.emplace_back(scene.draw(scene.mesh(std::move(shape)), matrix));
  }
  Entity floor(float half = 3.0f) { return thing(quad(half, stone), flat(0.0)); }
  Entity box(const dvec3& center, const dvec3& half, double turn = 0.0) {
    return thing(test::box(vec3(half), stone), glm::rotate(glm::translate(dmat4(1.0), center), turn, dvec3(0, 1, 0)));
  }
  /// A floor with boxes, thin sheets and a ball on and above it.
  void yard() {
    floor();
    box(dvec3(-0.6, 0.2, 0.1), dvec3(0.2), 0.3);
    box(dvec3(0.3, 0.7, -0.5), dvec3(0.25, 0.05, 0.15), 0.7);
    box(dvec3(0.9, 0.3, 0.2), dvec3(0.25, 0.3, 0.001), -0.6);
    Material leaf = exact_material(170, 180, 160, 255, 0);
    leaf.double_sided = true;
    const std::uint32_t sheet = scene.material(leaf);
    thing(quad(0.25f, sheet), glm::rotate(at(0.1, 0.35, 0.5), 0.8, dvec3(1.0, 0.2, 0.0)));
    thing(quad(0.2f, sheet), at(-1.0, 0.003, 0.8) * flat(0.0));
    thing(ball(0.25f, stone), at(-0.2, 0.3, -0.6));
  }

  Entity lamp(const Light& made, const dvec3& position, const dvec3& direction = dvec3(0.0, -1.0, 0.0),
              std::uint32_t resolution = 1024) {
    const Entity entity = light(made, position, direction);
    world.resource<SceneNames>().add("light", name_of(entity), entity);
    world.add(entity, ShadowCaster{true, resolution});
    things.push_back(entity);
    return entity;
  }
  [[nodiscard]] static Light point(float width_m = 0.0f) {
    return {.kind = LightKind::point, .intensity = 20.0f, .range_m = 12.0f, .width_m = width_m};
  }
  [[nodiscard]] static Light spot(double half_degrees, float width_m = 0.0f) {
    Light made = point(width_m);
    made.kind = LightKind::spot;
    made.outer_angle = static_cast<float>(glm::radians(half_degrees));
    made.inner_angle = 0.9f * made.outer_angle;
    return made;
  }
  [[nodiscard]] static Light sun(float apparent_angle = 0.0f) {
    return {.kind = LightKind::directional, .intensity = 10.0f, .apparent_angle = apparent_angle};
  }
  [[nodiscard]] static std::string name_of(Entity light) { return "light " + std::to_string(light.index); }

  void set(const std::string& knob, const std::string& value) {
    const Status status = renderer->knobs().set(knob, value);
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  void place(Entity entity, const dmat4& matrix) { world.get<WorldTransform>(entity).matrix = matrix; }
  [[nodiscard]] double counter(const std::string& name) const { return renderer->report().counters.at(name); }
  [[nodiscard]] LinearPicture drawn() {
    draw();
    return HasFatalFailure() ? LinearPicture{} : linear();
  }

  /// Drawn visibility of a light at each pixel; negative where it does not reach.
  [[nodiscard]] std::vector<float> visibility(Entity lamp) {
    settings.visualizer = "shadow:" + name_of(lamp);
    draw();
    settings.visualizer = "none";
    const ImageBytes image = value_of(renderer->read_image(world, settings.id, "shadow_visibility"));
    std::vector<float> values(image.bytes.size() / sizeof(float));
    std::memcpy(values.data(), image.bytes.data(), image.bytes.size());
    return values;
  }
  /// Traced visibility of all lights.
  [[nodiscard]] TracedVisibility trace(std::uint32_t samples = 64) {
    draw();
    const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
    const auto tracer = value_of(make_scene_tracer(world, *executor, geometry.view.position));
    return trace_visibility(
        {.world = world, .geometry = geometry, .tracer = *tracer, .executor = *executor, .samples = samples});
  }
  [[nodiscard]] ShadowError error(Entity lamp, const TracedVisibility& traced) {
    const auto layer = traced.layer_of(lamp);
    const std::vector<float> seen = visibility(lamp);
    if (!layer || seen.size() != traced.pixels()) {
      ADD_FAILURE() << name_of(lamp) << " was not traced, or not drawn at the same size";
      return {};
    }
    for (std::size_t i = 0; i < seen.size(); ++i)
      EXPECT_TRUE(std::isfinite(seen[i]) && seen[i] <= 1.0f)
          << seen[i] << " at " << i % traced.width << "," << i / traced.width;
    const ShadowError found = compare_visibility(traced, *layer, seen);
    EXPECT_LE(found.unreached, traced.pixels() / 50);
    return found;
  }
  static void print(const std::string& what, const ShadowError& e) {
    std::printf("%-34s pairs %6llu  mean %.4f  penumbra %.4f of %llu  wrong %.4f  acne %llu  leaks %llu\n",
                what.c_str(), static_cast<unsigned long long>(e.pairs), e.mean(), e.penumbra_mean(),
                static_cast<unsigned long long>(e.penumbra_pairs), e.wrong_share(),
                static_cast<unsigned long long>(e.acne), static_cast<unsigned long long>(e.leaks));
  }
  static void expect_right(const std::string& what, const ShadowError& e, std::uint64_t least_pairs = 500) {
    print(what, e);
    EXPECT_GE(e.pairs, least_pairs) << what;
    EXPECT_LE(e.mean(), kMostMean) << what;
    if (e.penumbra_pairs >= kFewestPenumbraPairs) {
      EXPECT_LE(e.penumbra_mean(), kMostPenumbraMean) << what;
    }
    EXPECT_LE(e.wrong_share(), kMostWrong) << what;
  }
  /// Draws and traces the view in its present state.
  void expect_right(const std::string& what, Entity lamp, std::uint64_t least_pairs = 500) {
    expect_right(what, error(lamp, trace()), least_pairs);
  }
  void expect_finite(const std::string& what) {
    const LinearPicture seen = linear();
    std::size_t bad = 0;
    for (const float channel : seen.rgba) bad += std::isfinite(channel) ? 0 : 1;
    EXPECT_EQ(bad, 0u) << what;
  }

  std::uint32_t stone = 0;
  std::vector<Entity> things;  ///< all entities of the scene
};

}  // namespace gloam::test
