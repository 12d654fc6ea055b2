// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/packing/gpu_primitive.h"
#include "engine/render/packing/mesh_packing.h"
#include "engine/scene/assets.h"

namespace gloam {

/// A primitive as the GPU reads it. The ranges of `primitive` are not placed yet.
struct PackedPrimitive {
  GpuPrimitive primitive;
  std::vector<vec3> positions;
  std::vector<PackedFrame> frames;
  std::vector<PackedSurface> surfaces;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> simplified;  ///< indices of the simplified caster; empty if there is none
  std::vector<PackedInfluence> influences;
  std::vector<float> morph_offsets;
};

/// simplify: also makes simplified indices, if the primitive is rigid (simplified_casters.h).
[[nodiscard]] PackedPrimitive pack_primitive(const Primitive& source, bool simplify);
[[nodiscard]] std::vector<PackedPrimitive> pack_mesh(const Mesh& mesh, const std::vector<bool>& simplify);

}  // namespace gloam
