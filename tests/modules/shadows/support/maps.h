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
#include "shaders/shadows/shadows_shared.h"
#include "tests/shaders/shadows_test/probe_shared.h"

namespace gloam::test {

/// Distance to the first hit of a ray, in lengths of `direction` (which may have any length); not positive: no hit.
using RayScene = std::function<double(const dvec3& origin, const dvec3& direction)>;

/// The union of several scenes.
[[nodiscard]] RayScene nearest_of(std::vector<RayScene> scenes);
/// The part of the plane through `point` for whose points inside() is true.
[[nodiscard]] RayScene plane(dvec3 point, dvec3 normal, std::function<bool(const dvec3&)> inside = nullptr);

/// Pose of a face of a local light, or of a cascade.
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
/// A cube face, as defined in shadows_shared.h.
[[nodiscard]] FacePose cube_face(int face, dvec3 origin, double tan_half);

/// Reversed depths of a face, row by row, by rays through the centres of its texels.
[[nodiscard]] std::vector<float> draw_face(const FacePose& pose, std::uint32_t size, const RayScene& scene);

/// Specialisation constants for ShadowMaps::probe().
struct ProbeSettings {
  std::uint32_t filter = 3;
  std::uint32_t kernel = 8;
  std::uint32_t mips = 1;
  std::uint32_t receiver_plane = 1;
  std::uint32_t bias = 1;
  std::uint32_t shape = 0;
  std::uint32_t levels = 0;
  std::uint32_t full_penumbra = 0;
  std::uint32_t near = 1;      ///< values of the knob shadows.near
  std::uint32_t coverage = 0;  ///< faces were added with GLOAM_SHADOW_MIPS_COVERAGE
  bool standard = false;       ///< compiled with GLOAM_SHADOWS_STANDARD, which supports filter 3 and kernel 8 only
  [[nodiscard]] gpu::SpecConstants constants() const;
};

/// A shadow atlas on the device: mips.comp fills it with faces, and probe.comp evaluates visibilities. Any error fails
/// the test.
class ShadowMaps {
 public:
  ShadowMaps(gpu::Device& device, std::uint32_t atlas_size, gpu::Format format = gpu::Format::r32_float);
  ~ShadowMaps();
  ShadowMaps(const ShadowMaps&) = delete;
  ShadowMaps& operator=(const ShadowMaps&) = delete;

  void add_face(const std::vector<float>& depths, uvec2 origin, std::uint32_t size, bool orthographic = false,
                std::uint32_t mip_operator = GLOAM_SHADOW_MIPS_NEAREST, float gap = 0.0f);
  /// Copies mip 0 of a face to another square (overlay_copy.comp) and makes its mips and pyramid there
  /// (mips_in_place.comp).
  void copy_face(uvec2 origin, uvec2 copy, std::uint32_t size, bool orthographic = false,
                 std::uint32_t mip_operator = GLOAM_SHADOW_MIPS_NEAREST, float gap = 0.0f);
  /// Overwrites the atlas image, mips included. The pyramid stays.
  void write_atlas(const std::vector<float>& texels);
  [[nodiscard]] std::vector<float> atlas() const;
  [[nodiscard]] std::vector<vec2> pyramid() const;  ///< farthest and nearest depth
  [[nodiscard]] std::uint32_t atlas_size() const { return size_; }
  /// In state compute_read.
  [[nodiscard]] gpu::ImageHandle atlas_image() const { return atlas_; }
  [[nodiscard]] gpu::ImageHandle pyramid_image() const { return pyramid_; }

  [[nodiscard]] std::vector<shaders::ShadowProbeResult> probe(std::span<const shaders::ShadowProbe> probes,
                                                              const std::vector<shaders::ShadowRow>& rows,
                                                              const shaders::ShadowBlock& block,
                                                              const ProbeSettings& settings = {});

 private:
  gpu::ImageHandle image(gpu::Format format, uvec2 size, gpu::ImageUsage usage, gpu::ImageShape shape);
  gpu::ImageHandle texture(gpu::Format format, uvec2 size, std::span<const std::byte> texels,
                           gpu::ImageShape shape = gpu::ImageShape::plain);
  [[nodiscard]] std::vector<std::byte> read(gpu::ImageHandle image) const;
  /// Records all runs of mips. The images must be in state compute_write.
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

/// Destroys the pipelines that calls of probe() have made. Call before the device is destroyed.
void forget_probe_pipelines();

/// The row of a local light. origin: corner of its first face in the atlas.
[[nodiscard]] shaders::ShadowRow spot_row(const FacePose& pose, double tan_inner, double width_m, uvec2 origin,
                                          std::uint32_t size);
/// Constants that match the format of the atlas.
[[nodiscard]] shaders::ShadowBlock shadow_block(const ShadowMaps& maps, float bias_m = 0.002f, bool d16 = false);

}  // namespace gloam::test
