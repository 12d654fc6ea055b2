// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <vector>

#include "engine/scene/units.h"
#include "tests/modules/lighting/lit_scene.h"

// Ambient occlusion. The oracle casts rays in double precision at the boxes of the scene.

namespace gloam {
namespace {

struct Slab {
  dvec3 low;
  dvec3 high;
};

struct BoxHit {
  double distance = std::numeric_limits<double>::infinity();
  dvec3 normal = dvec3(0.0);
};

/// The first entry of a ray into a box at a distance above 0.
BoxHit hit(const std::vector<Slab>& boxes, const dvec3& origin, const dvec3& direction) {
  BoxHit nearest;
  for (const Slab& box : boxes) {
    double enter = 1e-9, leave = std::numeric_limits<double>::infinity();
    int axis = -1;
    for (int a = 0; a < 3; ++a) {
      const double inverse = 1.0 / direction[a];
      const double t0 = ((inverse < 0.0 ? box.high : box.low)[a] - origin[a]) * inverse;
      const double t1 = ((inverse < 0.0 ? box.low : box.high)[a] - origin[a]) * inverse;
      if (t0 > enter) {
        enter = t0;
        axis = a;
      }
      leave = std::min(leave, t1);
    }
    if (axis < 0 || enter > leave || enter >= nearest.distance) continue;
    nearest = {enter, dvec3(0.0)};
    nearest.normal[axis] = direction[axis] < 0.0 ? 1.0 : -1.0;
  }
  return nearest;
}

/// Share of the cosine-weighted hemisphere that no box hides within `reach`.
double visible_share(const std::vector<Slab>& boxes, const dvec3& point, const dvec3& normal, double reach) {
  constexpr int kSide = 20;
  const dvec3 across = std::abs(normal.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), along = glm::cross(normal, across);
  int visible = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double square = (i % kSide + 0.5) / kSide, angle = 2.0 * test::kPiOracle * (i / kSide + 0.5) / kSide;
    const dvec3 direction =
        std::sqrt(square) * (std::cos(angle) * across + std::sin(angle) * along) + std::sqrt(1.0 - square) * normal;
    if (hit(boxes, point + 1e-6 * normal, direction).distance > reach) ++visible;
  }
  return visible / static_cast<double>(kSide * kSide);
}

struct Occlusion : test::LitSceneTest {
  std::vector<Slab> boxes;
  double metre = 1.0;

  void SetUp() override {
    LitSceneTest::SetUp();
    if (IsSkipped()) return;
    ASSERT_TRUE(renderer->knobs().set("lighting.occlusion", "on").ok());
    settings.width = 96;
    settings.height = 64;
    look({0.0, 2.0, 4.0}, {0.0, 0.3, 0.0});
  }

  void look(const dvec3& from, const dvec3& at) {
    settings.world_from_camera = glm::inverse(glm::lookAt(metre * from, metre * at, dvec3(0.0, 1.0, 0.0)));
  }
  void add(const dvec3& low, const dvec3& high) {
    boxes.push_back({metre * low, metre * high});
    const Material white = exact_material(255, 255, 255, 255, 0);
    scene.draw(scene.mesh(test::box(vec3(0.5 * metre * (high - low)), scene.material(white))),
               glm::translate(dmat4(1.0), 0.5 * metre * (high + low)));
  }
  void floor() { add({-30, -1, -30}, {30, 0, 30}); }

  [[nodiscard]] std::vector<double> drawn_shares() {
    settings.visualizer = "occlusion";
    draw();
    if (HasFatalFailure()) return {};
    const ImageBytes bytes = test::value_of(renderer->read_image(world, settings.id, "occlusion"));
    std::vector<double> shares(bytes.bytes.size() / 8);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      std::uint16_t half;
      std::memcpy(&half, &bytes.bytes[8 * i], sizeof(half));
      shares[i] = static_cast<double>(glm::unpackHalf1x16(half));
    }
    return shares;
  }

  struct Errors {
    double drawn = 0.0;  ///< root mean square over pixels with a surface
    double none = 0.0;   ///< of a picture without occlusion
    double bias = 0.0;   ///< mean of drawn − traced
    int pixels = 0;
  };
  [[nodiscard]] Errors errors() {
    const std::vector<double> shares = drawn_shares();
    Errors sum;
    for (std::uint32_t y = 0; y < settings.height && !HasFatalFailure(); ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const Ray r = ray(x, y);
        const BoxHit seen = hit(boxes, r.origin, r.direction);
        const double share = shares[std::size_t{y} * settings.width + x];
        if (!std::isfinite(seen.distance)) {
          EXPECT_EQ(share, 1.0) << "sky at " << x << "," << y;
          continue;
        }
        const double truth = visible_share(boxes, r.origin + seen.distance * r.direction, seen.normal, metre);
        sum.drawn += (share - truth) * (share - truth);
        sum.none += (1.0 - truth) * (1.0 - truth);
        sum.bias += share - truth;
        ++sum.pixels;
      }
    sum.drawn = std::sqrt(sum.drawn / sum.pixels);
    sum.none = std::sqrt(sum.none / sum.pixels);
    sum.bias /= sum.pixels;
    return sum;
  }
  /// The estimate is worth its time only if it takes away most of the error of a picture without it.
  void expect_most_of_the_error_gone() {
    const Errors e = errors();
    RecordProperty("rms",
                   std::to_string(e.drawn) + " of " + std::to_string(e.none) + ", bias " + std::to_string(e.bias));
    EXPECT_GT(e.none, 0.01);
    EXPECT_LT(e.drawn, 0.5 * e.none) << "bias " << e.bias << ", " << e.pixels << " pixels";
  }
  void expect_nothing_hidden() {
    for (const double share : drawn_shares()) ASSERT_EQ(share, 1.0);
  }
};

TEST_F(Occlusion, of_a_plane_is_exactly_nothing_at_any_slope) {
  floor();
  for (const double height : {0.02, 0.3, 3.0, 40.0}) {
    look({0.3, height, 2.0}, {0.0, 0.0, 0.0});
    expect_nothing_hidden();
  }
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 0.5f;
  look({0.3, 0.1, 2.0}, {0.0, 0.0, 0.0});
  expect_nothing_hidden();
}

TEST_F(Occlusion, of_bodies_farther_apart_than_a_metre_is_nothing) {
  add({-30, -1, -30}, {30, 0, 30});
  add({-0.5, 1.1, -0.5}, {0.5, 1.3, 0.5});
  expect_nothing_hidden();
}

TEST_F(Occlusion, of_a_floor_at_a_wall_is_that_of_traced_rays) {
  floor();
  add({-30, 0, -2}, {30, 5, -1});
  look({0.0, 1.5, 2.0}, {0.0, 0.3, -1.0});
  expect_most_of_the_error_gone();
}

TEST_F(Occlusion, of_a_corner_of_three_planes_is_that_of_traced_rays) {
  floor();
  add({-30, 0, -2}, {30, 5, -1});
  add({-2, 0, -1}, {-1, 5, 30});
  look({0.8, 1.4, 1.0}, {-0.7, 0.2, -0.7});
  expect_most_of_the_error_gone();
}

TEST_F(Occlusion, of_a_box_on_a_floor_is_that_of_traced_rays) {
  floor();
  add({-0.5, 0, -0.5}, {0.5, 0.8, 0.5});
  look({1.6, 1.8, 2.2}, {0.0, 0.2, 0.0});
  expect_most_of_the_error_gone();
}

/// The same floor and wall where a metre is some other number of units.
struct ScaledOcclusion : Occlusion {
  void floor_and_wall(double units) {
    metre = units;
    settings.camera.near_m = static_cast<float>(0.1 * units);
    world.set_resource(SceneUnits{1.0 / units});
    floor();
    add({-30, 0, -2}, {30, 5, -1});
    look({0.0, 1.5, 2.0}, {0.0, 0.3, -1.0});
  }
};

TEST_F(ScaledOcclusion, reaches_a_metre_of_a_scene_in_centimetres) {
  floor_and_wall(100.0);
  expect_most_of_the_error_gone();
}

TEST_F(ScaledOcclusion, reaches_a_metre_of_a_scene_in_hectometres) {
  floor_and_wall(0.01);
  expect_most_of_the_error_gone();
}

TEST_F(ScaledOcclusion, of_an_orthographic_view_is_that_of_traced_rays) {
  floor_and_wall(1.0);
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 1.2f;
  expect_most_of_the_error_gone();
}

TEST_F(Occlusion, beside_a_thin_body_is_not_worse_than_without) {
  add({-30, -30, -2}, {30, 30, -1});         // a wall
  add({-0.1, -30, -0.54}, {0.1, 30, -0.5});  // a bar before it
  look({0.0, 0.3, 3.0}, {0.0, 0.3, -1.0});
  const Errors e = errors();
  RecordProperty("rms", std::to_string(e.drawn) + " of " + std::to_string(e.none));
  EXPECT_LE(e.drawn, e.none) << "bias " << e.bias;
}

TEST_F(Occlusion, takes_light_of_the_surroundings_and_none_of_lamps) {
  floor();
  add({-30, 0, -2}, {30, 5, -1});
  const auto drawn = [&](bool on, bool sky) {
    environment().sky_zenith = environment().sky_horizon = environment().sky_ground = vec3(sky ? 1.0f : 0.0f);
    EXPECT_TRUE(renderer->knobs().set("lighting.occlusion", on ? "on" : "off").ok());
    draw();
    return linear().rgba;
  };
  EXPECT_LT(drawn(true, true), drawn(false, true));
  light({.intensity = 20.0f}, {0.0, 1.0, 0.5});
  EXPECT_EQ(drawn(true, false), drawn(false, false));
}

TEST_F(Occlusion, adds_no_pass_when_off) {
  floor();
  ASSERT_TRUE(renderer->knobs().set("lighting.occlusion", "off").ok());
  draw();
  EXPECT_EQ(renderer->describe().find("occlusion"), std::string::npos);
}

}  // namespace
}  // namespace gloam
