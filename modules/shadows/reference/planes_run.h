// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/math/types.h"
#include "engine/render/kernel_check/kernel_lab.h"
#include "engine/render/kernel_check/kernel_run.h"
#include "modules/shadows/reference/planes_twin.h"

namespace gloam {

/// A rectangle of a face, in texels of the face. `end` is one past the last.
struct PlanePart {
  const PlaneFace* face;
  uvec2 begin, end;
};

/// Planes read back from the device.
struct MadePlanes {
  std::uint32_t atlas_size = 0;
  std::vector<vec4> texels;

  [[nodiscard]] std::size_t index(const PlaneFace& face, std::uint32_t level, uvec2 block) const;
  [[nodiscard]] dvec4 plane(const PlaneFace& face, std::uint32_t level, uvec2 block) const {
    return dvec4(texels[index(face, level, block)]);
  }
};

/// An atlas on the device and its planes, which planes.comp makes.
class PlaneRun {
 public:
  /// Planes that were never written.
  static inline const vec4 kUnwritten = vec4(std::bit_cast<float>(KernelRun::kUntouched));

  explicit PlaneRun(const KernelLab& lab) : device_(lab.device()), lab_(lab) {}
  ~PlaneRun();
  PlaneRun(const PlaneRun&) = delete;
  PlaneRun& operator=(const PlaneRun&) = delete;

  /// Call first.
  [[nodiscard]] Status start(std::uint32_t atlas_size, gpu::Format format = gpu::Format::r32_float);
  /// Overwrites the whole atlas. Texels outside the faces get depth 1, so that a fetch outside a face is noticed.
  [[nodiscard]] Status draw(const std::vector<PlaneFace>& faces);
  /// Makes the planes of these parts in two dispatches, as add_shadow_planes_pass() does.
  [[nodiscard]] Status make(const std::vector<PlanePart>& parts);
  /// Makes the planes of whole faces.
  [[nodiscard]] Status make(const std::vector<PlaneFace>& faces);
  [[nodiscard]] Result<MadePlanes> read();

 private:
  [[nodiscard]] Status upload(std::span<const std::byte> texels);
  [[nodiscard]] Status submit();
  void turn(gpu::CommandList& commands, gpu::Access before, gpu::Access after) const;

  gpu::Device& device_;
  const KernelLab& lab_;
  std::uint32_t atlas_size_ = 0;
  gpu::ImageHandle depths_;
  gpu::ImageHandle planes_;
  gpu::SamplerHandle sampler_;
  gpu::PipelineHandle pipeline_;
};

}  // namespace gloam
