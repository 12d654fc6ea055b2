// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/glossy_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "engine/math/packing.h"
#include "engine/render/camera/view_constants.h"
#include "engine/render/kernel_check/kernel_run.h"
#include "modules/reflections/passes/glossy_blur.h"

namespace gloam {
namespace {

using HalfColor = std::array<std::uint16_t, 4>;

/// Direction of the view ray through a pixel of a perspective view.
dvec3 ray_through(const RenderView& view, const glm::dvec2& pixel) {
  const glm::dvec2 ndc(2.0 * pixel.x / view.width - 1.0, 1.0 - 2.0 * pixel.y / view.height);
  const dmat4 rotation = glm::transpose(dmat4(view.view_from_relative)), clip(view.clip_from_view);
  const dvec4 at_one((ndc.x + clip[2][0]) / clip[0][0], (ndc.y + clip[2][1]) / clip[1][1], -1.0, 0.0);
  return glm::normalize(dvec3(rotation * at_one));
}

/// Width factor of a texel's surface.
double factor_of(const GlossyImages& in, std::size_t texel) {
  const double roughness = in.surface[texel][1] / 255.0;
  return in.c.pixel_roughness == 0 ? 1.0 : roughness * roughness;
}

void bind_constants(KernelRun& kernel, const GlossyImages& in) {
  kernel.input(0, std::vector{view_constants(in.view)});
  kernel.input(1, std::vector{in.c});
}

/// The greatest roughness of each tile, row by row.
std::vector<std::uint32_t> tile_roughness(const GlossyImages& in) {
  const uvec2 tiles = (in.c.size + std::uint32_t{GLOAM_REFLECTION_GROUP} - 1u) / std::uint32_t{GLOAM_REFLECTION_GROUP};
  std::vector<std::uint32_t> most(std::size_t{tiles.x} * tiles.y, 0);
  for (std::uint32_t y = 0; y < in.c.size.y; ++y)
    for (std::uint32_t x = 0; x < in.c.size.x; ++x) {
      std::uint32_t& tile = most[y / GLOAM_REFLECTION_GROUP * tiles.x + x / GLOAM_REFLECTION_GROUP];
      tile = std::max<std::uint32_t>(tile, in.surface[in.at(x, y)][1]);
    }
  return most;
}

/// Binds the list of all tiles, and runs the kernel.
Status run_tiles(KernelRun& kernel, const GlossyImages& in) {
  const uvec2 tiles = (in.c.size + std::uint32_t{GLOAM_REFLECTION_GROUP} - 1u) / std::uint32_t{GLOAM_REFLECTION_GROUP};
  std::vector<std::uint32_t> places;
  for (std::uint32_t y = 0; y < tiles.y; ++y)
    for (std::uint32_t x = 0; x < tiles.x; ++x) places.push_back(x | y << 16);
  const auto count = static_cast<std::uint32_t>(places.size());
  const std::uint32_t rows = (count + GLOAM_TILE_ROW - 1) / GLOAM_TILE_ROW;
  kernel.input(6, std::vector{shaders::MirrorCommands{GLOAM_TILE_ROW, rows, 1, count}});
  kernel.input(7, places);
  return kernel.run(GLOAM_TILE_ROW, rows);
}

Status run_lines(KernelRun& kernel, const GlossyImages& in, bool columns) {
  const uvec2 lines = columns ? uvec2(in.c.size.y, in.c.size.x) : in.c.size;
  return kernel.run((lines.x + GLOAM_BLUR_GROUP - 1) / GLOAM_BLUR_GROUP, lines.y);
}

/// A Gaussian over the texels of the line that reflect.
dvec4 gaussian_twin(const GlossyImages& in, const std::vector<vec4>& color, std::uint32_t x, std::uint32_t y,
                    double sigma, std::int64_t reach, bool columns) {
  dvec4 sum(0.0);
  double total = 0.0;
  const std::int64_t along = columns ? y : x, length = columns ? in.c.size.y : in.c.size.x;
  for (std::int64_t k = std::max<std::int64_t>(along - reach, 0); k <= std::min(along + reach, length - 1); ++k) {
    const auto place = static_cast<std::uint32_t>(k);
    const std::size_t other = columns ? in.at(x, place) : in.at(place, y);
    if (!in.reflects(other)) continue;
    const double d = static_cast<double>(k - along);
    const double weight = d == 0.0 ? 1.0 : std::exp(-0.5 * d * d / std::max(sigma * sigma, 1e-12));
    sum += weight * dvec4(color[other]);
    total += weight;
  }
  return sum / total;
}

}  // namespace

std::vector<std::uint8_t> GlossyImages::own_spread() const {
  std::vector<std::uint8_t> spread;
  for (const Surface& texel : surface) spread.push_back(texel[0]);
  return spread;
}

double GlossyImages::unit(std::uint32_t x, std::uint32_t y, bool columns) const {
  const auto scale = static_cast<double>(c.blur_scale), least = static_cast<double>(c.blur_across);
  if (columns) return scale;
  if (c.pixel_roughness == 0) return scale * least;
  // The sine of the angle between the view ray and the floor.
  const dvec3 ray = ray_through(view, (glm::dvec2(x, y) + 0.5) * double(c.scale));
  return scale * std::max(std::abs(ray.y), least);
}

double GlossyImages::sigma(std::uint32_t x, std::uint32_t y, double spread, bool columns) const {
  return unit(x, y, columns) * spread * factor_of(*this, at(x, y));
}

std::int64_t GlossyImages::reach(double sigma, bool& sure) const {
  const double exact = 2.0 * sigma;
  sure &= std::abs(exact - std::round(exact)) > 1e-4 * (1.0 + exact) || exact == 0.0;
  return std::min<std::int64_t>(static_cast<std::int64_t>(std::ceil(exact)), c.blur_radius);
}

GlossyImages glossy_images(std::uint32_t width, std::uint32_t height, std::uint32_t scale) {
  ViewSettings settings;
  settings.width = width * scale;
  settings.height = height * scale;
  settings.world_from_camera = glm::inverse(glm::lookAt(dvec3(0.0), dvec3(0.0, -1.5, -4.0), dvec3(0.0, 1.0, 0.0)));
  settings.world_from_camera[3] = dvec4(0.0, 1.5, 4.0, 1.0);
  GlossyImages made;
  made.view = make_view(settings, 0);
  made.c.scale = scale;
  made.c.size = uvec2(width, height);
  made.c.blur_scale = 1.0f;
  made.c.blur_across = 0.1f;
  made.c.pixel_roughness = 1;
  made.c.blur_tail = 2.5f;
  made.c.blur_tail_share = 0.5f;
  made.c.blur_radius = 8;
  made.surface.assign(made.texels(), GlossyImages::Surface{128, 128, 0, 0});
  made.color.assign(made.texels(), vec4(0.5f));
  made.tail = made.color;
  return made;
}

GlossyImages random_glossy_images(std::mt19937& random, std::uint32_t width, std::uint32_t height) {
  GlossyImages made = glossy_images(width, height);
  const auto byte = [&](std::uint32_t count) { return static_cast<std::uint8_t>(random() % count); };
  for (std::size_t i = 0; i < made.texels(); ++i) {
    const std::uint8_t spread = random() % 8 == 0 ? byte(256) : byte(40);
    const bool reflects = random() % 4 != 0;
    made.surface[i] = {spread, static_cast<std::uint8_t>(reflects ? 1 + byte(255) : 0), 0, 0};
    for (int k = 0; k < 4; ++k) {
      std::uniform_real_distribution<float> light(0.0f, 4.0f);
      made.color[i][k] = half_to_float(float_to_half(light(random)));
      made.tail[i][k] = half_to_float(float_to_half(light(random)));
    }
  }
  made.c.blur_radius = random() % 2 == 0 ? GLOAM_MOST_BLUR_RADIUS : 5;
  made.c.blur_scale = 40.0f;
  return made;
}

Result<std::vector<std::uint8_t>> run_dilation(const KernelLab& lab, const GlossyImages& in, bool columns,
                                               bool direct) {
  const ComputeProgram program = dilate_program(columns, direct);
  KernelRun kernel(lab, program.shader, program.constants);
  bind_constants(kernel, in);
  kernel.sampled_image(2, gpu::Format::rgba8_unorm, in.c.size.x, in.c.size.y, in.surface);
  kernel.sampled_image(3, gpu::Format::rgba8_unorm, in.c.size.x, in.c.size.y, in.surface);
  kernel.output_image(4, gpu::Format::r8_unorm, in.c.size.x, in.c.size.y);
  if (direct) kernel.input(5, tile_roughness(in));
  GLOAM_TRY(direct ? run_tiles(kernel, in) : run_lines(kernel, in, columns));
  std::vector<std::uint8_t> dilated = kernel.read<std::uint8_t>(4);
  dilated.resize(in.texels());
  return dilated;
}

Result<BlurredLines> run_glossy_blur(const KernelLab& lab, const GlossyImages& in,
                                     const std::vector<std::uint8_t>& spread, bool columns, bool direct) {
  const ComputeProgram program = blur_program(columns, direct);
  KernelRun kernel(lab, program.shader, program.constants);
  bind_constants(kernel, in);
  kernel.sampled_image(2, gpu::Format::r8_unorm, in.c.size.x, in.c.size.y, spread);
  kernel.sampled_image(3, gpu::Format::rgba8_unorm, in.c.size.x, in.c.size.y, in.surface);
  // One picture, or that of the core and below it that of the tail.
  std::vector<vec4> color = in.color;
  if (!columns) color.insert(color.end(), in.tail.begin(), in.tail.end());
  const std::uint32_t read_rows = in.c.size.y * (columns ? 1 : 2), written_rows = in.c.size.y * (columns ? 2 : 1);
  kernel.sampled_image(4, gpu::Format::rgba32_float, in.c.size.x, read_rows, color);
  kernel.output_image(5, gpu::Format::rgba16_float, in.c.size.x, written_rows);
  GLOAM_TRY(direct ? run_tiles(kernel, in) : run_lines(kernel, in, columns));
  std::vector<vec4> blurred;
  for (const HalfColor& half : kernel.read<HalfColor>(5))
    blurred.emplace_back(half_to_float(half[0]), half_to_float(half[1]), half_to_float(half[2]),
                         half_to_float(half[3]));
  const auto rows = static_cast<std::ptrdiff_t>(in.texels());
  BlurredLines made{.core = {blurred.begin(), blurred.begin() + rows}, .tail = {}};
  made.tail = columns ? std::vector<vec4>(blurred.begin() + rows, blurred.begin() + 2 * rows) : made.core;
  return made;
}

std::optional<std::uint8_t> dilated_twin(const GlossyImages& in, std::uint32_t x, std::uint32_t y, bool columns,
                                         bool direct) {
  if (!in.reflects(in.at(x, y))) return std::uint8_t{0};
  bool sure = true;
  std::uint8_t greatest = in.surface[in.at(x, y)][0];
  const std::uint32_t along = columns ? y : x, length = columns ? in.c.size.y : in.c.size.x;
  for (std::uint32_t k = 0; k < length; ++k) {
    const uvec2 other = columns ? uvec2(x, k) : uvec2(k, y);
    const GlossyImages::Surface& texel = in.surface[in.at(other.x, other.y)];
    if (texel[1] == 0) continue;
    const double unit = direct ? in.unit(x, y, columns) : in.unit(other.x, other.y, columns);
    const double sigma = unit * (texel[0] / 255.0) * factor_of(in, in.at(other.x, other.y));
    const double widest = sigma * std::max(1.0, static_cast<double>(in.c.blur_tail));
    if (std::abs(std::int64_t{k} - along) <= in.reach(widest, sure)) greatest = std::max(greatest, texel[0]);
  }
  return sure ? std::optional(greatest) : std::nullopt;
}

std::optional<BlurredTexel> blurred_twin(const GlossyImages& in, const std::vector<std::uint8_t>& spread,
                                         std::uint32_t x, std::uint32_t y, bool columns) {
  const std::size_t own = in.at(x, y);
  if (!in.reflects(own)) return BlurredTexel{};
  bool sure = true;
  const double sigma = in.sigma(x, y, spread[own] / 255.0, columns);
  const double of_tail = sigma * static_cast<double>(in.c.blur_tail);
  const std::int64_t core_reach = in.reach(sigma, sure), tail_reach = in.reach(of_tail, sure);
  // Below 0.15 texels nothing is blurred.
  if (!sure || std::abs(sigma - 0.15) < 0.01 || std::abs(of_tail - 0.15) < 0.01) return std::nullopt;
  const dvec4 core = gaussian_twin(in, in.color, x, y, sigma, core_reach, columns);
  const dvec4 tail = gaussian_twin(in, columns ? in.color : in.tail, x, y, of_tail, tail_reach, columns);
  if (columns) return BlurredTexel{core, tail};
  const dvec4 both = glm::mix(core, tail, static_cast<double>(in.c.blur_tail_share));
  return BlurredTexel{both, both};
}

}  // namespace gloam
