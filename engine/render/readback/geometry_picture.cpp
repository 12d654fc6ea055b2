// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/readback/geometry_picture.h"

namespace gloam {

dvec3 surface_position(const RenderView& view, std::uint32_t x, std::uint32_t y, float depth) {
  // Intersects three planes, one per NDC coordinate of the pixel: dot(row, (p, 1)) = ndc · dot(row_w, (p, 1)). The
  // matrix is the one that the GPU has drawn with.
  const dmat4 rows = glm::transpose(dmat4(view.clip_from_relative));
  const dvec3 ndc(2.0 * (x + 0.5) / view.width - 1.0, 1.0 - 2.0 * (y + 0.5) / view.height, static_cast<double>(depth));
  const dvec4 a = rows[0] - ndc.x * rows[3];
  const dvec4 b = rows[1] - ndc.y * rows[3];
  const dvec4 c = rows[2] - ndc.z * rows[3];
  const dvec3 bc = glm::cross(dvec3(b), dvec3(c)), ca = glm::cross(dvec3(c), dvec3(a)),
              ab = glm::cross(dvec3(a), dvec3(b));
  return -(a.w * bc + b.w * ca + c.w * ab) / glm::dot(dvec3(a), bc);
}

}  // namespace gloam
