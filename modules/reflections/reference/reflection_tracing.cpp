// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/reflection_tracing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/assert.h"
#include "engine/math/finite.h"
#include "engine/render/camera/light_scale.h"
#include "engine/scene/assets.h"
#include "engine/scene/resources.h"
#include "modules/reflections/reference/hit_lights.h"
#include "modules/reflections/reference/lobe.h"
#include "modules/reflections/reference/shading.h"
#include "modules/reflections/reference/traced_rows.h"
#include "modules/shadows/reference.h"

namespace gloam {
namespace {

/// Share of its surroundings that a surface shows, from which on each ray to it is followed by one.
constexpr double kFullShare = 0.05;

double greatest_of(const dvec3& color) { return std::max({color.r, color.g, color.b}); }

/// All rays of a pixel that left as many surfaces behind, with what they met.
struct Bounce {
  std::vector<SurfaceRay> rays;
  std::vector<double> weights;      ///< in the mean of their surface's lobe
  std::vector<std::uint32_t> from;  ///< index of the surface that a ray leaves, in the bounce before; ascending
  std::vector<double> scales;       ///< by which the mean of their surface's rays counts
  std::vector<TracedSurface> surfaces;
  std::vector<TwinPoint> points;  ///< of surfaces
  std::vector<dvec3> radiance;    ///< of surfaces, toward the rays' origins

  void clear() {
    rays.clear();
    weights.clear();
    from.clear();
    scales.clear();
  }
};

/// Traces pixels for one job. Positions are relative to the tracer's origin.
class PixelTracer {
 public:
  PixelTracer(const RadianceInput& input, const TwinLights& lights)
      : input_(input),
        settings_(input.settings),
        assets_(input.world.resource<SceneAssets>()),
        sky_(input.world.resource<SceneEnvironment>()),
        tracer_from_camera_(input.geometry.view.position - input.tracer.origin()),
        lights_(lights, input.tracer, tracer_from_camera_),
        bounces_(input.settings.bounces) {}

  [[nodiscard]] dvec3 trace(const PixelSurface& surface, std::uint32_t pixel) {
    const dvec3 origin = ray_start(surface.position + tracer_from_camera_, surface.face_normal, tracer_from_camera_,
                                   input_.geometry.error_share);
    const ReflectionLobe lobe(surface.normal, surface.face_normal, surface.to_eye, surface.roughness);
    bounces_[0].clear();
    aim(lobe, surface.roughness, origin, {.pixel = pixel, .bounce = 0, .from = 0, .rays = settings_.rays});
    trace_bounce(pixel, 0);
    return mean_seen(0, 0, bounces_[0].rays.size());
  }

 private:
  /// What rays are sent for.
  struct Aim {
    std::uint32_t pixel = 0;
    std::uint32_t bounce = 0;  ///< that the rays are added to
    std::uint32_t from = 0;    ///< Bounce::from
    std::uint32_t rays = 0;    ///< for a surface that is no mirror
    double scale = 1.0;        ///< Bounce::scales
  };

  /// Adds the rays of a surface: at least one.
  void aim(const ReflectionLobe& lobe, double roughness, const dvec3& origin, const Aim& what) {
    Bounce& bounce = bounces_[what.bounce];
    const std::size_t before = bounce.rays.size();
    const auto send = [&](const dvec3& direction, double weight) {
      bounce.rays.push_back({.origin = vec3(origin), .direction = vec3(direction)});
      bounce.weights.push_back(weight);
      bounce.from.push_back(what.from);
      bounce.scales.push_back(what.scale);
    };
    const bool mirror = roughness < kMirrorRoughness;
    if (!mirror && what.rays == 1) {
      const PixelSequence sequence(what.pixel, 2 * what.bounce + 1);
      const LobeDirection one = lobe.one(sequence, what.from, sequence.choice(what.from));
      if (one.weight > 0.0) send(one.direction, 1.0);
    } else if (!mirror) {
      const PixelSequence sequence(what.pixel, 2 * what.bounce);
      for (std::uint32_t i = 0; i < what.rays; ++i) {
        const PixelSequence::Pair at = sequence.direction(i);
        const LobeDirection sampled = lobe.sample(at.x, at.y);
        if (sampled.weight > 0.0) send(sampled.direction, sampled.weight);
      }
    }
    if (bounce.rays.size() == before) send(lobe.mirror(), 1.0);
  }

  /// Sets the radiance of the surfaces that the rays of a bounce meet.
  void trace_bounce(std::uint32_t pixel, std::uint32_t index) {
    Bounce& bounce = bounces_[index];
    bounce.surfaces.resize(bounce.rays.size());
    input_.tracer.nearest(assets_, bounce.rays, bounce.surfaces);
    shade(bounce, index + 1 == settings_.bounces);
    const std::uint32_t samples =
        bounce.rays.size() == 1 ? settings_.rays * settings_.light_samples : settings_.light_samples;
    lights_.add({bounce.surfaces, bounce.points, bounce.radiance}, samples, PixelSequence(pixel, 2 * index));
    if (index + 1 == settings_.bounces) return;
    send_further(pixel, index);
    if (bounces_[index + 1].rays.empty()) return;
    trace_bounce(pixel, index + 1);
    add_reflections(index);
  }

  /// Sets radiance without lights and traced reflections.
  void shade(Bounce& bounce, bool last) {
    bounce.points.resize(bounce.rays.size());
    bounce.radiance.resize(bounce.rays.size());
    for (std::size_t i = 0; i < bounce.rays.size(); ++i) {
      const TracedSurface& s = bounce.surfaces[i];
      const dvec3 direction(bounce.rays[i].direction);
      if (!s.hit) {
        bounce.radiance[i] = sky_radiance(sky_, direction);
        continue;
      }
      const TwinPoint& p = bounce.points[i] =
          twin_point(-direction, glm::normalize(dvec3(s.normal)), dvec3(s.base_color), s.metallic, s.roughness);
      const double of_sky = last ? 1.0 : 1.0 - static_cast<double>(s.reflectivity);
      bounce.radiance[i] =
          dvec3(s.emissive) + static_cast<double>(s.occlusion) *
                                  (diffuse_ambient(sky_, p) + of_sky * specular_share(p) * mirrored_radiance(sky_, p));
    }
  }

  /// Sends rays from the surfaces of a bounce that reflect. A pixel's only ray is followed by as many as a rough pixel
  /// has: a rough surface in a mirror is as free of noise as the same surface seen directly. Surfaces that reflect
  /// little have fewer rays: less than one in the mean, which then counts for more.
  void send_further(std::uint32_t pixel, std::uint32_t index) {
    const Bounce& bounce = bounces_[index];
    bounces_[index + 1].clear();
    const PixelSequence sequence(pixel, 2 * index + 3);
    for (std::uint32_t i = 0; i < bounce.rays.size(); ++i) {
      const TracedSurface& s = bounce.surfaces[i];
      if (!s.hit || !(s.reflectivity > 0.0f)) continue;
      const double sent = std::min(greatest_of(reflected_share(bounce, i)) / kFullShare, 1.0);
      std::uint32_t rays = 1;
      double scale = 1.0;
      if (bounce.rays.size() == 1) {
        rays = std::max(static_cast<std::uint32_t>(std::ceil(sent * settings_.rays)), 1u);
      } else {
        if (!(sequence.emitter(i).x < sent)) continue;
        scale = 1.0 / sent;
      }
      const dvec3 face_normal = glm::normalize(dvec3(s.face_normal));
      const dvec3 start = ray_start(dvec3(s.position), face_normal, tracer_from_camera_);
      const TwinPoint& p = bounce.points[i];
      aim(ReflectionLobe(p.normal, face_normal, p.to_eye, p.roughness), p.roughness, start,
          {.pixel = pixel, .bounce = index + 1, .from = i, .rays = rays, .scale = scale});
    }
  }

  /// Share of a traced reflection that a surface shows.
  [[nodiscard]] static dvec3 reflected_share(const Bounce& bounce, std::size_t i) {
    const TracedSurface& s = bounce.surfaces[i];
    return static_cast<double>(s.occlusion * s.reflectivity) * specular_share(bounce.points[i]);
  }

  /// Adds what the rays of the next bounce show to the surfaces that they leave.
  void add_reflections(std::uint32_t index) {
    const std::vector<std::uint32_t>& from = bounces_[index + 1].from;
    Bounce& bounce = bounces_[index];
    for (std::size_t begin = 0, end = 0; begin < from.size(); begin = end) {
      while (end < from.size() && from[end] == from[begin]) ++end;
      bounce.radiance[from[begin]] +=
          bounces_[index + 1].scales[begin] * reflected_share(bounce, from[begin]) * mean_seen(index + 1, begin, end);
    }
  }

  /// Mean of what rays show at their starts.
  [[nodiscard]] dvec3 mean_seen(std::uint32_t index, std::size_t begin, std::size_t end) {
    dvec3 sum(0.0);
    double weight = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      sum += bounces_[index].weights[i] * seen_by(bounces_[index], i);
      weight += bounces_[index].weights[i];
    }
    return sum / weight;
  }

  /// Radiance at the start of a ray, through quads and fog.
  [[nodiscard]] dvec3 seen_by(const Bounce& bounce, std::size_t i) {
    const TracedSurface& s = bounce.surfaces[i];
    dvec3 radiance = glm::min(bounce.radiance[i], dvec3(kMostHalf / input_.geometry.view.light_scale));
    if (!is_finite(radiance)) radiance = dvec3(0.0);
    const double distance = s.hit ? static_cast<double>(s.distance_m) : settings_.fog.sky_distance_m;
    radiance = in_fog(radiance, 1.0, distance);
    if (settings_.quads.empty()) return radiance;
    const double end = s.hit ? distance : std::numeric_limits<double>::infinity();
    const SurfaceRay& ray = bounce.rays[i];
    find_layers(settings_.quads, dvec3(ray.origin) + input_.tracer.origin(), dvec3(ray.direction), end, layers_);
    for (auto layer = layers_.rbegin(); layer != layers_.rend(); ++layer)
      radiance = in_fog(layer->radiance, layer->alpha, layer->distance_m) + (1.0 - layer->alpha) * radiance;
    return radiance;
  }

  [[nodiscard]] dvec3 in_fog(const dvec3& radiance, double alpha, double distance_m) const {
    const double transmitted = std::exp(-settings_.fog.density * distance_m);
    return transmitted * radiance + (1.0 - transmitted) * alpha * settings_.fog.color;
  }

  const RadianceInput& input_;
  const ReflectionTracing& settings_;
  const SceneAssets& assets_;
  const SceneEnvironment& sky_;
  const dvec3 tracer_from_camera_;
  HitLights lights_;
  std::vector<Bounce> bounces_;
  std::vector<QuadLayer> layers_;
};

}  // namespace

TracedReflections trace_radiance(const RadianceInput& input) {
  GLOAM_ASSERT(input.settings.bounces > 0, "at least one bounce");
  TracedReflections traced;
  const TwinLights lights = gather_lights(input.world, input.tracer);
  trace_rows(
      input, traced, [&] { return PixelTracer(input, lights); },
      [](const PixelSurface& surface) { return surface.reflectivity > 0.0; });
  return traced;
}

}  // namespace gloam
