// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/math/packing.h"
#include "engine/math/types.h"
#include "engine/render/outputs.h"
#include "engine/render/view.h"

namespace gloam {

/// Camera-relative position of the surface at `depth` (reversed Z, > 0) under the centre of a pixel, in double.
[[nodiscard]] dvec3 surface_position(const RenderView& view, std::uint32_t x, std::uint32_t y, float depth);

/// Several times the error of a depth buffer, as a share of the distance from the camera. It grows with the grid to
/// which a device moves corners (gpu::DeviceInfo::subpixel_bits): SwiftShader, with 4 bits, errs by up to 7e-4 in
/// triangles that are not split (engine/render/packing/refined_triangles.h).
[[nodiscard]] constexpr double depth_error_share(std::uint32_t subpixel_bits) {
  return 4e-5 * static_cast<double>(1u << (8u - std::clamp(subpixel_bits, 4u, 8u)));
}

/// The geometry buffer of a view's last frame on the CPU; texels row by row from the top.
struct GeometryPicture {
  RenderView view;
  std::vector<float> depth;  ///< reversed Z, 0 = sky
  std::vector<std::uint32_t> base_color;
  std::vector<uvec2> normals;
  std::vector<std::uint32_t> material;
  std::vector<uvec2> emissive;                ///< half floats; empty if no material of the world lets light through
  std::vector<uvec2> smooth_surfaces;         ///< empty if the frame has no GeometryOutputs::smooth_surfaces
  double error_share = depth_error_share(8);  ///< depth_error_share() of the device

  [[nodiscard]] bool is_sky(std::size_t at) const { return depth[at] <= 0.0f; }
  [[nodiscard]] GeometryTexel texel(std::size_t at) const {
    return decode_geometry(base_color[at], normals[at], material[at]);
  }
  /// Extinction length of the surface's material in metres; 0: no light passes.
  [[nodiscard]] float extinction_m(std::size_t at) const {
    const float root = emissive.empty() ? 0.0f : half_to_float(static_cast<std::uint16_t>(emissive[at].y >> 16));
    return root * root;
  }
  [[nodiscard]] SmoothSurface smooth_surface(std::size_t at) const {
    return smooth_surfaces.empty() ? SmoothSurface{} : decode_smooth_surface(smooth_surfaces[at]);
  }
  /// Camera-relative position of the surface under the centre of a pixel, in double. The pixel must not be sky.
  [[nodiscard]] dvec3 position(std::uint32_t x, std::uint32_t y) const {
    return surface_position(view, x, y, depth[std::size_t{y} * view.width + x]);
  }
};

}  // namespace gloam
