// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/reflections/bake/cube.h"

namespace gloam {

inline constexpr std::uint32_t kLargestProbeSide = 1024;  ///< texels of an octahedral map
inline constexpr std::uint32_t kLastProbeSide = 8;        ///< texels of its last mip

/// Side of the octahedral map of a probe, in texels: for a cube of `resolution` texels a face.
[[nodiscard]] std::uint32_t probe_map_side(std::uint32_t resolution);
/// Pixels of the faces that are drawn for it, a power of two.
[[nodiscard]] std::uint32_t probe_face_side(std::uint32_t resolution);
/// Mips of an octahedral map with this side, a power of two of at least kLastProbeSide.
[[nodiscard]] std::uint32_t probe_map_mips(std::uint32_t side);

/// World direction, of unit length, that the point (u, v) of a probe's map shows; both 0…1, v from the top.
[[nodiscard]] vec3 probe_map_direction(vec2 uv);

/// A direction around the normal (0, 0, 1) from which light is taken.
struct LobeSample {
  vec3 direction = vec3(0.0f);
  float weight = 0.0f;  ///< the weights of a lobe sum to 1
  float lod = 0.0f;     ///< of the cube
};
/// Samples of a mip of a probe's map. mips: of the map. face_side: of the cube. Mip 0: one sample, the normal itself.
[[nodiscard]] std::vector<LobeSample> lobe_samples_of_mip(std::uint32_t mip, std::uint32_t mips,
                                                          std::uint32_t face_side);

/// Appends the octahedral map of a cube with all its mips, as ReflectionCaptures::probes stores them. Mip m is
/// prefiltered for roughness r = m / (mips − 1): the mean radiance under GGX with α = r², seen along the normal (Karis,
/// "Real Shading in Unreal Engine 4", 2013, with samples from the mip whose texels have the solid angle of the sample).
/// The result does not depend on the number of threads.
void append_probe_map(const CapturedCube& cube, std::uint32_t side, JobExecutor& executor,
                      std::vector<std::uint16_t>& halves);

}  // namespace gloam
