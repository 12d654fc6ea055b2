// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/reflection_tracing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "engine/core/assert.h"
#include "engine/core/hash.h"
#include "engine/math/finite.h"
#include "engine/render/camera/light_scale.h"
#include "engine/scene/assets.h"
#include "engine/scene/resources.h"
#include "modules/reflections/reference/lobe.h"
#include "modules/reflections/reference/pixel_surface.h"
#include "modules/reflections/reference/shading.h"
#include "modules/shadows/reference.h"

namespace gloam {
namespace {

/// Offset of ray starts as a share of the point's and the camera's coordinates: as in traced visibility.
constexpr double kRayStartShare = 4e-5;
constexpr double kBehindSurface = 2e-4;  // sine of an angle below a surface, from which on it hides a light

/// Positions are relative to the tracer's origin. share: GeometryPicture::error_share for a point of that picture.
dvec3 ray_start(const dvec3& position, const dvec3& face_normal, const dvec3& camera, double share = kRayStartShare) {
  return position + face_normal * (share * (glm::length(position) + glm::length(camera)));
}

double brightness_of(const dvec3& color) { return color.r + color.g + color.b; }

/// Light that one shadow ray carries to a pixel's ray if nothing blocks it.
struct Carried {
  std::uint32_t ray = 0;
  std::uint32_t bulbs = 0;  ///< TwinLight::bulbs
  dvec3 light = dvec3(0.0);
};

/// Traces pixels for one job. Positions are relative to the tracer's origin.
class PixelTracer {
 public:
  PixelTracer(const RadianceInput& input, const TwinLights& lights)
      : input_(input),
        settings_(input.settings),
        lights_(lights),
        assets_(input.world.resource<SceneAssets>()),
        sky_(input.world.resource<SceneEnvironment>()),
        tracer_from_camera_(input.geometry.view.position - input.tracer.origin()) {}

  [[nodiscard]] dvec3 trace(const PixelSurface& surface, std::uint32_t pixel) {
    const PixelSequence sequence(pixel);
    aim(surface, sequence);
    surfaces_.resize(rays_.size());
    input_.tracer.nearest(assets_, rays_, surfaces_);
    shade(sequence);
    add_unblocked_light();
    dvec3 sum(0.0);
    double weight = 0.0;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      sum += weights_[i] * seen_by(i);
      weight += weights_[i];
    }
    return sum / weight;
  }

 private:
  /// Sets up the pixel's rays and their weights.
  void aim(const PixelSurface& surface, const PixelSequence& sequence) {
    const ReflectionLobe lobe(surface.normal, surface.face_normal, surface.to_eye, surface.roughness);
    const vec3 origin(ray_start(surface.position + tracer_from_camera_, surface.face_normal, tracer_from_camera_,
                                input_.geometry.error_share));
    rays_.clear();
    weights_.clear();
    for (std::uint32_t i = 0; surface.roughness >= kMirrorRoughness && i < settings_.rays; ++i) {
      const PixelSequence::Pair at = sequence.direction(i);
      const LobeDirection sampled = lobe.sample(at.x, at.y);
      if (!(sampled.weight > 0.0)) continue;
      rays_.push_back({.origin = origin, .direction = vec3(sampled.direction)});
      weights_.push_back(sampled.weight);
    }
    if (!rays_.empty()) return;
    rays_.push_back({.origin = origin, .direction = vec3(lobe.mirror())});
    weights_.push_back(1.0);
  }

  /// Sets the radiance of each ray's surface without lights, and sets up the shadow rays.
  void shade(const PixelSequence& sequence) {
    radiance_.assign(rays_.size(), dvec3(0.0));
    shadow_rays_.clear();
    carried_.clear();
    const std::uint32_t samples =
        rays_.size() == 1 ? settings_.rays * settings_.light_samples : settings_.light_samples;
    for (std::uint32_t i = 0; i < rays_.size(); ++i) {
      const TracedSurface& s = surfaces_[i];
      if (!s.hit) {
        radiance_[i] = sky_radiance(sky_, dvec3(rays_[i].direction));
        continue;
      }
      const TwinPoint p = twin_point(-dvec3(rays_[i].direction), glm::normalize(dvec3(s.normal)), dvec3(s.base_color),
                                     s.metallic, s.roughness);
      radiance_[i] = dvec3(s.emissive) + static_cast<double>(s.occlusion) * diffuse_ambient(sky_, p);
      choose_lights(i, p, samples, sequence);
    }
  }

  /// Shares the shadow rays of a ray's surface among the lights.
  void choose_lights(std::uint32_t ray, const TwinPoint& p, std::uint32_t samples, const PixelSequence& sequence) {
    const dvec3 position(surfaces_[ray].position);
    candidates_.clear();
    double total = 0.0;
    for (const TwinLight& light : lights_.lights) {
      dvec3 to_light(0.0);
      const dvec3 illuminance = illuminance_of(light, position, to_light);
      if (!(brightness_of(illuminance) > 0.0) || !(glm::dot(p.normal, to_light) > 0.0)) continue;
      const dvec3 reflected = reflected_light(p, to_light, illuminance);
      const double brightness = brightness_of(reflected);
      if (!(brightness > 0.0) || !std::isfinite(brightness)) continue;
      if (!light.casts) {
        radiance_[ray] += reflected;
        continue;
      }
      total += brightness;
      candidates_.push_back({&light, reflected, total});
    }
    if (candidates_.empty()) return;
    for (std::uint32_t k = 0; k < samples; ++k) {
      const double at_share = (k + sequence.choice(ray)) / samples;
      const auto chosen = std::lower_bound(candidates_.begin(), candidates_.end() - 1, at_share * total,
                                           [](const Candidate& c, double at) { return c.up_to < at; });
      const double probability = brightness_of(chosen->reflected) / total;
      send_shadow_ray(ray, *chosen->light, chosen->reflected / (probability * samples),
                      sequence.emitter(ray * samples + k));
    }
  }

  void send_shadow_ray(std::uint32_t ray, const TwinLight& light, const dvec3& carried,
                       const PixelSequence::Pair& on_emitter) {
    const TracedSurface& s = surfaces_[ray];
    const dvec3 face_normal = glm::normalize(dvec3(s.face_normal));
    ShadowRay shadow;
    // A subsurface material is lit from both sides of its triangles.
    const bool from_behind = s.subsurface && glm::dot(face_normal, light.kind == LightKind::directional
                                                                       ? -light.axis
                                                                       : light.position - dvec3(s.position)) < 0.0;
    const dvec3 start = ray_start(dvec3(s.position), from_behind ? -face_normal : face_normal, tracer_from_camera_);
    if (!aim_at_emitter(light, start, on_emitter.x, on_emitter.y, shadow)) {
      radiance_[ray] += carried;
      return;
    }
    const double above = glm::dot(dvec3(shadow.direction), face_normal);
    if (!s.subsurface && above < -kBehindSurface * static_cast<double>(glm::length(shadow.direction))) return;
    shadow_rays_.push_back(shadow);
    carried_.push_back({ray, light.bulbs, carried});
  }

  void add_unblocked_light() {
    for (std::uint32_t set = 0; set < lights_.bulbs.size(); ++set) {
      batch_.clear();
      batch_from_.clear();
      for (std::size_t i = 0; i < carried_.size(); ++i) {
        if (carried_[i].bulbs != set) continue;
        batch_.push_back(shadow_rays_[i]);
        batch_from_.push_back(i);
      }
      if (batch_.empty()) continue;
      blocked_.resize(batch_.size());
      input_.tracer.occluded(batch_, blocked_, lights_.bulbs[set]);
      for (std::size_t i = 0; i < batch_.size(); ++i)
        if (blocked_[i] == 0) radiance_[carried_[batch_from_[i]].ray] += carried_[batch_from_[i]].light;
    }
  }

  /// Radiance at the start of a ray, through quads and fog.
  [[nodiscard]] dvec3 seen_by(std::size_t i) {
    const TracedSurface& s = surfaces_[i];
    dvec3 radiance = glm::min(radiance_[i], dvec3(kMostHalf / input_.geometry.view.light_scale));
    if (!is_finite(radiance)) radiance = dvec3(0.0);
    const double distance = s.hit ? static_cast<double>(s.distance_m) : settings_.fog.sky_distance_m;
    radiance = in_fog(radiance, 1.0, distance);
    if (settings_.quads.empty()) return radiance;
    const double end = s.hit ? distance : std::numeric_limits<double>::infinity();
    find_layers(settings_.quads, dvec3(rays_[i].origin) + input_.tracer.origin(), dvec3(rays_[i].direction), end,
                layers_);
    for (auto layer = layers_.rbegin(); layer != layers_.rend(); ++layer)
      radiance = in_fog(layer->radiance, layer->alpha, layer->distance_m) + (1.0 - layer->alpha) * radiance;
    return radiance;
  }

  [[nodiscard]] dvec3 in_fog(const dvec3& radiance, double alpha, double distance_m) const {
    const double transmitted = std::exp(-settings_.fog.density * distance_m);
    return transmitted * radiance + (1.0 - transmitted) * alpha * settings_.fog.color;
  }

  struct Candidate {
    const TwinLight* light = nullptr;
    dvec3 reflected = dvec3(0.0);
    double up_to = 0.0;  ///< sum of brightness up to this one
  };

  const RadianceInput& input_;
  const ReflectionTracing& settings_;
  const TwinLights& lights_;
  const SceneAssets& assets_;
  const SceneEnvironment& sky_;
  const dvec3 tracer_from_camera_;
  std::vector<SurfaceRay> rays_;
  std::vector<double> weights_;
  std::vector<TracedSurface> surfaces_;
  std::vector<dvec3> radiance_;
  std::vector<Candidate> candidates_;
  std::vector<ShadowRay> shadow_rays_, batch_;
  std::vector<Carried> carried_;
  std::vector<std::size_t> batch_from_;
  std::vector<std::uint8_t> blocked_;
  std::vector<QuadLayer> layers_;
};

std::uint64_t content_hash(const TracedReflections& traced) {
  Hasher hasher;
  hasher.value(traced.width).value(traced.height).value(traced.samples);
  return hasher.bytes(std::as_bytes(std::span(traced.radiance))).digest();
}

}  // namespace

TracedReflections trace_radiance(const RadianceInput& input) {
  const GeometryPicture& geometry = input.geometry;
  GLOAM_ASSERT(geometry.depth.size() == std::size_t{geometry.view.width} * geometry.view.height, "a depth a pixel");
  GLOAM_ASSERT(input.settings.rays > 0 && input.settings.light_samples > 0, "at least one sample");
  TracedReflections traced;
  traced.width = geometry.view.width;
  traced.height = geometry.view.height;
  traced.samples = input.settings.rays;
  traced.radiance.assign(4 * traced.pixels(), 0.0f);
  const TwinLights lights = gather_lights(input.world, input.tracer);
  std::mutex mutex;
  std::size_t done = 0;
  input.executor.parallel_for(traced.height, 1, [&](JobRange rows) {
    PixelTracer tracer(input, lights);
    for (auto y = static_cast<std::uint32_t>(rows.begin); y < rows.end; ++y) {
      for (std::uint32_t x = 0; x < traced.width; ++x) {
        const PixelSurface surface = pixel_surface(geometry, x, y);
        if (!surface.exists || !(surface.reflectivity > 0.0)) continue;
        const std::uint32_t pixel = y * traced.width + x;
        const vec3 radiance(tracer.trace(surface, pixel));
        float* const texel = &traced.radiance[4 * std::size_t{pixel}];
        for (int c = 0; c < 3; ++c) texel[c] = radiance[c];
        texel[3] = 1.0f;
      }
      if (!input.progress) continue;
      const std::lock_guard lock(mutex);
      input.progress(++done, traced.height);
    }
  });
  traced.version = content_hash(traced);
  return traced;
}

}  // namespace gloam
