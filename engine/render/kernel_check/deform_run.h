// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/kernel_check/kernel_lab.h"
#include "engine/render/reference/deform_twin.h"

namespace gloam {

/// What deform.comp writes; the last item of each is past the last vertex.
struct DeformedVertices {
  std::vector<vec3> positions;
  std::vector<PackedFrame> frames;
};

/// Runs the kernel once.
[[nodiscard]] Result<DeformedVertices> run_deform(const KernelLab& lab, const DeformInput& input);

/// Vertices within 3 m of the origin, at random, with joints and targets on request. The same seed gives the same
/// inputs.
class DeformInputs {
 public:
  explicit DeformInputs(std::uint32_t seed) : random_(seed) {}

  [[nodiscard]] DeformInput vertices(std::uint32_t count);
  /// Rotations of the joints differ by less than a right angle, so that no mix of them collapses.
  void add_skin(DeformInput& input, std::uint32_t joints, const dvec3& scale);
  void add_morphs(DeformInput& input, std::uint32_t targets, bool normals);

 private:
  [[nodiscard]] float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  [[nodiscard]] vec3 point(float reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  [[nodiscard]] vec3 direction() { return glm::normalize(point(1.0f) + vec3(0.0f, 1e-3f, 0.0f)); }

  std::mt19937 random_;
};

}  // namespace gloam
