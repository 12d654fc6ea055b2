// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The lines of the glossy blur (dilate.comp, blur.comp), run alone, and their twins in double precision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/kernel_check/kernel_lab.h"
#include "engine/render/view.h"
#include "shaders/reflections/reflections_shared.h"

namespace gloam {

/// Reflection images of a view that looks down at a floor.
struct GlossyImages {
  using Surface = std::array<std::uint8_t, 4>;  ///< spread, roughness, distance

  RenderView view;
  shaders::ReflectionConstants c{.unit_m = 1.0f};
  std::vector<Surface> surface;
  std::vector<vec4> color;
  std::vector<vec4> tail;  ///< along rows: what the tail blurs, as `color` is what the core blurs

  [[nodiscard]] std::size_t texels() const { return std::size_t{c.size.x} * c.size.y; }
  [[nodiscard]] std::size_t at(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * c.size.x + x; }
  [[nodiscard]] bool reflects(std::size_t texel) const { return surface[texel][1] > 0; }
  [[nodiscard]] std::vector<std::uint8_t> own_spread() const;

  /// Standard deviation in texels of the core of a texel's blur, for this spread.
  [[nodiscard]] double sigma(std::uint32_t x, std::uint32_t y, double spread, bool columns) const;
  /// The same for spread 1 and roughness 1.
  [[nodiscard]] double unit(std::uint32_t x, std::uint32_t y, bool columns) const;
  /// Texels on each side; `sure` becomes false if rounding may decide.
  [[nodiscard]] std::int64_t reach(double sigma, bool& sure) const;
};

/// Light of the lines of a blur. Along rows core and tail are added up, and both are the sum.
struct BlurredLines {
  std::vector<vec4> core;
  std::vector<vec4> tail;
};

/// One texel of BlurredLines in double precision.
struct BlurredTexel {
  dvec4 core = dvec4(0.0);
  dvec4 tail = dvec4(0.0);
};

/// Images of a width and height in texels: a floor that reflects everywhere.
[[nodiscard]] GlossyImages glossy_images(std::uint32_t width, std::uint32_t height, std::uint32_t scale = 2);
/// Random spreads, roughnesses and colours; a part of the texels does not reflect.
[[nodiscard]] GlossyImages random_glossy_images(std::mt19937& random, std::uint32_t width, std::uint32_t height);

/// direct: the kernels of devices that run threads in turn (dilate_tiles.comp, blur_tiles.comp), over a list of all
/// tiles.
[[nodiscard]] Result<std::vector<std::uint8_t>> run_dilation(const KernelLab& lab, const GlossyImages& in, bool columns,
                                                             bool direct);
[[nodiscard]] Result<BlurredLines> run_glossy_blur(const KernelLab& lab, const GlossyImages& in,
                                                   const std::vector<std::uint8_t>& spread, bool columns, bool direct);

/// The greatest spread of all texels of the line whose blur reaches the texel. None if rounding may decide. direct: the
/// unit of the texel stands for those of its neighbours.
[[nodiscard]] std::optional<std::uint8_t> dilated_twin(const GlossyImages& in, std::uint32_t x, std::uint32_t y,
                                                       bool columns, bool direct);
/// The two Gaussians over the texels of the line that reflect. None if rounding may decide.
[[nodiscard]] std::optional<BlurredTexel> blurred_twin(const GlossyImages& in, const std::vector<std::uint8_t>& spread,
                                                       std::uint32_t x, std::uint32_t y, bool columns);

}  // namespace gloam
