// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/kernel_check/kernel_lab.h"

namespace gloam {

/// An atlas with one face of a spot light, its mips and its pyramid, which mips.comp makes.
class MapRun {
 public:
  explicit MapRun(const KernelLab& lab) : device_(lab.device()), lab_(lab) {}
  ~MapRun();
  MapRun(const MapRun&) = delete;
  MapRun& operator=(const MapRun&) = delete;

  /// depths: reversed, row by row. gap: see ShadowMipGroup::gap. Call once.
  [[nodiscard]] Status make(const std::vector<float>& depths, std::uint32_t side, float gap);
  /// After make(), both ready for compute_read.
  [[nodiscard]] gpu::ImageHandle atlas() const { return atlas_; }
  [[nodiscard]] gpu::ImageHandle pyramid() const { return pyramid_; }

 private:
  [[nodiscard]] Status start(const std::vector<float>& depths, std::uint32_t side);

  gpu::Device& device_;
  const KernelLab& lab_;
  gpu::ImageHandle scratch_, atlas_, pyramid_;
  gpu::SamplerHandle nearest_;
  gpu::PipelineHandle mips_;
  gpu::BufferHandle groups_;
};

}  // namespace gloam
