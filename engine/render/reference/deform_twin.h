// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// CPU twin of deform.comp in double precision: morphing, then skinning. Reads the packed vertices, as the kernel does;
// normals use cofactors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/math/types.h"
#include "engine/render/packing/mesh_packing.h"
#include "engine/scene/assets.h"
#include "shaders/render/deform_shared.h"

namespace gloam {

/// Bit of PackedFrame::tangent: the tangent is left-handed.
inline constexpr std::uint32_t kHandednessBit = 0x10000u;

/// Input of the kernel.
struct DeformInput {
  Primitive primitive;
  std::vector<mat4> joints;    ///< used from constants.first_joint
  std::vector<float> weights;  ///< used from constants.first_weight
  shaders::DeformConstants constants{};
};

/// A deformed vertex.
struct DeformedVertex {
  dvec3 position = dvec3(0.0);
  dvec3 normal = dvec3(0.0);   ///< unit; zero: has no direction
  dvec3 tangent = dvec3(0.0);  ///< unit; zero: has no direction
  bool left_handed = false;
};

class DeformTwin {
 public:
  explicit DeformTwin(const DeformInput& input)
      : input_(input), frames_(pack_frames(input.primitive)), influences_(pack_influences(input.primitive)) {}
  [[nodiscard]] DeformedVertex move(std::size_t vertex) const;

 private:
  void skin(std::size_t vertex, DeformedVertex& moved) const;

  const DeformInput& input_;
  std::vector<PackedFrame> frames_;
  std::vector<PackedInfluence> influences_;
};

/// The direction of an octahedral code of two snorm16, in double precision.
[[nodiscard]] dvec3 decoded_direction(std::uint32_t packed);
[[nodiscard]] double degrees_between(const dvec3& a, const dvec3& b);

}  // namespace gloam
