// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/bake/texels.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/math/low_discrepancy.h"
#include "engine/math/packing.h"
#include "modules/particles/bake/grid.h"

namespace gloam {
namespace {

constexpr double kMostFlux = 65504.0;  // of half floats
constexpr int kLeastScaleLog2 = -100;  // even brighter light is clamped: floats divide by the scale

double strength(const dvec3& lux) { return std::max({lux.x, lux.y, lux.z}); }

/// Points of a texel's cell and of emitters, in [0, 1). Different texels and lights have different ones.
struct RaySamples {
  std::uint32_t scramble[5];

  RaySamples(std::size_t texel, std::uint32_t light) {
    std::uint32_t seed = permuted(static_cast<std::uint32_t>(texel) * 0x9e3779b9u ^ permuted(light + 1));
    for (std::uint32_t& s : scramble) s = seed = permuted(seed + 0x85ebca6bu);
  }
  [[nodiscard]] dvec3 in_cell(std::uint32_t i) const {
    // A Sobol' pair, and the golden ratio for the third axis.
    return {unit_fraction(reversed_bits(i) ^ scramble[0]), unit_fraction(second_sobol(i) ^ scramble[1]),
            unit_fraction(i * 0x9e3779b9u + scramble[2])};
  }
  [[nodiscard]] glm::dvec2 on_emitter(std::uint32_t i) const {
    const std::uint32_t turned = i * 5u + 3u;  // another order than in_cell()
    return {unit_fraction(reversed_bits(turned) ^ scramble[3]), unit_fraction(second_sobol(turned) ^ scramble[4])};
  }
};

class TexelBaker {
 public:
  TexelBaker(const TexelInput& input, const ParticleLightMap& map)
      : input_(input), tracer_(input.tracer), lights_(input.lights), map_(map) {}

  [[nodiscard]] Flux flux(std::size_t texel) {
    arriving_.clear();
    double all = 0.0;
    const dvec3 middle = point(texel, dvec3(0.5));
    for (const std::uint32_t i : input_.chosen.flux) {
      dvec3 to_light;
      const double lux = strength(illuminance_of(lights_.lights[i], middle, to_light));
      if (lux > 0.0) arriving_.push_back({i, lux});
      all += lux;
    }
    Flux sum;
    for (const Arriving& one : arriving_) {
      const double share = one.lux / all;
      const double wanted = std::ceil(share * input_.options.rays_per_texel);
      const auto most = static_cast<double>(input_.options.rays_per_light);
      const auto rays = static_cast<std::uint32_t>(std::max(std::min(wanted, most), 1.0));
      add(sum, texel, one.light, rays);
    }
    return sum;
  }

  /// Share of the rays that reach the light.
  [[nodiscard]] double visibility(std::size_t texel, std::uint32_t light) {
    const std::uint32_t rays = std::max(input_.options.visibility_rays, 1u);
    trace(texel, light, rays);
    double seen = 0.0;
    for (std::uint32_t i = 0; i < rays; ++i) seen += blocked_[i] == 0 ? 1.0 : 0.0;
    return seen / rays;
  }

 private:
  struct Arriving {
    std::uint32_t light;
    double lux;
  };

  [[nodiscard]] dvec3 point(std::size_t texel, const dvec3& in_cell) const {
    const uvec3 size = map_.size;
    const dvec3 corner(static_cast<double>(texel % size.x), static_cast<double>(texel / size.x % size.y),
                       static_cast<double>(texel / size.x / size.y));
    return grid_position(map_, corner + in_cell) - tracer_.origin();
  }

  /// Sets points_ and blocked_ of `count` rays to the light.
  void trace(std::size_t texel, std::uint32_t index, std::uint32_t count) {
    const TwinLight& light = lights_.lights[index];
    const RaySamples samples(texel, light.entity.index);
    points_.resize(count);
    blocked_.assign(count, 0);
    rays_.clear();
    numbers_.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
      points_[i] = point(texel, samples.in_cell(i));
      const glm::dvec2 at = samples.on_emitter(i);
      ShadowRay ray;
      if (!light.casts || !aim_at_emitter(light, points_[i], at.x, at.y, ray)) continue;
      rays_.push_back(ray);
      numbers_.push_back(i);
    }
    hits_.resize(rays_.size());
    tracer_.occluded(rays_, hits_, lights_.bulbs[light.bulbs]);
    for (std::size_t r = 0; r < rays_.size(); ++r) blocked_[numbers_[r]] = hits_[r];
  }

  void add(Flux& sum, std::size_t texel, std::uint32_t index, std::uint32_t count) {
    trace(texel, index, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (blocked_[i] != 0) continue;
      dvec3 to_light(0.0);
      const dvec3 lux = illuminance_of(lights_.lights[index], points_[i], to_light) / static_cast<double>(count);
      sum.fluence += lux;
      for (int c = 0; c < 3; ++c) sum.along[c] += lux[c] * to_light;
    }
  }

  const TexelInput& input_;
  const SceneTracer& tracer_;
  const TwinLights& lights_;
  const ParticleLightMap& map_;
  std::vector<Arriving> arriving_;
  std::vector<dvec3> points_;
  std::vector<ShadowRay> rays_;
  std::vector<std::uint32_t> numbers_;  ///< of the points of rays_
  std::vector<std::uint8_t> hits_, blocked_;
};

BakedFlux packed(const dvec3& along, double fluence, double scale) {
  const double factor = fluence * scale > kMostFlux ? kMostFlux / fluence : scale;
  const dvec3 a = along * factor;
  const auto half = [](double v) { return float_to_half(static_cast<float>(v)); };
  return {half(a.x), half(a.y), half(a.z), half(fluence * factor)};
}

}  // namespace

Flux ambient_flux(const SceneEnvironment& sky) {
  const dvec3 above = 0.5 * (dvec3(sky.sky_horizon) + dvec3(sky.sky_zenith)), ground(sky.sky_ground);
  constexpr double kTau = 6.28318530717958647693;
  Flux flux;
  flux.fluence = kTau * (above + ground);
  for (int c = 0; c < 3; ++c) flux.along[c] = dvec3(0.0, kTau * (above[c] - ground[c]), 0.0);
  return flux;
}

void bake_texels(const TexelInput& input, std::size_t begin, std::size_t end, ParticleLightMap& map,
                 std::span<Flux> fluxes) {
  const std::vector<std::uint32_t>& dynamic = input.chosen.visibility;
  TexelBaker baker(input, map);
  for (std::size_t texel = begin; texel < end; ++texel) {
    Flux& flux = fluxes[texel] = baker.flux(texel);
    flux.fluence += input.ambient.fluence;
    for (int c = 0; c < 3; ++c) flux.along[c] += input.ambient.along[c];
    for (std::size_t i = 0; i < dynamic.size(); ++i)
      map.visibility[texel][i] = static_cast<std::uint8_t>(std::lround(255.0 * baker.visibility(texel, dynamic[i])));
  }
}

void store_flux(std::span<const Flux> fluxes, ParticleLightMap& map) {
  std::vector<double> strengths;
  for (const Flux& flux : fluxes) strengths.push_back(strength(flux.fluence));
  std::ranges::sort(strengths);
  const double most = strengths.empty() ? 0.0 : strengths.back();
  const double middle = strengths.empty() ? 0.0 : strengths[strengths.size() / 2];
  int scale_log2 = 0;
  while (scale_log2 > kLeastScaleLog2 && std::ldexp(most, scale_log2) > kMostFlux &&
         std::ldexp(middle, scale_log2) >= 2.0)
    --scale_log2;
  map.light_scale = std::ldexp(1.0f, scale_log2);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = static_cast<int>(c);
    map.flux[c].clear();
    map.flux[c].reserve(fluxes.size());
    for (const Flux& flux : fluxes)
      map.flux[c].push_back(packed(flux.along[channel], flux.fluence[channel], static_cast<double>(map.light_scale)));
  }
}

}  // namespace gloam
