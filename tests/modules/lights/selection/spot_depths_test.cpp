// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// View depths of spots against points of their cones, in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <random>
#include <vector>

#include "modules/lights/selection/light_list.h"

#include "engine/render/view.h"

namespace gloam {
namespace {

constexpr double kMostAngle = 1.5707963267948966;

struct SpotScene {
  RenderView view;
  std::vector<PlacedLight> lights;
};

/// One spot around the camera's axis, in front of the camera or around it.
SpotScene random_spot(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto direction = [&] { return glm::normalize(dvec3(unit(random), unit(random), unit(random) + 1e-3)); };
  SpotScene scene;
  ViewSettings settings;
  settings.width = 160;
  settings.height = 120;
  settings.camera.orthographic = random() % 5 == 0;
  const dmat4 camera = glm::translate(dmat4(1.0), 2000.0 * dvec3(unit(random), unit(random), unit(random))) *
                       glm::rotate(dmat4(1.0), 3.0 * unit(random), direction());
  settings.world_from_camera = camera;
  scene.view = make_view(settings, 0);
  PlacedLight placed;
  placed.entity = {0, 1};
  placed.light.kind = LightKind::spot;
  placed.light.intensity = 1.0f;
  placed.light.range_m = static_cast<float>(std::exp2(4.0 * unit(random)));
  constexpr double kAngles[] = {0.0, 1e-4, 0.02, 0.3, 0.7853981633974483, 1.0, 1.3, kMostAngle};
  placed.light.outer_angle = static_cast<float>(kAngles[random() % 8]);
  placed.light.inner_angle = 0.5f * placed.light.outer_angle;
  placed.position = dvec3(camera * dvec4(3.0 * unit(random), 2.0 * unit(random), -6.0 + 8.0 * unit(random), 1.0));
  // Some along the view, for which the sine of the angle is imprecise.
  const dvec3 along = dvec3(camera[2]) * (random() % 2 == 0 ? 1.0 : -1.0);
  placed.direction = vec3(random() % 3 == 0 ? glm::normalize(along + 1e-4 * direction()) : direction());
  scene.lights = {placed};
  return scene;
}

/// The view depths of points of a spot's cone: rim, axis and inside.
struct ConeDepths {
  double nearest = 1e30;
  double farthest = -1e30;
};
ConeDepths sampled_depths(const SpotScene& scene, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const PlacedLight& spot = scene.lights[0];
  const dvec3 axis = glm::normalize(dvec3(spot.direction));
  const dvec3 side = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.7 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  const dvec3 up = glm::cross(side, axis);
  const dvec3 forward = -dvec3(glm::transpose(scene.view.view_from_relative)[2]);
  const double apex = glm::dot(forward, spot.position - scene.view.position);
  ConeDepths found{apex, apex};
  const double half = std::clamp<double>(spot.light.outer_angle, 0.0, kMostAngle);
  for (int i = 0; i < 4000; ++i) {
    const double angle = i % 4 == 0 ? half : half * std::sqrt(unit(random)), turn = 6.283185307179586 * unit(random);
    const dvec3 ray = axis * std::cos(angle) + (side * std::cos(turn) + up * std::sin(turn)) * std::sin(angle);
    const double depth = apex + glm::dot(forward, ray) * static_cast<double>(spot.light.range_m);
    found.nearest = std::min(found.nearest, depth);
    found.farthest = std::max(found.farthest, depth);
  }
  return found;
}

TEST(SpotDepths, hold_the_points_of_the_cone_and_are_no_wider_than_the_sphere) {
  std::mt19937 random(7);
  int seen = 0, narrower = 0;
  for (int i = 0; i < 4000; ++i) {
    const SpotScene scene = random_spot(random);
    VisibleLights visible;
    select_lights(scene.lights, scene.view, visible);
    const ConeDepths cone = sampled_depths(scene, random);
    if (visible.depths.empty()) continue;
    ++seen;
    const double near_m = scene.view.near_m, range = scene.lights[0].light.range_m;
    const double nearest = visible.depths[0].nearest, farthest = visible.depths[0].farthest;
    // A cone before the near plane lights no pixel.
    ASSERT_LE(nearest, std::max(cone.nearest, near_m)) << i;
    ASSERT_GE(farthest, cone.farthest) << i;
    ASSERT_LE(nearest, farthest) << i;
    // Samples miss the extremes by little.
    const double slack = 0.03 * range + 1e-3;
    EXPECT_GE(nearest, std::max(cone.nearest, near_m) - slack) << i;
    EXPECT_LE(farthest, std::max(cone.farthest, near_m) + slack) << i;
    const Sphere sphere = light_bounds(scene.lights[0], scene.view.position);
    const dvec3 forward = -dvec3(glm::transpose(scene.view.view_from_relative)[2]);
    const double center = glm::dot(forward, dvec3(sphere.center)), radius = sphere.radius;
    const double rounding = 1e-5 * (radius + glm::length(dvec3(sphere.center))) + 1e-6;
    EXPECT_GE(nearest, center - radius - rounding) << i;
    EXPECT_LE(farthest, std::max(center + radius, near_m) + rounding) << i;
    narrower +=
        farthest - nearest < 0.9 * (std::max(center + radius, near_m) - std::max(center - radius, near_m)) ? 1 : 0;
  }
  EXPECT_GT(seen, 1000);
  EXPECT_GT(narrower, seen / 4);
}

}  // namespace
}  // namespace gloam
