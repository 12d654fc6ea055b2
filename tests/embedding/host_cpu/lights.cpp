// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Selects the lights of an ECS world for a view, and builds its zBins and tile light masks: three systems in a
// schedule. The check follows rays through all pixels, in double precision.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "camera.h"
#include "checks.h"
#include "engine/ecs/view.h"
#include "engine/ecs/world.h"
#include "engine/schedule/schedule.h"
#include "modules/lights/bins/z_bins.h"
#include "modules/lights/components.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/selection/light_list.h"

namespace host {
namespace {

using namespace gloam;

constexpr std::uint32_t kLights = 240;
constexpr float kFarthest_m = 60.0f;
constexpr std::uint32_t kBins = 64;

/// The host's own placement of entities.
struct Placement {
  dmat4 world_from_node = dmat4(1.0);
};

void select(View<const Light, const Placement> lights, ViewResource<const ViewProjection> view,
            ViewResource<VisibleLights> visible) {
  std::vector<PlacedLight> placed;
  lights.each([&](Entity entity, const Light& light, const Placement& at) {
    placed.push_back(place_light(entity, light, at.world_from_node));
  });
  select_lights(placed, *view, *visible);
}

void bin(ViewResource<const VisibleLights> visible, ViewResource<const ViewProjection> view, ViewResource<ZBins> bins) {
  bins->params = {view->near_m, kFarthest_m, kBins};
  bins->bins.resize(2 * kBins);
  const std::span<ZBin> all(bins->bins);
  build_z_bins(visible->depths, bins->params, bins->scratch, all.first(kBins), all.subspan(kBins));
}

void mask(ViewResource<const VisibleLights> visible, ViewResource<const ViewProjection> view,
          ViewResource<TileLightMasks> masks, JobExecutor& jobs) {
  build_tile_light_masks(visible->mask_lights, *view, TileBound::cone, jobs, *masks);
}

dmat4 random_node(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const dvec3 z = glm::normalize(dvec3{unit(random), unit(random), unit(random)} + dvec3(0.0, 0.01, 0.0));
  const dvec3 x = glm::normalize(glm::cross(dvec3(0.3, 0.9, 0.2), z));
  const double depth = 22.0 + 21.0 * unit(random);
  const dvec3 at{1.6 * depth * unit(random), 0.9 * depth * unit(random), -depth};
  return dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0), glm::dvec4(at, 1.0));
}

void fill(World& world) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  world.register_component<Light>();
  world.register_component<Placement>();
  for (std::uint32_t i = 0; i < kLights; ++i) {
    Light light;
    light.kind = i % 2 == 0 ? LightKind::point : LightKind::spot;
    light.range_m = 0.5f + 3.0f * unit(random);
    light.outer_angle = 0.3f + 1.2f * unit(random);
    world.create(light, Placement{random_node(random)});
  }
}

/// A light in double, as the check sees it.
struct Reach {
  dvec3 apex;
  dvec3 axis;
  double range = 0.0;
  double cosine = -1.0;

  [[nodiscard]] bool contains(const dvec3& point) const {
    const dvec3 to = point - apex;
    const double distance = glm::length(to);
    return distance <= range && glm::dot(to, axis) >= cosine * distance;
  }
};

/// Results of rays through pixels: the lights that a tile meets, and the depths at which a light was met.
struct Found {
  std::vector<std::uint8_t> in_tile;  ///< tile · lights + light
  std::uint32_t lost_in_masks = 0;    ///< points inside a light whose tile lacks the light
  std::uint32_t lost_in_bins = 0;     ///< points inside a light whose zBin lacks the light
};

constexpr int kSteps = 24;  // points on a ray's way through a light's sphere

Found follow_rays(const HostCamera& camera, std::span<const Reach> lights, const ZBins& bins,
                  const TileLightMasks& masks) {
  Found found;
  found.in_tile.resize(std::size_t{masks.tiles.x} * masks.tiles.y * lights.size());
  for (std::uint32_t y = 0; y < camera.height; ++y) {
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      const dvec3 ray = camera.ray(x + 0.5, y + 0.5);
      const std::size_t tile = std::size_t{y / 32} * masks.tiles.x + x / 32;
      const auto words = std::span(masks.words).subspan(tile * GLOAM_MASK_WORDS, GLOAM_MASK_WORDS);
      for (std::size_t i = 0; i < lights.size(); ++i) {
        const dvec3 to = lights[i].apex - camera.position();
        const double middle = glm::dot(to, ray) / glm::dot(ray, ray);
        const double away = glm::length(to - ray * middle);
        if (away >= lights[i].range) continue;
        const double half = std::sqrt((lights[i].range * lights[i].range - away * away) / glm::dot(ray, ray));
        const bool masked = (words[0] >> (i / 32) & 1u) != 0 && (words[1 + i / 32] >> (i % 32) & 1u) != 0;
        for (int step = 0; step <= kSteps; ++step) {
          const double depth = middle + half * (2.0 * step / kSteps - 1.0);
          if (depth < camera.near_m || !lights[i].contains(camera.position() + ray * depth)) continue;
          found.in_tile[tile * lights.size() + i] = 1;
          found.lost_in_masks += masked ? 0 : 1;
          const ZBin range = z_bin_range(bins, static_cast<float>(depth), static_cast<float>(depth));
          found.lost_in_bins += range.begin <= i && i < range.end ? 0 : 1;
        }
      }
    }
  }
  return found;
}

/// Bits of the masks whose light no ray of the tile meets, and all bits.
void count_bits(const TileLightMasks& masks, const Found& found, std::size_t lights, double& idle, double& all) {
  for (std::size_t tile = 0; tile < std::size_t{masks.tiles.x} * masks.tiles.y; ++tile) {
    const auto words = std::span(masks.words).subspan(tile * GLOAM_MASK_WORDS, GLOAM_MASK_WORDS);
    for (std::size_t i = 0; i < lights; ++i) {
      if ((words[0] >> (i / 32) & 1u) == 0 || (words[1 + i / 32] >> (i % 32) & 1u) == 0) continue;
      ++all;
      idle += found.in_tile[tile * lights + i] == 0 ? 1 : 0;
    }
  }
}

/// Bins of the standard set that begin or end with a light outside their depths.
std::uint32_t loose_bins(const ZBins& bins, std::span<const LightDepth> depths) {
  std::uint32_t loose = 0;
  const double length = (static_cast<double>(bins.params.far_m) - bins.params.near_m) / bins.params.count;
  const auto touches = [&](std::size_t light, double low, double high) {
    return depths[light].farthest >= low - 1e-3 && depths[light].nearest <= high + 1e-3;
  };
  for (std::uint32_t b = 0; b + 1 < bins.params.count; ++b) {  // depths beyond the end fall into the last bin
    const ZBin& range = bins.bins[b];
    if (range.begin >= range.end) continue;
    const double low = bins.params.near_m + b * length;
    if (!touches(range.begin, low, low + length) || !touches(range.end - 1u, low, low + length)) ++loose;
  }
  return loose;
}

}  // namespace

void check_lights(JobExecutor& executor) {
  const HostCamera camera = looking_at(dvec3(0.0, 0.5, 1.0), dvec3(0.3, 0.2, -20.0));
  const ViewId view{1};
  World world;
  fill(world);
  world.set_view_resource(view, camera.projection());
  world.set_view_resource(view, VisibleLights{});
  world.set_view_resource(view, ZBins{});
  world.set_view_resource(view, TileLightMasks{});
  Schedule schedule;
  schedule.add_system("select", "host", Stage::view, &select);
  schedule.add_system("bin", "host", Stage::view, &bin);
  schedule.add_system("mask", "host", Stage::view, &mask);
  schedule.run_view(view, world, executor);

  const VisibleLights& visible = world.view_resource<VisibleLights>(view);
  const ZBins& bins = world.view_resource<ZBins>(view);
  const TileLightMasks& masks = world.view_resource<TileLightMasks>(view);
  std::vector<Reach> lights;
  for (const Entity entity : visible.local_entities) {
    const Light& light = world.get<Light>(entity);
    const dmat4& node = world.get<Placement>(entity).world_from_node;
    const double cosine = light.kind == LightKind::spot ? std::cos(static_cast<double>(light.outer_angle)) : -1.0;
    lights.push_back({dvec3(node[3]), -dvec3(node[2]), light.range_m * (1.0 - 1e-6), cosine});
  }
  expect(lights.size() > kLights / 4 && lights.size() < kLights, "some lights are in view and some are not");
  expect(std::ranges::is_sorted(visible.depths, {}, &LightDepth::nearest), "lights are sorted by nearest depth");
  const Found found = follow_rays(camera, lights, bins, masks);
  expect(found.lost_in_masks == 0, "the tile of every pixel lists all lights that the pixel's ray meets");
  expect(found.lost_in_bins == 0, "the zBin of every depth holds all lights that reach it");
  expect(loose_bins(bins, visible.depths) == 0, "a zBin begins and ends with a light that touches it");
  double idle = 0.0;
  double all = 0.0;
  count_bits(masks, found, lights.size(), idle, all);
  expect(all > 500.0, "tiles list lights");
  expect(idle <= 0.15 * all, "at most 15 % of the bits are of lights that no ray of the tile meets");
  std::printf("lights: %zu of %u in view, %.0f bits in tile masks, %.0f of them idle\n", lights.size(), kLights, all,
              idle);
}

}  // namespace host
