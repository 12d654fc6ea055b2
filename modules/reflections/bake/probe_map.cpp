// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/probe_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>

#include "engine/math/low_discrepancy.h"
#include "engine/math/packing.h"
#include "modules/reflections/bake/picture.h"

namespace gloam {
namespace {

constexpr std::uint32_t kFewestSamples = 64;  // of mip 1, doubled from mip to mip: wider lobes have fewer texels
constexpr std::uint32_t kMostSamples = 512;

/// Samples of the GGX lobe around the mirror direction, for a viewer along the normal. face_side: of the cube. count:
/// samples to draw; those below the horizon are left out.
std::vector<LobeSample> lobe_samples(double roughness, std::uint32_t face_side, std::uint32_t count) {
  if (roughness <= 0.0) return {{vec3(0.0f, 0.0f, 1.0f), 1.0f, 0.0f}};
  const double alpha2 = std::pow(roughness, 4.0);
  const double texel = 4.0 * std::numbers::pi / (6.0 * face_side * face_side);  // steradians
  std::vector<LobeSample> samples;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) {
    // Hammersley points.
    const double u = (i + 0.5) / count;
    const double angle = 2.0 * std::numbers::pi * (reversed_bits(i) * 0x1p-32);
    const double cosine2 = (1.0 - u) / (1.0 + (alpha2 - 1.0) * u);  // of the half vector
    const double n_dot_l = 2.0 * cosine2 - 1.0;
    if (n_dot_l <= 0.0) continue;
    const double sine = std::sqrt(std::max(0.0, 1.0 - n_dot_l * n_dot_l));
    const double density = alpha2 / (std::numbers::pi * std::pow(cosine2 * (alpha2 - 1.0) + 1.0, 2.0)) / 4.0;
    const double solid_angle = 1.0 / (count * density);
    samples.push_back({vec3(dvec3(sine * std::cos(angle), sine * std::sin(angle), n_dot_l)),
                       static_cast<float>(n_dot_l),
                       static_cast<float>(std::max(0.0, 0.5 * std::log2(solid_angle / texel)))});
    sum += n_dot_l;
  }
  for (LobeSample& sample : samples) sample.weight = static_cast<float>(sample.weight / sum);
  return samples;
}

/// Light under the lobe around a direction.
vec3 lobe_light(const CapturedCube& cube, std::span<const LobeSample> samples, const vec3& normal) {
  const vec3 helper = std::abs(normal.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
  const vec3 x = glm::normalize(glm::cross(helper, normal)), y = glm::cross(normal, x);
  vec3 sum(0.0f);
  for (const LobeSample& s : samples)
    sum += s.weight * cube.sample(s.direction.x * x + s.direction.y * y + s.direction.z * normal, s.lod);
  return sum;
}

/// Mean light of the texel with its upper left corner at `corner`, without roughness.
vec3 texel_light(const CapturedCube& cube, const vec2& corner, float texel) {
  vec3 sum(0.0f);
  for (const vec2 at : {vec2(0.25f, 0.25f), vec2(0.75f, 0.25f), vec2(0.25f, 0.75f), vec2(0.75f, 0.75f)})
    sum += 0.25f * cube.sample(probe_map_direction(corner + texel * at), 0.0f);
  return sum;
}

}  // namespace

std::uint32_t probe_map_side(std::uint32_t resolution) {
  return std::clamp(std::bit_ceil(2 * resolution), kLastProbeSide, kLargestProbeSide);
}

std::uint32_t probe_face_side(std::uint32_t resolution) { return probe_map_side(resolution) / 2; }

std::uint32_t probe_map_mips(std::uint32_t side) {
  return static_cast<std::uint32_t>(std::bit_width(side) - std::bit_width(kLastProbeSide)) + 1;
}

vec3 probe_map_direction(vec2 uv) {
  const vec3 decoded = octahedral_decode(2.0f * uv - 1.0f);
  return {decoded.x, decoded.z, decoded.y};
}

std::vector<LobeSample> lobe_samples_of_mip(std::uint32_t mip, std::uint32_t mips, std::uint32_t face_side) {
  const double roughness = mips == 1 ? 0.0 : static_cast<double>(mip) / (mips - 1);
  return lobe_samples(roughness, face_side, std::min(kFewestSamples << mip >> 1, kMostSamples));
}

void append_probe_map(const CapturedCube& cube, std::uint32_t side, JobExecutor& executor,
                      std::vector<std::uint16_t>& halves) {
  const std::uint32_t mips = probe_map_mips(side);
  for (std::uint32_t mip = 0; mip < mips; ++mip) {
    const std::uint32_t size = side >> mip;
    const std::vector<LobeSample> samples = lobe_samples_of_mip(mip, mips, cube.side());
    const float texel = 1.0f / static_cast<float>(size);
    const std::size_t first = halves.size();
    halves.resize(first + std::size_t{4} * size * size);
    executor.parallel_for(std::size_t{size} * size, 256, [&](JobRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const vec2 corner = texel * vec2(static_cast<float>(i % size), static_cast<float>(i / size));
        const vec3 light = mip == 0 ? texel_light(cube, corner, texel)
                                    : lobe_light(cube, samples, probe_map_direction(corner + 0.5f * texel));
        const vec4 stored(storable(light), 1.0f);
        for (int channel = 0; channel < 4; ++channel)
          halves[first + 4 * i + static_cast<std::size_t>(channel)] = float_to_half(stored[channel]);
      }
    });
  }
}

}  // namespace gloam
