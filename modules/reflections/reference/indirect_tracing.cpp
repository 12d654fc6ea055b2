// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/indirect_tracing.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/math/finite.h"
#include "engine/scene/assets.h"
#include "engine/scene/resources.h"
#include "modules/reflections/reference/adapter.h"
#include "modules/reflections/reference/hit_lights.h"
#include "modules/reflections/reference/lobe.h"
#include "modules/reflections/reference/traced_rows.h"
#include "modules/shadows/reference.h"

namespace gloam {
namespace {

/// Traces pixels for one job.
class DiffuseTracer {
 public:
  DiffuseTracer(const RadianceInput& input, const TwinLights& lights)
      : input_(input),
        assets_(input.world.resource<SceneAssets>()),
        sky_(input.world.resource<SceneEnvironment>()),
        tracer_from_camera_(input.geometry.view.position - input.tracer.origin()),
        lights_(lights, input.tracer, tracer_from_camera_) {}

  [[nodiscard]] dvec3 trace(const PixelSurface& surface, std::uint32_t pixel) {
    const PixelSequence sequence(pixel);
    aim(surface, sequence);
    if (rays_.empty()) return dvec3(0.0);
    surfaces_.resize(rays_.size());
    input_.tracer.nearest(assets_, rays_, surfaces_);
    points_.resize(rays_.size());
    radiance_.assign(rays_.size(), dvec3(0.0));
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const TracedSurface& s = surfaces_[i];
      const dvec3 direction(rays_[i].direction);
      if (!s.hit) {
        radiance_[i] = sky_radiance(sky_, direction);
        continue;
      }
      radiance_[i] = dvec3(s.emissive);
      points_[i] =
          twin_point(-direction, glm::normalize(dvec3(s.normal)), dvec3(s.base_color), s.metallic, s.roughness);
    }
    lights_.add({surfaces_, points_, radiance_}, input_.settings.light_samples, sequence);
    dvec3 sum(0.0);
    for (const dvec3& radiance : radiance_) sum += is_finite(radiance) ? radiance : dvec3(0.0);
    return sum / static_cast<double>(radiance_.size());
  }

 private:
  void aim(const PixelSurface& surface, const PixelSequence& sequence) {
    rays_.clear();
    const dvec3 origin = ray_start(surface.position + tracer_from_camera_, surface.face_normal, tracer_from_camera_,
                                   input_.geometry.error_share);
    const dvec3& n = surface.normal;
    const dvec3 across = glm::normalize(glm::cross(std::abs(n.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), n));
    const dvec3 along = glm::cross(n, across);
    for (std::uint32_t i = 0; i < input_.settings.rays; ++i) {
      const PixelSequence::Pair at = sequence.direction(i);
      const double radius = std::sqrt(at.x), angle = 2.0 * std::numbers::pi * at.y;
      const dvec3 direction = radius * (std::cos(angle) * across + std::sin(angle) * along) + std::sqrt(1.0 - at.x) * n;
      if (glm::dot(direction, surface.face_normal) > 0.0)
        rays_.push_back({.origin = vec3(origin), .direction = vec3(glm::normalize(direction))});
    }
  }

  const RadianceInput& input_;
  const SceneAssets& assets_;
  const SceneEnvironment& sky_;
  const dvec3 tracer_from_camera_;
  HitLights lights_;
  std::vector<SurfaceRay> rays_;
  std::vector<TracedSurface> surfaces_;
  std::vector<TwinPoint> points_;
  std::vector<dvec3> radiance_;
};

}  // namespace

TracedIndirect trace_indirect(const RadianceInput& input) {
  TracedIndirect traced;
  const TwinLights lights = gather_lights(input.world, input.tracer);
  trace_rows(
      input, traced, [&] { return DiffuseTracer(input, lights); }, [](const PixelSurface&) { return true; });
  return traced;
}

Result<TracedIndirect> find_indirect(const ReferenceInput& input) {
  if (input.tracer == nullptr || input.geometry == nullptr)
    return Error{ErrorKind::usage,
                 "traced light of the surroundings needs the scene's triangles and the frame's geometry"};
  RadianceInput what = {.world = input.world,
                        .geometry = *input.geometry,
                        .tracer = *input.tracer,
                        .executor = input.executor,
                        .settings = {},
                        .progress = input.progress};
  what.settings.rays = std::max(input.samples, 1u);
  if (input.store == nullptr) return trace_indirect(what);
  const std::string identity = "diffuse 1 " + radiance_identity(what);
  if (const std::optional<std::string> kept = input.store->load(identity))
    if (std::optional<TracedReflections> traced = reflections_from_bytes(*kept))
      return TracedIndirect{std::move(*traced)};
  TracedIndirect traced = trace_indirect(what);
  GLOAM_TRY(input.store->save(identity, to_bytes(traced)));
  return traced;
}

Status put_traced_indirect(World& world, const ReferenceInput& input) {
  auto traced = find_indirect(input);
  if (!traced) return traced.error();
  world.set_resource(std::move(traced).value());
  return {};
}

ReferenceInfo traced_indirect(std::string knob) {
  ReferenceInfo info = {
      .knob = std::move(knob), .kind = "traced", .name = "one diffuse bounce, traced", .samples = true};
  info.draw = [](const ReferenceInput& input) -> Result<FramePictures> {
    if (!input.redraw)
      return Error{ErrorKind::usage, "traced light of the surroundings needs a frame that can be drawn again"};
    auto traced = find_indirect(input);
    if (!traced) return traced.error();
    const auto shared = std::make_shared<TracedIndirect>(std::move(traced).value());
    return input.redraw([shared](World& world) { world.set_resource(std::move(*shared)); },
                        [](World& world) { world.remove_resource<TracedIndirect>(); });
  };
  return info;
}

}  // namespace gloam
