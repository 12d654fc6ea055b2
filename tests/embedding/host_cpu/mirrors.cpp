// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The reflection proxies that each screen tile may show. The check reflects the ray of every pixel at the ground and
// intersects it with all proxies.
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "camera.h"
#include "checks.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/tiles.h"

namespace host {
namespace {

using namespace gloam;

constexpr double kGround_m = 0.2;

ProxySet random_proxies() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  ProxySet set;
  for (std::uint32_t i = 0; i < 48; ++i) {
    const double turn = 3.14 * unit(random);
    const dvec3 z(std::sin(turn), 0.0, std::cos(turn));
    const dvec3 x(z.z, 0.0, -z.x);
    const dvec3 at{9.0 * unit(random), 2.0 + 1.5 * unit(random), -14.0 + 10.0 * unit(random)};
    const dmat4 node(glm::dvec4(x, 0.0), glm::dvec4(0.0, 1.0, 0.0, 0.0), glm::dvec4(z, 0.0), glm::dvec4(at, 1.0));
    const IbrProxy proxy{.size_m = vec2(1.5f, 1.0f)};
    PlacedProxy placed;
    if (place_proxy(Entity{i, 1}, proxy, node, placed) == ProxyPlacement::placed) set.proxies.push_back(placed);
  }
  return set;
}

bool hits(const PlacedProxy& proxy, const dvec3& from, const dvec3& ray) {
  const double toward = -glm::dot(ray, proxy.normal);
  if (!(toward > 1e-9)) return false;  // only against the normal
  const double way = glm::dot(from - proxy.center, proxy.normal) / toward;
  if (way <= 0.0) return false;
  const dvec3 at = from + ray * way - proxy.center;
  const auto share = [&](const dvec3& half) { return std::abs(glm::dot(at, half)) / glm::dot(half, half); };
  return share(proxy.half_u) <= 1.0 && share(proxy.half_v) <= 1.0;
}

}  // namespace

void check_mirrors(JobExecutor& executor) {
  const ProxySet set = random_proxies();
  const HostCamera camera = looking_at(dvec3(0.0, 1.7, 1.0), dvec3(0.0, 0.8, -10.0));
  ProxyTiles tiles;
  build_proxy_tiles(set, camera.projection(), {.tiles = 32}, executor, tiles);

  std::uint32_t seen = 0;
  std::uint32_t lost = 0;
  for (std::uint32_t y = 0; y < camera.height; ++y) {
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      const dvec3 ray = camera.ray(x + 0.5, y + 0.5);
      if (ray.y >= -1e-6) continue;
      const dvec3 ground = camera.position() + ray * ((kGround_m - camera.position().y) / ray.y);
      const dvec3 reflected(ray.x, -ray.y, ray.z);
      const std::uint32_t tile = proxy_tile_of(x * tiles.columns / camera.width, tiles.columns, tiles.tiles);
      for (std::uint32_t p = 0, kept = 0; p < set.proxies.size(); ++p) {
        const bool is_kept = tiles.outcomes[p] == ProxyOutcome::kept;
        if (hits(set.proxies[p], ground, reflected)) {
          ++seen;
          lost += is_kept && tiles.may_reflect(tile, kept) ? 0 : 1;
        }
        kept += is_kept ? 1 : 0;
      }
    }
  }
  expect(seen > 1000, "pixels show proxies");
  expect(lost == 0, "the tile of every pixel lists the proxies that its reflected ray meets");
  std::uint32_t listed = 0;
  for (std::uint32_t tile = 0; tile < tiles.tiles; ++tile)
    for (std::uint32_t i = 0; i < tiles.proxies.size(); ++i) listed += tiles.may_reflect(tile, i) ? 1 : 0;
  expect(tiles.proxies.size() < set.proxies.size(), "proxies that face away are left out");
  expect(listed < tiles.tiles * tiles.proxies.size() / 2, "most tiles lack most proxies");
  std::printf("mirrors: %zu of %zu proxies kept, %u in lists of tiles\n", tiles.proxies.size(), set.proxies.size(),
              listed);
}

}  // namespace host
