// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "engine/scene/units.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/fitting/caught_rays.h"
#include "modules/reflections/fitting/choose_quads.h"
#include "modules/reflections/fitting/reflected_rays.h"
#include "modules/reflections/fitting/region_quads.h"
#include "modules/reflections/fitting/scene_surfaces.h"
#include "modules/reflections/module.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

/// Numbers of the low-discrepancy sequences.
constexpr std::uint32_t kChoice = 1;
constexpr std::uint32_t kJudgement = 2;

constexpr std::uint32_t kPixelsAnEye = 64;
constexpr std::uint32_t kMostPixelsACamera = 8192;

/// Fire proxies stand for flames, which have no triangles.
ProxySet existing_proxies(const World& world) {
  ProxySet set;
  const double metres = 1.0 / scene_unit(world);
  world.view<const IbrProxy, const WorldTransform>().each(
      [&](Entity entity, const IbrProxy& proxy, const WorldTransform& transform) {
        PlacedProxy placed;
        if (proxy.kind == IbrProxyKind::scene &&
            place_proxy(entity, proxy, metric_matrix(transform.matrix, metres), placed) == ProxyPlacement::placed)
          set.proxies.push_back(placed);
      });
  world.view<const IbrRoom, const WorldTransform, Maybe<const ReflectingHeights>>().each(
      [&](Entity entity, const IbrRoom& room, const WorldTransform& transform, const ReflectingHeights* heights) {
        PlacedRoom placed;
        if (!place_room(entity, room, heights, metric_matrix(transform.matrix, metres), placed)) return;
        for (double& height : placed.heights_m) height *= metres;
        set.rooms.push_back(std::move(placed));
      });
  return set;
}

struct NamedCamera {
  std::string name;
  RayCamera camera;
};

std::vector<NamedCamera> perspective_cameras(const World& world, std::span<const Entity> entities) {
  std::vector<NamedCamera> cameras;
  for (const Entity entity : entities) {
    const auto* lens = world.try_get<Camera>(entity);
    const auto* transform = world.try_get<WorldTransform>(entity);
    if (lens == nullptr || transform == nullptr || lens->orthographic) continue;
    NamedCamera named = {.name = "camera " + std::string(world.resource<SceneNames>().name_of(entity)), .camera = {}};
    named.camera.fov_y = static_cast<double>(lens->fov_y);
    named.camera.world_from_camera[3] = metric_matrix(transform->matrix, 1.0 / scene_unit(world))[3];
    for (int axis = 0; axis < 3; ++axis)
      named.camera.world_from_camera[axis] = dvec4(glm::normalize(dvec3(transform->matrix[axis])), 0.0);
    cameras.push_back(std::move(named));
  }
  return cameras;
}

/// quad: in metres.
ProposedProxy proposed(const PlacedProxy& quad, double unit) {
  ProposedProxy proxy;
  proxy.translation = quad.center * unit;
  const double half_width = glm::length(quad.half_u), half_height = glm::length(quad.half_v);
  proxy.rotation = glm::quat_cast(glm::dmat3(quad.half_u / half_width, quad.half_v / half_height, quad.normal));
  proxy.size_m = vec2(static_cast<float>(2.0 * half_width * unit), static_cast<float>(2.0 * half_height * unit));
  return proxy;
}

/// Distances in metres, of a tracer in units.
TraceDistances metric_distances(const SurfaceDistances& trace, double metres_per_unit) {
  return [&trace, metres_per_unit](std::span<const dvec3> origins, std::span<const dvec3> directions,
                                   std::span<double> hits_m) {
    std::vector<dvec3> in_units(origins.begin(), origins.end());
    for (dvec3& origin : in_units) origin /= metres_per_unit;
    trace(in_units, directions, hits_m);
    for (double& hit_m : hits_m) hit_m *= metres_per_unit;
  };
}

/// Samples the rays of one proposal.
class RaySource {
 public:
  RaySource(const SceneSurfaces& surfaces, std::uint32_t eyes, std::size_t cameras, TraceDistances trace)
      : ground_(surfaces.ground), receivers_(surfaces.reflective), eyes_(eyes), trace_(std::move(trace)) {
    // The cameras together get as many pixels as the eyes.
    const std::size_t fair = std::size_t{eyes} * kPixelsAnEye / std::max<std::size_t>(cameras, 1);
    pixels_a_camera_ = static_cast<std::uint32_t>(std::min<std::size_t>(fair, kMostPixelsACamera));
  }

  [[nodiscard]] std::vector<ReflectedRay> of_camera(const RayCamera& camera, std::uint32_t sequence) const {
    const RaySettings settings = {.pixels_a_camera = pixels_a_camera_, .sequence = sequence};
    return camera_rays(std::span(&camera, 1), receivers_, settings, trace_);
  }
  [[nodiscard]] std::vector<ReflectedRay> of_eyes(std::uint32_t sequence) const {
    const RaySettings settings = {.pixels_a_camera = kPixelsAnEye, .eyes = eyes_, .sequence = sequence};
    return camera_rays(random_eyes(ground_, receivers_, settings, trace_), receivers_, settings, trace_);
  }

 private:
  UpTriangles ground_;
  UpTriangles receivers_;
  std::uint32_t eyes_;
  std::uint32_t pixels_a_camera_ = 0;
  TraceDistances trace_;
};

std::vector<PlacedProxy> choose(std::span<const FittedQuad> candidates, const ProxyFitRequest& request,
                                std::span<const PlacedRoom> rooms, std::span<const ReflectedRay> rays,
                                JobExecutor& jobs) {
  std::vector<PlacedProxy> quads;
  for (const FittedQuad& candidate : candidates) quads.push_back(candidate.quad);
  std::vector<PlacedProxy> chosen;
  for (const std::uint32_t index : choose_quads(quads, request.count, rooms, rays, jobs))
    chosen.push_back(quads[index]);
  return chosen;
}

}  // namespace

ProxyProposal propose_proxies(const World& world, const ProxyFitRequest& request, const SurfaceDistances& trace,
                              JobExecutor& jobs) {
  const SceneSurfaces surfaces = gather_surfaces(world);
  const ProxySet existing = existing_proxies(world);
  const std::vector<NamedCamera> cameras = perspective_cameras(world, request.cameras);
  const double metres = 1.0 / scene_unit(world);
  const double unit = 1.0 / metres;
  const RaySource source(surfaces, request.eyes, cameras.size(), metric_distances(trace, metres));

  std::vector<ReflectedRay> rays = source.of_eyes(kChoice);
  for (std::size_t i = 0; request.look_at_cameras && i < cameras.size(); ++i) {
    const std::vector<ReflectedRay> more = source.of_camera(cameras[i].camera, kChoice);
    rays.insert(rays.end(), more.begin(), more.end());
  }
  std::vector<PlacedProxy> chosen;
  ProxyProposal proposal;
  if (rays.empty()) {
    const std::vector<FittedQuad> quads = fit_quads(surfaces.instances, RegionTolerance(), QuadSettings(), jobs);
    proposal.candidates = quads.size();
    for (std::size_t i = 0; i < std::min(quads.size(), request.count); ++i) chosen.push_back(quads[i].quad);
  } else {
    const std::vector<FittedQuad> candidates = candidate_quads(surfaces.instances, QuadSettings(), jobs);
    proposal.candidates = candidates.size();
    chosen = choose(candidates, request, existing.rooms, rays, jobs);
  }
  for (const PlacedProxy& quad : chosen) proposal.proxies.push_back(proposed(quad, unit));
  proposal.existing = existing.proxies.size();
  const auto judge = [&](std::string viewers, const std::vector<ReflectedRay>& judged) {
    const CaughtRays by_chosen = caught_rays(chosen, existing.rooms, judged, jobs);
    const CaughtRays by_existing = caught_rays(existing.proxies, existing.rooms, judged, jobs);
    proposal.shares.push_back(
        {std::move(viewers), by_chosen.surface_rays, by_chosen.in_rooms, by_chosen.caught, by_existing.caught});
  };
  for (const NamedCamera& camera : cameras) judge(camera.name, source.of_camera(camera.camera, kJudgement));
  judge("eyes", source.of_eyes(kJudgement));
  return proposal;
}

}  // namespace gloam
