// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The tiles of a view that a subject may shadow. The check looks for shadowed points: random points behind the box, as
// seen from random points of the emitter.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>

#include "camera.h"
#include "checks.h"
#include "modules/closeups/umbra/light.h"
#include "modules/closeups/umbra/tile_range.h"
#include "modules/closeups/umbra/umbra_projection.h"
#include "modules/lights/components.h"

namespace host {
namespace {

using namespace gloam;

dvec3 random_in_sphere(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (;;) {
    const dvec3 p{unit(random), unit(random), unit(random)};
    if (glm::dot(p, p) <= 1.0) return p;
  }
}

/// The pixel of a world position, if the camera sees it.
std::optional<glm::dvec2> pixel_of(const HostCamera& camera, const dvec3& world) {
  const dvec3 seen = glm::transpose(glm::dmat3(camera.world_from_camera)) * (world - camera.position());
  if (-seen.z < camera.near_m) return std::nullopt;
  const double up = std::tan(0.5 * camera.fov_y);
  const double right = up * camera.width / camera.height;
  const glm::dvec2 pixel((seen.x / (-seen.z * right) * 0.5 + 0.5) * camera.width,
                         (0.5 - seen.y / (-seen.z * up) * 0.5) * camera.height);
  const bool inside = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < camera.width && pixel.y < camera.height;
  return inside ? std::optional(pixel) : std::nullopt;
}

}  // namespace

void check_umbra() {
  constexpr int kPoints = 400'000;
  Light light;
  light.width_m = 0.3f;
  light.range_m = 9.0f;
  const dvec3 lamp(0.5, 4.0, -8.0);
  dmat4 node(1.0);
  node[3] = glm::dvec4(lamp, 1.0);
  const std::optional<CloseupLight> placed = closeup_light(light, node);
  expect(placed.has_value(), "a light of finite numbers can be placed");
  if (!placed) return;
  const WorldBox subject{dvec3(-1.2, 1.6, -8.4), dvec3(-0.6, 2.4, -7.8)};
  const HostCamera camera = looking_at(dvec3(1.0, 2.5, 2.0), dvec3(0.0, 1.5, -8.0));
  const TileRange range = umbra_tiles(*placed, subject, WorldBox{}, camera.projection());

  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  TileRange met{uvec2(~0u), uvec2(0)};
  int shadowed = 0;
  int outside = 0;
  for (int i = 0; i < kPoints; ++i) {
    const dvec3 from = lamp + random_in_sphere(random) * (0.5 * static_cast<double>(light.width_m));
    const dvec3 share{unit(random), unit(random), unit(random)};
    const dvec3 blocker = subject.min + (subject.max - subject.min) * share;
    const dvec3 receiver = blocker + (blocker - from) * (4.0 * unit(random));
    if (glm::length(receiver - lamp) > static_cast<double>(light.range_m)) continue;
    const std::optional<glm::dvec2> pixel = pixel_of(camera, receiver);
    if (!pixel) continue;
    ++shadowed;
    const uvec2 tile = uvec2(*pixel) / kShadowTile;
    met.begin = glm::min(met.begin, tile);
    met.end = glm::max(met.end, tile + 1u);
    const bool inside = glm::all(glm::greaterThanEqual(tile, range.begin)) && glm::all(glm::lessThan(tile, range.end));
    outside += inside ? 0 : 1;
  }
  expect(shadowed > kPoints / 20, "the camera sees shadowed points");
  expect(outside == 0, "every shadowed point is in the umbra range");
  const auto slack = [](std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; };
  const bool tight = slack(met.begin.x, range.begin.x) <= 2 && slack(met.begin.y, range.begin.y) <= 2 &&
                     slack(met.end.x, range.end.x) <= 2 && slack(met.end.y, range.end.y) <= 2;
  expect(tight, "the umbra range ends within two tiles of the shadowed points");
  std::printf("umbra: tiles %u,%u to %u,%u; points in %u,%u to %u,%u\n", range.begin.x, range.begin.y, range.end.x,
              range.end.y, met.begin.x, met.begin.y, met.end.x, met.end.y);
}

}  // namespace host
