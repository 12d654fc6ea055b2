// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/render/declare/draw_pass.h"
#include "engine/render/readback/geometry_picture.h"
#include "modules/shadows/components.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/render/passes/projected_motion.h"

// A module that draws into the geometry buffer in PassPhase::geometry, through public interfaces only.

namespace gloam {
namespace {

using test::MovingTriangles;

dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }

struct Blade {
  dvec3 root = dvec3(0.0);  ///< world
  double height_m = 1.0;
};

/// The triangles of blades.vert, relative to the root, for a height of 1 m.
Primitive blade_mesh(std::uint32_t material = kNone) {
  Primitive p;
  p.material = material;
  p.positions = {{-0.25f, 0, 0},    {0.25f, 0, 0},     {0.25f, 0.5f, 0}, {-0.25f, 0, 0}, {0.25f, 0.5f, 0},
                 {-0.25f, 0.5f, 0}, {-0.25f, 0.5f, 0}, {0.25f, 0.5f, 0}, {0, 1, 0}};
  p.normals.assign(9, vec3(0, 0, 1));
  return test::finished(std::move(p));
}

dmat4 blade_matrix(const Blade& blade) {
  return glm::scale(glm::translate(dmat4(1.0), blade.root), dvec3(blade.height_m));
}

struct Meadow {
  std::vector<Blade> blades;
  bool motion = false;
};

/// Draws the meadow's blades. `meadow` must outlive it.
class BladeModule final : public Module {
 public:
  explicit BladeModule(const Meadow& meadow) : meadow_(meadow) {}
  [[nodiscard]] std::string_view name() const override { return "blades"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override {
    return {!meadow_.blades.empty(), "blades"};
  }
  [[nodiscard]] bool needs_motion(const World&, const KnobRegistry&) const override { return meadow_.motion; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::lists) frame.expose(frame.get<GeometryOutputs>().depth_bounds);
    if (phase != PassPhase::geometry) return;
    std::vector<vec4> blades;
    for (const Blade& blade : meadow_.blades)
      blades.push_back(vec4(frame.view().relative(blade.root), static_cast<float>(blade.height_m)));
    GeometryOutputs& geometry = frame.get<GeometryOutputs>();
    const bool motion = static_cast<bool>(geometry.motion);
    DrawPass pass(
        frame, "blades",
        {.fragment = motion ? shaders::gpu_test::standing_blades_motion_frag : shaders::gpu_test::standing_blades_frag,
         .vertex = shaders::gpu_test::standing_blades_vert,
         .depth_write = true,
         .cull = gpu::CullMode::back});
    geometry_targets(pass, geometry);
    bind_motion(pass, frame.view());
    pass.items<vec4>("blades", blades);
    pass.draw(9, static_cast<std::uint32_t>(blades.size()));
  }

 private:
  const Meadow& meadow_;
};

class GeometryPhase : public test::DrawingTest {
 protected:
  void SetUp() override {
    test::DrawingTest::SetUp();
    if (IsSkipped()) return;
    stage = std::make_unique<test::Stage>(std::make_unique<BladeModule>(meadow));
    twin_ = std::make_unique<test::Stage>();
    // A post in front of some blades; a wall behind them.
    for (test::Stage* own : {stage.get(), twin_.get()}) {
      own->settings = test::look_at(dvec3(0.7, 1.1, 6.0), dvec3(0.0, 0.5, 0.0), 128, 72);
      own->scene.draw(own->scene.mesh(post_), at(0.5, 0.5, 1.5));
      own->scene.draw(own->scene.mesh(wall_), at(-1.0, 0.5, -2.0));
      lights_[own] = test::add_lights(own->world);
    }
    meadow.blades = {{{-1.5, -0.5, 0.0}, 2.0},
                     {{-0.3, -0.5, 0.5}, 1.2},
                     {{0.6, -0.5, 0.0}, 1.5},
                     {{1.6, 0.0, -0.5}, 0.8},
                     {{1.9, -0.4, 1.0}, 1.0}};
  }
  void TearDown() override {
    twin_.reset();
    test::DrawingTest::TearDown();
  }
  /// All triangles of the scene.
  [[nodiscard]] std::vector<dvec3> corners() const {
    MovingTriangles all;
    all.add(post_, at(0.5, 0.5, 1.5), at(0.5, 0.5, 1.5));
    all.add(wall_, at(-1.0, 0.5, -2.0), at(-1.0, 0.5, -2.0));
    for (const Blade& blade : meadow.blades) all.add(blade_mesh(), blade_matrix(blade), blade_matrix(blade));
    return all.now;
  }

  const Primitive post_ = test::box(vec3(0.1f, 1.0f, 0.1f)), wall_ = test::box(vec3(1.5f, 1.5f, 0.1f));
  Meadow meadow;
  std::map<test::Stage*, std::vector<Entity>> lights_;
  std::unique_ptr<test::Stage> twin_;  ///< draws meshes instead of blades
};

TEST_F(GeometryPhase, blades_have_the_depths_that_rays_find) {
  stage->render();
  const GeometryPicture picture = test::value_of(stage->renderer->read_geometry(stage->world, ViewId{0}));
  int blades = 0, others = 0;
  for (std::uint32_t y = 0; y < 72; ++y) {
    for (std::uint32_t x = 0; x < 128; ++x) {
      const test::RayHit hit = test::first_hit(corners(), stage->settings, x + 0.5, y + 0.5);
      bool edge = false;
      for (const auto& [dx, dy] : {std::pair{0.05, 0.0}, {-0.05, 0.0}, {0.0, 0.05}, {0.0, -0.05}}) {
        const test::RayHit near = test::first_hit(corners(), stage->settings, x + 0.5 + dx, y + 0.5 + dy);
        edge = edge || !(near.depth_m == hit.depth_m || std::abs(near.depth_m - hit.depth_m) < 0.05);
      }
      if (edge) continue;
      const std::size_t i = std::size_t{y} * 128 + x;
      ASSERT_EQ(picture.is_sky(i), std::isinf(hit.depth_m)) << x << "," << y;
      if (picture.is_sky(i)) continue;
      EXPECT_NEAR(picture.view.view_depth(picture.depth[i]), hit.depth_m, 1e-4) << x << "," << y;
      const bool green = glm::length(picture.texel(i).base_color - vec3(0.25f, 0.5f, 0.125f)) < 0.01f;
      ++(green ? blades : others);
    }
  }
  EXPECT_GT(blades, 300);
  EXPECT_GT(others, 300);
}

TEST_F(GeometryPhase, blades_are_lit_as_meshes_of_the_same_triangles) {
  Material material;
  material.base_color = vec4(0.25f, 0.5f, 0.125f, 1.0f);
  material.roughness = 0.75f;
  material.metallic = 0.0f;
  material.reflectivity = 0.25f;
  const std::uint32_t mesh = twin_->scene.mesh(blade_mesh(twin_->scene.material(material)));
  for (const Blade& blade : meadow.blades) twin_->scene.draw(mesh, blade_matrix(blade));
  for (test::Stage* own : {stage.get(), twin_.get()})
    for (const Entity light : lights_.at(own))
      own->world.add<ShadowCaster>(light, {.enabled = false});  // blades without a mesh cast no shadows
  stage->render();
  twin_->render();
  const LinearPicture blades = stage->linear(), meshes = twin_->linear();
  ASSERT_EQ(blades.rgba.size(), meshes.rgba.size());
  int lit = 0, different = 0;
  for (std::size_t i = 0; i < blades.rgba.size(); i += 4) {
    const vec3 blade(blades.rgba[i], blades.rgba[i + 1], blades.rgba[i + 2]);
    const vec3 twin(meshes.rgba[i], meshes.rgba[i + 1], meshes.rgba[i + 2]);
    if (!(glm::length(blade - twin) <= 0.01f * glm::length(twin) + 1e-3f)) ++different;
    if (twin.g > 1.5f * twin.r && twin.g > 0.05f) ++lit;
  }
  EXPECT_GT(lit, 300);
  EXPECT_LE(different, 5) << "rounding at edges of triangles";
}

TEST_F(GeometryPhase, comes_before_the_depth_bounds) {
  static constexpr std::string_view kNames[] = {"depth", "depth_bounds"};
  const auto read = [&] {
    stage->render();
    return test::value_of(stage->renderer->read_images(stage->world, ViewId{0}, kNames));
  };
  const std::vector<ImageBytes> images = read();
  std::vector<float> depth(images[0].bytes.size() / sizeof(float));
  std::vector<vec2> bounds(images[1].bytes.size() / sizeof(vec2));
  std::memcpy(depth.data(), images[0].bytes.data(), images[0].bytes.size());
  std::memcpy(bounds.data(), images[1].bytes.data(), images[1].bytes.size());
  ASSERT_EQ(bounds.size(), 16u * 9u);
  for (std::uint32_t tile = 0; tile < bounds.size(); ++tile) {
    vec2 expected(1.0f, 0.0f);
    for (std::uint32_t i = 0; i < 64; ++i) {
      const float d = depth[std::size_t{tile / 16 * 8 + i / 8} * 128 + tile % 16 * 8 + i % 8];
      if (d > 0.0f) expected = {std::min(expected.x, d), std::max(expected.y, d)};
    }
    EXPECT_EQ(bounds[tile], expected) << "tile " << tile;
  }
  // The blade at the right edge stands alone: without it, its tiles show only sky.
  meadow.blades.pop_back();
  const std::vector<ImageBytes> fewer = read();
  EXPECT_NE(fewer[1].bytes, images[1].bytes);
}

TEST_F(GeometryPhase, culls_back_faces_if_the_program_says_so) {
  stage->settings = test::look_at(dvec3(0.7, 1.1, -1.2), dvec3(0.7, 0.5, 0.0), 128, 72);  // in front of the wall
  stage->render();
  const GeometryPicture picture = test::value_of(stage->renderer->read_geometry(stage->world, ViewId{0}));
  for (std::size_t i = 0; i < picture.depth.size(); ++i) {
    if (picture.is_sky(i)) continue;
    ASSERT_GT(glm::length(picture.texel(i).base_color - vec3(0.25f, 0.5f, 0.125f)), 0.1f) << "pixel " << i;
  }
}

TEST_F(GeometryPhase, blades_can_write_motion) {
  meadow.motion = true;
  const ViewSettings before = stage->settings;
  stage->render();
  stage->settings = test::look_at(dvec3(0.9, 1.0, 5.8), dvec3(0.1, 0.5, 0.0), 128, 72);
  stage->render();
  const std::vector<dvec3> all = corners();
  const test::Compared compared = test::compare_motion(test::read_motion(*stage), {all, all}, stage->settings, before);
  EXPECT_GT(compared.surface, 1000);
  EXPECT_GT(compared.longest, 2.0);
  EXPECT_LE(compared.worst, test::kMotionBar);
}

TEST(DrawProgramPipeline, writes_depth_and_culls_as_the_program_says) {
  DrawProgram program{.fragment = shaders::gpu_test::standing_blades_frag,
                      .vertex = shaders::gpu_test::standing_blades_vert};
  const gpu::GraphicsPipelineDesc plain =
      pipeline_desc(program, "blades", geometry_formats(false), kGeometryDepthFormat);
  EXPECT_FALSE(plain.depth_write);
  EXPECT_EQ(plain.cull, gpu::CullMode::none);
  program.depth_write = true;
  program.cull = gpu::CullMode::back;
  const gpu::GraphicsPipelineDesc written =
      pipeline_desc(program, "blades", geometry_formats(true), kGeometryDepthFormat);
  EXPECT_TRUE(written.depth_write);
  EXPECT_EQ(written.cull, gpu::CullMode::back);
  EXPECT_EQ(written.color_formats.size(), plain.color_formats.size() + 1);
  EXPECT_EQ(written.color_formats.back(), gpu::Format::rg32_float);
}

}  // namespace
}  // namespace gloam
