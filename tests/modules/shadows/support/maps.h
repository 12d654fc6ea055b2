// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/math/types.h"
#include "modules/shadows/maps/work_groups.h"
#include "shaders/shadows/filter/probe_shared.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam::test {

/// Where a ray from `origin` along `direction` (any length) meets the scene first, in lengths of `direction`; not
/// positive: nowhere.
using RayScene = std::function<double(const dvec3& origin, const dvec3& direction)>;

/// z of the nearest of several scenes.
[[nodiscard]] RayScene nearest_of(std::vector<RayScene> scenes);
/// Plane through `point`, where inside(point on it) holds.
[[nodiscard]] RayScene plane(dvec3 point, dvec3 normal, std::function<bool(const dvec3&)> inside = nullptr);

/// A face of a local light or a cascade, for drawing it by rays.
struct FacePose {
  dvec3 origin = dvec3(0.0);
  dvec3 right = dvec3(1.0, 0.0, 0.0);
  dvec3 up = dvec3(0.0, 1.0, 0.0);
  dvec3 forward = dvec3(0.0, 0.0, -1.0);
  double tan_half = 1.0;       ///< 0: orthographic
  double near_m = 0.05;        ///< orthographic: 0
  double half_extent_m = 0.0;  ///< orthographic
  double depth_m = 0.0;        ///< orthographic
};

/// A cube's axes in the world.
[[nodiscard]] glm::dmat3 cube_axes();
/// One of a cube's six faces, as shadows_shared.h says.
[[nodiscard]] FacePose cube_face(int face, dvec3 origin, double tan_half);

/// Reversed depth of a face, row by row: what a ray through each texel's centre meets.
[[nodiscard]] std::vector<float> draw_face(const FacePose& pose, std::uint32_t size, const RayScene& scene);

/// How a ShadowMaps is looked at.
struct ProbeSettings {
  std::uint32_t filter = 3;
  std::uint32_t kernel = 8;
  std::uint32_t mips = 1;
  std::uint32_t receiver_plane = 1;
  std::uint32_t bias = 1;
  std::uint32_t shape = 0;
  std::uint32_t levels = 0;
  std::uint32_t full_penumbra = 0;
  std::uint32_t coverage = 0;  ///< faces were added with GLOAM_SHADOW_MIPS_COVERAGE
  bool standard = false;       ///< GLOAM_SHADOWS_STANDARD, which knows filter 3 and kernel 8 only
  [[nodiscard]] std::vector<gpu::SpecConstant> constants() const;
};

/// A shadow atlas on the device: faces go in through shadow_mips.comp, visibilities come out through shadow_probe.comp.
/// Any error is a failure of the test.
class ShadowMaps {
 public:
  ShadowMaps(gpu::Device& device, std::uint32_t atlas_size, gpu::Format format = gpu::Format::r32_float);
  ~ShadowMaps();
  ShadowMaps(const ShadowMaps&) = delete;
  ShadowMaps& operator=(const ShadowMaps&) = delete;

  void add_face(const std::vector<float>& depths, uvec2 origin, std::uint32_t size, bool orthographic = false,
                std::uint32_t mip_operator = GLOAM_SHADOW_MIPS_NEAREST, float gap = 0.0f);
  /// Copies mip 0 of a face to another square (shadow_overlay_copy.comp) and makes the rest there
  /// (shadow_mips_in_place.comp).
  void copy_face(uvec2 origin, uvec2 copy, std::uint32_t size, bool orthographic = false,
                 std::uint32_t mip_operator = GLOAM_SHADOW_MIPS_NEAREST, float gap = 0.0f);
  /// Overwrites texels of the atlas image, mips included; the pyramid stays.
  void write_atlas(const std::vector<float>& texels);
  [[nodiscard]] std::vector<float> atlas() const;
  [[nodiscard]] std::vector<vec2> pyramid() const;  ///< farthest and nearest
  [[nodiscard]] std::uint32_t atlas_size() const { return size_; }
  /// Ready for compute_read.
  [[nodiscard]] gpu::ImageHandle atlas_image() const { return atlas_; }
  [[nodiscard]] gpu::ImageHandle pyramid_image() const { return pyramid_; }
  /// Corner of mip m in the atlas, or of level m in the pyramid when `size` is a quarter of the atlas'.
  [[nodiscard]] static uvec2 mip_corner(std::uint32_t size, std::uint32_t mip);

  [[nodiscard]] std::vector<shaders::ShadowProbeResult> probe(std::span<const shaders::ShadowProbe> probes,
                                                              const std::vector<shaders::ShadowRow>& rows,
                                                              const shaders::ShadowBlock& block,
                                                              const ProbeSettings& settings = {});

 private:
  gpu::ImageHandle image(gpu::Format format, uvec2 size, gpu::ImageUsage usage, gpu::ImageShape shape);
  gpu::ImageHandle texture(gpu::Format format, uvec2 size, std::span<const std::byte> texels,
                           gpu::ImageShape shape = gpu::ImageShape::plain);
  [[nodiscard]] std::vector<std::byte> read(gpu::ImageHandle image) const;
  /// Every run of mips; the images are ready for compute_write.
  void record_mips(gpu::CommandList& commands, std::span<const GroupRange> runs, std::uint32_t mip_operator) const;

  gpu::Device& device_;
  std::uint32_t size_;
  gpu::Format format_;
  gpu::SamplerHandle nearest_;
  gpu::SamplerHandle linear_;
  gpu::ImageHandle atlas_;
  gpu::ImageHandle pyramid_;
  gpu::PipelineHandle mips_;
};

/// Pipelines of probe() are kept from call to call, until this; before the device goes.
void forget_probe_pipelines();

/// A local light's row; `origin`: of its first face.
[[nodiscard]] shaders::ShadowRow spot_row(const FacePose& pose, double tan_inner, double width_m, uvec2 origin,
                                          std::uint32_t size);
/// Constants that fit the atlas' format.
[[nodiscard]] shaders::ShadowBlock shadow_block(const ShadowMaps& maps, float bias_m = 0.002f, bool d16 = false);

}  // namespace gloam::test
