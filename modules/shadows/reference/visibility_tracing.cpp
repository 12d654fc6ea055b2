// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/visibility_tracing.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>

#include "engine/core/assert.h"
#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/math/finite.h"
#include "engine/scene/components.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"
#include "modules/shadows/reference.h"
#include "modules/shadows/reference/emitter_samples.h"
#include "modules/shadows/views/bulbs.h"

namespace gloam {
namespace {

/// A light as an emitter of rays. Positions are camera-relative.
struct Emitter {
  Entity entity;
  LightKind kind = LightKind::point;
  dvec3 position = dvec3(0.0);
  dvec3 axis = dvec3(0.0, 0.0, -1.0);  ///< unit, the way it shines
  double range_m = 0.0;
  double cos_outer = -1.0;           ///< cosine of a spot's outer half angle
  double radius = 0.0;               ///< radius of the disc in metres; directional: at distance 1
  double bulb_radius_m = 0.0;        ///< see is_bulb()
  std::vector<std::uint32_t> bulbs;  ///< numbers of the meshes that do not block it

  [[nodiscard]] bool reaches(const dvec3& point) const {
    if (kind == LightKind::directional) return true;
    const dvec3 away = point - position;
    const double distance = glm::length(away);
    if (!(distance < range_m)) return false;
    return kind == LightKind::point || glm::dot(away, axis) > cos_outer * distance;
  }
};

bool shines(const Light& light) {
  const vec3 strength = light.color * light.intensity;
  return is_finite(dvec3(strength)) && light.intensity > 0.0f &&
         std::max({strength.x, strength.y, strength.z}) > 0.0f && std::isfinite(light.range_m);
}

Emitter make_emitter(Entity entity, const Light& light, const dmat4& world_from_node, const dvec3& camera) {
  Emitter emitter;
  emitter.entity = entity;
  emitter.kind = light.kind;
  emitter.position = dvec3(world_from_node[3]) - camera;
  const dvec3 node_z(world_from_node[2]);
  if (glm::length(node_z) > 0.0) emitter.axis = -glm::normalize(node_z);
  emitter.range_m = static_cast<double>(effective_range(light));
  emitter.bulb_radius_m = bulb_radius(light);
  emitter.cos_outer = std::cos(std::min(static_cast<double>(light.outer_angle), 1.57079632679489661923));
  emitter.radius = light.kind == LightKind::directional ? std::tan(0.5 * static_cast<double>(light.apparent_angle))
                                                        : 0.5 * static_cast<double>(light.width_m);
  if (!(emitter.radius > 0.0) || !std::isfinite(emitter.radius)) emitter.radius = 0.0;
  return emitter;
}

/// All casting lights, ordered by entity index.
std::vector<Emitter> casting_lights(const World& world, const dvec3& camera) {
  std::vector<Emitter> emitters;
  world.view<const Light, const WorldTransform, Maybe<const ShadowCaster>>().each(
      [&](Entity entity, const Light& light, const WorldTransform& transform, const ShadowCaster* caster) {
        if ((caster != nullptr && !caster->enabled) || !shines(light)) return;
        const Emitter emitter = make_emitter(entity, light, transform.matrix, camera);
        if (is_finite(emitter.position) && is_finite(emitter.axis)) emitters.push_back(emitter);
      });
  std::sort(emitters.begin(), emitters.end(),
            [](const Emitter& a, const Emitter& b) { return a.entity.index < b.entity.index; });
  return emitters;
}

/// The meshes that are bulbs of the light; see is_bulb().
std::vector<std::uint32_t> bulbs_of(const Emitter& emitter, const dvec3& camera, const SceneTracer& tracer) {
  std::vector<std::uint32_t> bulbs;
  if (emitter.kind == LightKind::directional) return bulbs;
  for (const EmissiveMesh& mesh : tracer.emissive_meshes())
    if (is_bulb(emitter.position + camera, emitter.bulb_radius_m, mesh.min, mesh.max, mesh.half_diagonal_m))
      bulbs.push_back(mesh.mesh);
  return bulbs;
}

/// The surface under a pixel's centre, camera-relative.
struct SurfacePoint {
  dvec3 position = dvec3(0.0);
  dvec3 normal = dvec3(0.0);  ///< unit
  bool subsurface = false;
  dvec3 shading_normal = dvec3(0.0);
  double extinction_m = 0.0;  ///< 0: no light passes
};

/// The point of the smooth surface from which rays begin; the drawn surface's if there is none.
SurfacePoint on_smooth_surface(const SurfacePoint& drawn, const SmoothSurface& surface) {
  if (!surface.exists || drawn.subsurface) return drawn;
  return {drawn.position + dvec3(surface.offset), dvec3(surface.normal), false, drawn.shading_normal, 0.0};
}

/// Two unit vectors orthogonal to each other and to the unit vector d.
void span_disc(const dvec3& d, dvec3& u, dvec3& v) {
  const dvec3 helper = std::abs(d.x) < 0.6 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
  u = glm::normalize(glm::cross(helper, d));
  v = glm::cross(d, u);
}

/// Traces rays for one job.
class RowTracer {
 public:
  RowTracer(const VisibilityInput& input, const EmitterSamples& wide, const EmitterSamples& single)
      : input_(input),
        wide_(wide),
        single_(single),
        camera_from_tracer_(input.geometry.view.position - input.tracer.origin()) {}

  [[nodiscard]] static SurfacePoint point_at(const GeometryPicture& geometry, std::uint32_t x, std::uint32_t y) {
    const std::size_t at = std::size_t{y} * geometry.view.width + x;
    const GeometryTexel texel = geometry.texel(at);
    return {geometry.position(x, y), dvec3(texel.face_normal), texel.subsurface, dvec3(texel.normal),
            static_cast<double>(geometry.extinction_m(at))};
  }

  /// Number of the emitter's samples that the point sees: of all, and of the first half; `of` is the total. Where light
  /// from behind passes, each sample counts by its transmittance.
  struct Seen {
    double all = 0.0;
    double first_half = 0.0;
    std::uint32_t of = 1;
  };
  [[nodiscard]] Seen trace(const SurfacePoint& point, const Emitter& emitter, std::uint32_t pixel) {
    const EmitterSamples& samples = emitter.radius > 0.0 ? wide_ : single_;
    const std::uint32_t count = samples.count();
    if (!aim(point, emitter, samples.pattern(pixel, emitter.entity.index)))
      return {static_cast<double>(count), static_cast<double>(count / 2), count};
    if (passes_from_behind(point, emitter)) return trace_through(point, emitter);
    blocked_.resize(rays_.size());
    input_.tracer.occluded(rays_, blocked_, emitter.bulbs);
    block_below(point);
    Seen seen{.of = count};
    for (std::uint32_t i = 0; i < count; ++i) {
      seen.all += 1 - blocked_[i];
      if (i < count / 2) seen.first_half += 1 - blocked_[i];
    }
    return seen;
  }

 private:
  [[nodiscard]] static bool passes_from_behind(const SurfacePoint& point, const Emitter& emitter) {
    const dvec3 to_light = emitter.kind == LightKind::directional ? -emitter.axis : emitter.position - point.position;
    return point.extinction_m > 0.0 && glm::dot(point.shading_normal, to_light) < 0.0;
  }

  /// The rays through the receiver's body, weakened by their way inside it.
  [[nodiscard]] Seen trace_through(const SurfacePoint& point, const Emitter& emitter) {
    paths_.resize(rays_.size());
    input_.tracer.through_body(rays_, paths_, emitter.bulbs);
    Seen seen{.of = static_cast<std::uint32_t>(rays_.size())};
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      if (paths_[i].blocked) continue;
      const double share = std::exp(-static_cast<double>(paths_[i].inside_m) / point.extinction_m);
      seen.all += share;
      if (i < rays_.size() / 2) seen.first_half += share;
    }
    return seen;
  }

  /// The receiver's own surface hides what lies behind it.
  void block_below(const SurfacePoint& point) {
    if (point.subsurface) return;
    const vec3 out(point.normal);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const vec3 d = rays_[i].direction;
      if (glm::dot(d, out) < static_cast<float>(-kBehindSine) * glm::length(d)) blocked_[i] = 1;
    }
  }

  /// Sets up the rays. Returns false when the point is at the light, so that nothing can block.
  bool aim(const SurfacePoint& point, const Emitter& emitter, const EmitterSamples::Pattern& pattern) {
    const bool local = emitter.kind != LightKind::directional;
    const dvec3 to_light = local ? emitter.position - point.position : -emitter.axis;
    const double side = point.subsurface && glm::dot(point.normal, to_light) < 0.0 ? -1.0 : 1.0;
    const double lift = input_.geometry.error_share * glm::length(point.position) +
                        kRayRounding * glm::length(point.position + camera_from_tracer_);
    const dvec3 start = point.position + point.normal * side * lift;
    const dvec3 middle = local ? emitter.position - start : to_light;
    const double distance = glm::length(middle);
    if (local && !(distance > lift)) return false;
    dvec3 u, v;
    span_disc(middle / distance, u, v);
    const vec3 disc_u(u * emitter.radius), disc_v(v * emitter.radius), center(middle);
    const float end =
        local ? ray_end(distance, glm::length(start + camera_from_tracer_)) : std::numeric_limits<float>::infinity();
    const vec3 origin(start + camera_from_tracer_);
    rays_.resize(pattern.points.size());
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const vec2 at = emitter.radius > 0.0 ? pattern.point(i) : vec2(0.0f);
      rays_[i] = {.origin = origin, .direction = center + at.x * disc_u + at.y * disc_v, .from = 0.0f, .to = end};
    }
    return true;
  }

  const VisibilityInput& input_;
  const EmitterSamples& wide_;
  const EmitterSamples& single_;
  const dvec3 camera_from_tracer_;
  std::vector<ShadowRay> rays_;
  std::vector<std::uint8_t> blocked_;
  std::vector<BodyPath> paths_;
};

/// The casting lights that reach any pixel.
std::vector<Emitter> reaching_lights(const VisibilityInput& input) {
  const GeometryPicture& geometry = input.geometry;
  const std::vector<Emitter> all = casting_lights(input.world, geometry.view.position);
  std::vector<std::uint8_t> reached(all.size(), 0);
  input.executor.parallel_for(geometry.view.height, 8, [&](JobRange rows) {
    std::vector<std::uint8_t> found(all.size(), 0);
    for (auto y = static_cast<std::uint32_t>(rows.begin); y < rows.end; ++y) {
      for (std::uint32_t x = 0; x < geometry.view.width; ++x) {
        if (geometry.is_sky(std::size_t{y} * geometry.view.width + x)) continue;
        const dvec3 point = geometry.position(x, y);
        for (std::size_t light = 0; light < all.size(); ++light)
          if (found[light] == 0 && all[light].reaches(point)) found[light] = 1;
      }
    }
    for (std::size_t light = 0; light < all.size(); ++light)
      if (found[light] != 0) std::atomic_ref(reached[light]).store(1, std::memory_order_relaxed);
  });
  std::vector<Emitter> kept;
  for (std::size_t light = 0; light < all.size(); ++light)
    if (reached[light] != 0) kept.push_back(all[light]);
  for (Emitter& emitter : kept) emitter.bulbs = bulbs_of(emitter, geometry.view.position, input.tracer);
  return kept;
}

/// Sums of integers, so that the order of summation does not matter.
struct NoiseSum {
  std::uint64_t change = 0;  ///< difference of both estimates, in units of 1 / (half · all samples)
  std::uint64_t pairs = 0;
};

/// Traces all lights at one row of pixels.
NoiseSum trace_row(std::uint32_t y, const GeometryPicture& geometry, std::span<const Emitter> emitters,
                   RowTracer& tracer, TracedVisibility& traced) {
  NoiseSum sum;
  for (std::uint32_t x = 0; x < traced.width; ++x) {
    const std::size_t pixel = std::size_t{y} * traced.width + x;
    if (geometry.is_sky(pixel)) continue;
    const SurfacePoint point = RowTracer::point_at(geometry, x, y);
    const SurfacePoint receiver = on_smooth_surface(point, geometry.smooth_surface(pixel));
    for (std::size_t light = 0; light < emitters.size(); ++light) {
      if (!emitters[light].reaches(point.position)) continue;
      const RowTracer::Seen seen = tracer.trace(receiver, emitters[light], static_cast<std::uint32_t>(pixel));
      const std::size_t at = light * traced.pixels() + pixel;
      // Rounded as integers are, so that whole numbers of samples give the same on every machine.
      traced.visibility[at] = static_cast<std::uint8_t>((seen.all * 255.0 + static_cast<double>(seen.of / 2)) /
                                                        static_cast<double>(seen.of));
      std::atomic_ref(traced.judged[at / 8])
          .fetch_or(static_cast<std::uint8_t>(1u << (at % 8)), std::memory_order_relaxed);
      ++sum.pairs;
      // Lights without width have one sample and no noise.
      const double half = seen.of / 2, all = seen.of;
      if (half > 0.0) sum.change += static_cast<std::uint64_t>(std::abs(seen.first_half * all - seen.all * half));
    }
  }
  return sum;
}

/// Reports progress in rows.
class RowCounter {
 public:
  RowCounter(const VisibilityInput& input) : input_(input) {}
  void add_one() {
    if (!input_.progress) return;
    const std::lock_guard lock(mutex_);
    input_.progress(++done_, input_.geometry.view.height);
  }

 private:
  const VisibilityInput& input_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

std::uint64_t content_hash(const TracedVisibility& traced) {
  Hasher hasher;
  hasher.value(traced.width).value(traced.height);
  for (const Entity light : traced.lights) hasher.value(light.index).value(light.generation);
  return hasher.bytes(std::as_bytes(std::span(traced.visibility)))
      .bytes(std::as_bytes(std::span(traced.judged)))
      .digest();
}

}  // namespace

TracedVisibility trace_visibility(const VisibilityInput& input) {
  const GeometryPicture& geometry = input.geometry;
  GLOAM_ASSERT(geometry.depth.size() == std::size_t{geometry.view.width} * geometry.view.height, "a depth a pixel");
  const std::vector<Emitter> emitters = reaching_lights(input);
  TracedVisibility traced;
  traced.width = geometry.view.width;
  traced.height = geometry.view.height;
  traced.samples = input.samples;
  for (const Emitter& emitter : emitters) traced.lights.push_back(emitter.entity);
  traced.visibility.assign(emitters.size() * traced.pixels(), 255);
  traced.judged.assign((traced.visibility.size() + 7) / 8, 0);

  const EmitterSamples wide(input.samples), single(1);
  std::vector<NoiseSum> sums(traced.height);
  RowCounter counter(input);
  input.executor.parallel_for(traced.height, 1, [&](JobRange rows) {
    RowTracer tracer(input, wide, single);
    for (std::size_t y = rows.begin; y < rows.end; ++y) {
      sums[y] = trace_row(static_cast<std::uint32_t>(y), geometry, emitters, tracer, traced);
      counter.add_one();
    }
  });
  NoiseSum total;
  for (const NoiseSum& sum : sums) {
    total.change += sum.change;
    total.pairs += sum.pairs;
  }
  const double unit = static_cast<double>(input.samples / 2) * input.samples;
  if (total.pairs > 0 && unit > 0.0)
    traced.noise = static_cast<double>(total.change) / (unit * static_cast<double>(total.pairs));
  traced.version = content_hash(traced);
  return traced;
}

std::string visibility_identity(const VisibilityInput& input) {
  const GeometryPicture& geometry = input.geometry;
  Hasher hasher;
  hasher.bytes_of(geometry.view.position).bytes_of(geometry.view.clip_from_relative);
  hasher.bytes(std::as_bytes(std::span(geometry.depth))).bytes(std::as_bytes(std::span(geometry.normals)));
  if (!geometry.smooth_surfaces.empty()) hasher.bytes(std::as_bytes(std::span(geometry.smooth_surfaces)));
  for (const std::uint32_t color : geometry.base_color)
    hasher.value(static_cast<std::uint8_t>(color >> 24));  // the alpha byte flags subsurface materials
  for (const uvec2& texel : geometry.emissive) hasher.value(texel.y >> 16);  // extinction lengths
  for (const Emitter& e : casting_lights(input.world, dvec3(0.0))) {
    hasher.value(e.entity.index).value(e.entity.generation).value(e.kind).bytes_of(e.position).bytes_of(e.axis);
    hasher.bytes_of(e.range_m).bytes_of(e.cos_outer).bytes_of(e.radius);
  }
  constexpr int kMethod = 4;  // increase when the same input gives other visibilities
  return "visibility " + std::to_string(kMethod) + " of triangles " + std::to_string(input.tracer.version()) +
         " frame and lights " + std::to_string(hasher.digest()) + " size " + std::to_string(geometry.view.width) + "x" +
         std::to_string(geometry.view.height) + " samples " + std::to_string(input.samples);
}

}  // namespace gloam
