// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Geometry that the host has drawn itself: its images take the place of the geometry pass, so that gloam lights a scene
// that it never loaded.
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/gpu/types.h"

namespace gloam {

namespace gpu {
class Device;
}

/// How a depth image stores the distance along the view direction.
enum class HostDepth : std::uint8_t {
  reversed,  ///< near_m → 1, far_m → 0; cleared to 0
  standard,  ///< near_m → 0, far_m → 1; cleared to 1
  metres,    ///< the distance itself; 0, infinity and NaN are the sky
};

/// How an image stores normals of any length.
enum class HostNormals : std::uint8_t {
  vectors,     ///< rgb = xyz; unsigned formats: (xyz + 1) / 2
  octahedral,  ///< rg = the octahedron's square, −1…1; unsigned formats: 0…1. The pole is +z
};

/// A channel of an image.
enum class HostChannel : std::uint8_t { r, g, b, a, none };

/// The host's images and their encodings. All have the size of the view, one mip and one layer, and were made with
/// ImageUsage::sampled. Pixel (0, 0) is the upper left one. The projection is that of the view's camera, except for
/// near and far distance.
struct HostGeometryDesc {
  /// d32_float, r32_float, r16_float or r16_unorm.
  gpu::ImageHandle depth;
  HostDepth depth_kind = HostDepth::reversed;
  float near_m = 0.1f;  ///< of the host's projection, > 0; not read for HostDepth::metres
  float far_m = 0.0f;   ///< > near_m; 0: infinitely far (not for orthographic cameras)

  /// Shading normals: rgba8_unorm, rgb10a2_unorm, rgba16_float, rgba32_float; octahedral also rg16_unorm, rg16_snorm,
  /// rg16_float, rg32_float.
  gpu::ImageHandle normals;
  HostNormals normals_kind = HostNormals::vectors;
  bool view_space_normals = false;  ///< x right, y up, z towards the viewer; false: world axes
  /// Normals of the triangles, stored as `normals` (shadow bias needs them). Null: computed from the depth of
  /// neighbouring pixels.
  gpu::ImageHandle face_normals;

  /// rgba8, bgra8 (UNORM or sRGB), rgb10a2_unorm, rg11b10_float, rgba16_float or rgba32_float.
  gpu::ImageHandle base_color;
  bool srgb_base_color = false;  ///< a UNORM image holds sRGB-encoded colours; sRGB formats are decoded in any case

  /// rgba8_unorm, rgba16_float, …: roughness (perceptual, as glTF), metallic and occlusion, each 0…1.
  gpu::ImageHandle material;
  HostChannel roughness = HostChannel::g;
  HostChannel metallic = HostChannel::b;   ///< none: 0
  HostChannel occlusion = HostChannel::r;  ///< none: 1

  /// Emitted light in cd/m² before exposure, linear. Null: none.
  gpu::ImageHandle emissive;

  /// The access that all images are left ready for by the host, and by gloam after the frame (host_image_layout gives
  /// the layout).
  gpu::Access before = gpu::Access::fragment_read;
  gpu::Access after = gpu::Access::fragment_read;
  /// Whether gloam also draws the world's own meshes, in front of the host's surfaces or behind them. false: they only
  /// cast shadows.
  bool draws_meshes = true;
};

/// Checked images of the host, for ViewRequest::geometry. The images must live until all frames that use them have
/// finished on the GPU. Captures and mirrored views do not see the host's geometry; its surfaces move as if they were
/// at rest (GeometryOutputs::motion).
class HostGeometry {
 public:
  /// Usage error that names the image if one is missing, has another size than `depth`, or a format or usage that is
  /// not allowed; also for wrong distances.
  [[nodiscard]] static Result<HostGeometry> create(const gpu::Device& device, const HostGeometryDesc& desc);

  [[nodiscard]] const HostGeometryDesc& desc() const { return desc_; }
  [[nodiscard]] std::uint32_t width() const { return width_; }
  [[nodiscard]] std::uint32_t height() const { return height_; }

 private:
  HostGeometry() = default;
  HostGeometryDesc desc_;
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
};

}  // namespace gloam
