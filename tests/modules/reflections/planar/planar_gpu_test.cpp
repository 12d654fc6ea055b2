// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// reflections.mode=planar: a mirror floor against traced rays, hard cameras, and what the mirrored view shares and
// frees.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "modules/accuracy/module.h"
#include "modules/reflections/reference/reflection_tracing.h"
#include "modules/shadows/components.h"
#include "tests/modules/lighting/guest_module.h"
#include "tests/modules/reflections/support/grazing_view.h"

namespace gloam {
namespace {

using test::value_of;

/// Objects above a floor that is a mirror.
struct PlanarReflections : test::GuestSceneTest {
  void SetUp() override {
    GuestSceneTest::SetUp();
    if (IsSkipped()) return;
    environment() = {.sky_zenith = {0.2f, 0.4f, 1.0f}, .sky_horizon = {0.7f, 0.6f, 0.5f}, .sky_ground = vec3(0.3f)};
    settings = test::look_at(dvec3(0.6, 1.4, 4.0), dvec3(0.0, 0.2, 0.0), 96, 64);
    Material mirror = exact_material(230, 200, 180, 0, 255);
    mirror.reflectivity = 1.0f;
    floor = scene.draw(scene.mesh(test::quad(20.0f, scene.material(mirror))), flat_at(0.0));
    const Material ball = exact_material(90, 200, 160, 100, 0), brick = exact_material(220, 180, 140, 160, 0);
    scene.draw(scene.mesh(test::round_ball(0.5f, 48, 24, scene.material(dull(ball)))), at({-0.8, 0.7, 0.0}));
    scene.draw(scene.mesh(test::box(vec3(0.4f), scene.material(dull(brick)))),
               glm::rotate(at({0.3, 0.6, -1.2}), 0.6, dvec3(0.0, 1.0, 0.0)));
    Light lamp;
    lamp.intensity = 6.0f;
    lamp.range_m = 12.0f;
    world.add(light(lamp, {2.0, 2.5, 2.0}), ShadowCaster{.enabled = with_shadows()});
    set("reflections.mode", "planar");
    set("reflections.blur", "off");
  }
  /// Its surroundings are those of the sky, in the mirrored view and where traced rays meet it.
  [[nodiscard]] static Material dull(Material material) {
    material.reflectivity = 0.0f;
    return material;
  }
  [[nodiscard]] static dmat4 at(const dvec3& place) { return glm::translate(dmat4(1.0), place); }
  [[nodiscard]] static dmat4 flat_at(double height) {
    return glm::rotate(at({0.0, height, 0.0}), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
  }
  /// Looks along the turned −Z axis.
  void look(const dvec3& eye, double pitch) {
    settings.world_from_camera = glm::rotate(at(eye), pitch, dvec3(1.0, 0.0, 0.0));
  }
  [[nodiscard]] LinearPicture drawn() {
    draw();
    return linear();
  }
  /// The same frame with traced reflections.
  [[nodiscard]] LinearPicture traced() {
    draw();
    const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
    const auto tracer = value_of(make_scene_tracer(world, *executor, geometry.view.position));
    TracedReflections rays = trace_radiance(
        {.world = world, .geometry = geometry, .tracer = *tracer, .executor = *executor, .settings = {.rays = 4}});
    rays.version = ++versions;
    world.set_resource(std::move(rays));
    LinearPicture picture = drawn();
    world.remove_resource<TracedReflections>();
    return picture;
  }
  [[nodiscard]] std::vector<PassTime> mirrored_passes() const {
    std::vector<PassTime> passes = renderer->report().passes;
    std::erase_if(passes, [](const PassTime& pass) { return pass.view < CompanionViews::kFirstId; });
    return passes;
  }
  struct Difference {
    double share = 0.0;   ///< of the pixels that differ by more than 3 %
    double inside = 0.0;  ///< of those whose surroundings of 5×5 pixels have nearly one colour in `b`
  };
  [[nodiscard]] static Difference difference(const LinearPicture& a, const LinearPicture& b) {
    Difference found;
    double inside = 0.0;
    const double all = static_cast<double>(a.width) * a.height;
    for (std::uint32_t y = 0; y < a.height; ++y)
      for (std::uint32_t x = 0; x < a.width; ++x) {
        const double different = relative_error(pixel(a, x, y), pixel(b, x, y), 1.0) <= 0.03 ? 0.0 : 1.0;
        double edge = 0.0;
        for (std::uint32_t v = std::max(y, 2u) - 2; v < std::min(y + 3, a.height); ++v)
          for (std::uint32_t u = std::max(x, 2u) - 2; u < std::min(x + 3, a.width); ++u)
            edge = std::max(edge, relative_error(pixel(b, u, v), pixel(b, x, y), 1.0));
        found.share += different / all;
        inside += edge < 0.1 ? 1.0 : 0.0;
        found.inside += edge < 0.1 ? different : 0.0;
      }
    EXPECT_GT(inside, 0.4 * all);
    found.inside /= inside;
    return found;
  }

  Entity floor;
  std::vector<Entity> added;
  std::uint64_t versions = 0;
};

TEST_F(PlanarReflections, equal_traced_ones_in_a_mirror_floor) {
  set("ssr.resolution", "full");
  const LinearPicture expected = traced(), planar = drawn();
  EXPECT_FALSE(mirrored_passes().empty());
  EXPECT_LT(difference(planar, expected).share, 0.02);
  set("reflections.mode", "off");
  EXPECT_GT(difference(drawn(), expected).share, 0.05) << "the picture shows no reflected object";
}

TEST_F(PlanarReflections, of_half_size_differ_at_edges_only) {
  for (const auto& [width, height] : {std::pair(96u, 64u), std::pair(97u, 63u)}) {
    settings.width = width;
    settings.height = height;
    const LinearPicture expected = traced();
    const Difference found = difference(drawn(), expected);
    EXPECT_LT(found.share, 0.12) << width;
    EXPECT_LT(found.inside, 0.005) << width;
  }
}

// Hard case: reflections.straight_down
TEST_F(PlanarReflections, are_right_straight_down) {
  set("ssr.resolution", "full");
  look({0.2, 5.0, -0.4}, -1.57079632679489661923);
  const LinearPicture expected = traced();
  EXPECT_LT(difference(drawn(), expected).share, 0.02);
  EXPECT_FALSE(mirrored_passes().empty());
}

TEST_F(PlanarReflections, are_right_for_an_orthographic_camera) {
  set("ssr.resolution", "full");
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 1.5f;
  const LinearPicture expected = traced();
  EXPECT_LT(difference(drawn(), expected).share, 0.02);
  EXPECT_FALSE(mirrored_passes().empty());
}

TEST_F(PlanarReflections, are_right_far_from_the_origin_and_at_another_height) {
  set("ssr.resolution", "full");
  const LinearPicture here = drawn();
  const dvec3 far(12345.0, 678.0, -54321.0);
  world.view<WorldTransform>().each([&](WorldTransform& transform) { transform.matrix[3] += dvec4(far, 0.0); });
  settings.world_from_camera[3] += dvec4(far, 0.0);
  const LinearPicture expected = traced(), there = drawn();
  EXPECT_LT(difference(there, expected).share, 0.02);
  EXPECT_LT(difference(there, here).share, 0.001);
}

// Hard case: reflections.grazing_floor
TEST_F(PlanarReflections, are_right_where_the_camera_grazes_the_mirror) {
  set("ssr.resolution", "full");
  for (const double degrees : {0.1, 0.3, 1.0, 3.0}) {
    const test::GrazingView grazing(degrees);
    for (int band = 0; band < test::GrazingView::kBands; ++band) {
      Material shining = dull(exact_material(0, 0, 0, 255, 255));
      shining.emissive = test::GrazingView::light(band);
      added.push_back(scene.draw(scene.mesh(test::box(vec3(1.0f), scene.material(shining))), grazing.box(band)));
    }
    settings = grazing.camera();
    const LinearPicture expected = traced(), planar = drawn();
    EXPECT_FALSE(mirrored_passes().empty()) << degrees;
    // Of the pile, the lowest millimetre is missing: the mirrored camera clips it (docs/limits.md).
    EXPECT_LT(difference(planar, expected).share, 0.01 + grazing.picture_share(1e-3)) << degrees;
    set("reflections.mode", "off");
    EXPECT_GT(difference(drawn(), expected).share, 0.2) << degrees << ": the picture shows no reflected object";
    set("reflections.mode", "planar");
    for (const Entity entity : added) world.destroy(entity);
    added.clear();
  }
}

TEST_F(PlanarReflections, need_no_mirrored_view_where_the_camera_sees_no_plane) {
  look({0.2, 1.0, 3.0}, 1.57079632679489661923);
  draw();
  EXPECT_TRUE(mirrored_passes().empty()) << "straight up";
  look({0.2, -1.0, 3.0}, 0.3);
  draw();
  EXPECT_TRUE(mirrored_passes().empty()) << "below the plane";
  look({0.2, 0.0, 3.0}, -0.1);
  draw();
  EXPECT_TRUE(mirrored_passes().empty()) << "on the plane";
  look({0.2, 1.0, 3.0}, -0.3);
  draw();
  EXPECT_FALSE(mirrored_passes().empty());
  world.get<WorldTransform>(floor).matrix = dmat4(1.0);
  draw();
  EXPECT_TRUE(mirrored_passes().empty()) << "a wall";
}

TEST_F(PlanarReflections, of_a_double_sided_floor_are_the_same) {
  const LinearPicture expected = drawn();
  for (Material& material : scene.assets().materials) material.double_sided = true;
  ++scene.assets().version;
  EXPECT_LT(difference(drawn(), expected).share, 0.01);
}

TEST_F(PlanarReflections, survive_a_frame_that_is_given_up) {
  const LinearPicture expected = drawn();
  const test::GuestModule::Passes usual = guest;
  for (const bool companion : {true, false}) {
    guest = [&](FrameBuilder& frame, PassPhase phase) {
      usual(frame, phase);
      if (phase == PassPhase::post && frame.view().is_companion() == companion)
        frame.fail({ErrorKind::failed, "the test says so"});
    };
    const ViewRequest request{settings, {}};
    EXPECT_FALSE(renderer->render(world, std::span(&request, 1)).ok());
    guest = usual;
    EXPECT_EQ(differences(drawn().rgba, expected.rgba), 0u);
  }
}

TEST_F(PlanarReflections, are_those_of_each_view_of_a_frame) {
  ViewSettings other = settings;
  other.id = ViewId{1};
  other.world_from_camera = test::look_at(dvec3(-1.6, 2.4, 3.0), dvec3(0.0, 0.2, 0.0), 96, 64).world_from_camera;
  draw(world, other);
  const LinearPicture alone = linear(1);
  const LinearPicture first = drawn();
  const ViewRequest both[] = {{settings, {}}, {other, {}}};
  ASSERT_TRUE(renderer->render(world, both).ok());
  EXPECT_EQ(differences(linear(0).rgba, first.rgba), 0u);
  EXPECT_EQ(differences(linear(1).rgba, alone.rgba), 0u);
}

struct ShadowedPlanarReflections : PlanarReflections {
  [[nodiscard]] bool with_shadows() const override { return true; }
  void SetUp() override {
    PlanarReflections::SetUp();
    if (IsSkipped()) return;
    scene.draw(scene.mesh(test::quad(4.0f, kNone)), at({0.0, 1.0, -4.0}));
  }
  /// Sum over all views of the last frame.
  [[nodiscard]] double sum(const char* name) const {
    double all = 0.0;
    for (const ViewCounters& view : renderer->report().views) all += view.counters.at(name);
    return all;
  }
  [[nodiscard]] double drawn_faces() const { return sum("shadows.faces_drawn") + sum("shadows.faces_skipped"); }
};

TEST_F(ShadowedPlanarReflections, share_the_maps_of_local_lights) {
  set("reflections.mode", "tiers");
  draw();
  const double faces = drawn_faces();
  EXPECT_GT(faces, 0.0);
  draw();
  EXPECT_EQ(drawn_faces(), 0.0);
  set("reflections.mode", "planar");
  draw();
  EXPECT_EQ(renderer->report().views.size(), 2u);
  EXPECT_EQ(drawn_faces(), faces) << "another atlas: all maps once";
  draw();
  EXPECT_EQ(drawn_faces(), 0.0);
}

TEST_F(ShadowedPlanarReflections, leave_the_rest_of_the_picture_as_it_is) {
  set("reflections.mode", "tiers");
  const LinearPicture tiers = drawn();
  const GeometryPicture geometry = value_of(renderer->read_geometry(world, settings.id));
  set("reflections.mode", "planar");
  const LinearPicture planar = drawn();
  std::size_t compared = 0, different = 0;
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const std::size_t index = std::size_t{y} * settings.width + x;
      if (!geometry.is_sky(index) && geometry.texel(index).reflectivity > 0.0f) continue;
      ++compared;
      different += pixel(tiers, x, y) == pixel(planar, x, y) ? 0 : 1;
    }
  EXPECT_GT(compared, 1000u);
  EXPECT_EQ(different, 0u);
}

TEST_F(ShadowedPlanarReflections, leave_no_memory_behind_when_their_view_is_released) {
  const auto bytes = [&](const char* mode) {
    set("reflections.mode", mode);
    for (int i = 0; i < 3; ++i) draw();
    renderer->release_view(world, settings.id);
    renderer->free_idle_memory();
    set("reflections.mode", "tiers");
    ViewSettings other = settings;
    other.id = ViewId{1};
    for (int i = 0; i < 3; ++i) draw(world, other);
    renderer->free_idle_memory();
    for (int i = 0; i < 3; ++i) draw(world, other);
    std::map<std::string, std::uint64_t> all;
    for (const gpu::ModuleMemory& m : test::shared_device()->memory()) all[m.module] = m.bytes;
    return all;
  };
  const auto before = bytes("tiers");
  EXPECT_EQ(bytes("planar"), before);
  for (const ViewId companion : CompanionViews::ids_of(settings.id))
    EXPECT_EQ(std::as_const(world).try_view_resource<RenderView>(companion), nullptr);
}

}  // namespace
}  // namespace gloam
