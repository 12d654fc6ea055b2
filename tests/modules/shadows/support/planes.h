// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/math/types.h"
#include "modules/shadows/maps/work_groups.h"
#include "shaders/shadows/maps/planes_shared.h"
#include "tests/support/kernel.h"

namespace gloam::test {

/// A face in the atlas and its depths, row by row.
struct PlaneFace {
  uvec2 origin;
  std::uint32_t size;
  std::vector<float> depths;

  [[nodiscard]] double depth(uvec2 texel) const { return depths[std::size_t{texel.y} * size + texel.x]; }
  /// Blocks per side; 0 if the face is smaller than a block of this level.
  [[nodiscard]] std::uint32_t blocks(std::uint32_t level) const { return size / GLOAM_SHADOW_PLANE_BLOCK >> level; }
};

/// A rectangle of a face, in texels of the face. `end` is one past the last.
struct PlanePart {
  const PlaneFace* face;
  uvec2 begin, end;
};

/// Planes read back from the device.
struct MadePlanes {
  std::uint32_t atlas_size;
  std::vector<vec4> texels;

  [[nodiscard]] std::size_t index(const PlaneFace& face, std::uint32_t level, uvec2 block) const;
  [[nodiscard]] glm::dvec4 plane(const PlaneFace& face, std::uint32_t level, uvec2 block) const {
    return glm::dvec4(texels[index(face, level, block)]);
  }
};

/// An atlas on the device and its planes, which planes.comp makes. Any error fails the test.
class PlaneImages {
 public:
  /// Planes that were never written.
  static inline const vec4 kUnwritten = vec4(std::bit_cast<float>(Kernel::kUntouched));

  PlaneImages(gpu::Device& device, std::uint32_t atlas_size, gpu::Format format = gpu::Format::r32_float);
  ~PlaneImages();
  PlaneImages(const PlaneImages&) = delete;
  PlaneImages& operator=(const PlaneImages&) = delete;

  /// Overwrites the whole atlas. Texels outside the faces get depth 1, so that a fetch outside a face is noticed.
  void draw(const std::vector<PlaneFace>& faces);
  /// Makes the planes of these parts in two dispatches, as add_shadow_planes_pass() does.
  void make(const std::vector<PlanePart>& parts);
  /// Makes the planes of whole faces.
  void make(const std::vector<PlaneFace>& faces);
  [[nodiscard]] MadePlanes read() const;

 private:
  gpu::ImageHandle image(gpu::Format format, uvec2 size, gpu::ImageUsage usage);
  void upload(std::span<const std::byte> texels);
  void turn(gpu::CommandList& commands, gpu::Access before, gpu::Access after) const;

  gpu::Device& device_;
  std::uint32_t atlas_size_;
  gpu::ImageHandle depths_;
  gpu::ImageHandle planes_;
  gpu::SamplerHandle sampler_;
  gpu::PipelineHandle pipeline_;
};

}  // namespace gloam::test
