// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/filter_run.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <numbers>
#include <utility>

#include "engine/math/packing.h"
#include "engine/render/camera/view_constants.h"
#include "engine/render/kernel_check/kernel_run.h"
#include "engine/render/view.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/reference/map_run.h"
#include "modules/shadows/views/cascade_rows.h"
#include "shaders/shadows/final_lists_shared.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kTiles = FilterScene::kPictureSide / 8;  // along a side
constexpr std::uint32_t kTileCount = kTiles * kTiles;
constexpr double kNearMapPlane_m = 0.05, kNearPlane_m = 0.1, kCameraHeight_m = 2.0;
constexpr double kPictureTan = 0.8;  // of half the view's angle
constexpr double kTanOuter = 0.45;   // of the light's cone
constexpr double kGoldenTurn = 2.39996322972865332;

/// A camera 2 m above the floor that looks down. Its rows run along the map's rows.
RenderView view_of_floor() {
  ViewSettings settings;
  settings.width = settings.height = FilterScene::kPictureSide;
  settings.camera.near_m = static_cast<float>(kNearPlane_m);
  settings.camera.fov_y = static_cast<float>(2.0 * std::atan(kPictureTan));
  settings.world_from_camera = glm::rotate(dmat4(1.0), -0.5 * std::numbers::pi, dvec3(1.0, 0.0, 0.0));
  return make_view(settings, 0);
}

/// The light in its image: position and range, colour and cone, direction and cone.
std::vector<vec4> light_texels() {
  const double outer = std::atan(kTanOuter), cosine = std::cos(outer);
  const auto scale = static_cast<float>(1.0 / (std::cos(0.95 * outer) - cosine));
  return {vec4(0.0f, static_cast<float>(FilterScene::kFloor_m - kCameraHeight_m), 0.0f, 1.0f / 400.0f),
          vec4(5.0f, 5.0f, 5.0f, scale), vec4(0.0f, -1.0f, 0.0f, static_cast<float>(-cosine) * scale)};
}

shaders::ShadowRow row_of(const FilterScene& scene) {
  shaders::ShadowRow row{};
  row.kind = GLOAM_SHADOW_SPOT;
  row.near_m = static_cast<float>(kNearMapPlane_m);
  row.emitter_diameter_m = static_cast<float>(scene.width_m);
  row.size = static_cast<float>(FilterScene::kMapSide);
  row.right = vec3(1.0f, 0.0f, 0.0f);
  row.up = vec3(0.0f, 0.0f, -1.0f);
  row.tan_half = static_cast<float>(FilterScene::kTanHalf);
  row.tan_inner = static_cast<float>(kTanOuter);
  row.cookie_layer = row.traced_layer = -1.0f;
  row.cookie_tan = 1.0f;
  return row;
}

shaders::ShadowBlock block_of(std::vector<shaders::ShadowRow>& rows) {
  shaders::ShadowBlock block{};
  block.atlas_size = static_cast<float>(FilterScene::kMapSide);
  block.bias_m = 0.002f;
  block.relative_quantum = 1.0f / 16777216.0f;
  append_cascade_rows({}, block, rows);
  return block;
}

shaders::FinalGrid grid_of_tiles() {
  shaders::FinalGrid grid{};
  grid.tiles = uvec2(kTiles);
  grid.has_early_lists = 1;
  grid.entry_capacity = grid.pair_capacity = grid.slot_capacity = kTileCount;
  return grid;
}

gpu::SpecConstants standard_constants(const gpu::DeviceInfo& device) {
  gpu::SpecConstants constants;
  constants.set("kMips", 1u);
  constants.set("kReceiverPlane", 1u);
  constants.set("kBias", 1u);
  constants.set("kKernelShape", 0u);
  constants.set("kLevels", 255u);
  constants.set("kFullPenumbra", 0u);
  constants.set("kCoverage", 1u);
  constants.set("kNear", 1u);
  constants.set("local_size_x", threads_a_tile(device));
  constants.set("kVisibilityBits", 8u);
  return constants;
}

/// The pictures that the kernel reads: a floor in all pixels.
void bind_pictures(KernelRun& kernel) {
  constexpr std::uint32_t kSide = FilterScene::kPictureSide;
  constexpr std::size_t kPixels = std::size_t{kSide} * kSide;
  const std::uint32_t up = pack_normal_snorm16(vec3(0.0f, 1.0f, 0.0f));
  kernel.sampled_image(3, gpu::Format::r32_float, kSide, kSide,
                       std::vector<float>(kPixels, static_cast<float>(kNearPlane_m / kCameraHeight_m)));
  kernel.sampled_image(4, gpu::Format::rg32_uint, kSide, kSide, std::vector<uvec2>(kPixels, uvec2(up)));
  kernel.sampled_image(5, gpu::Format::rgba8_unorm, kSide, kSide, std::vector<std::uint32_t>(kPixels, 0x00808080u));
}

/// The visibility that the kernel has stored for a pixel.
double stored_visibility(const std::vector<std::uint32_t>& entries, const std::vector<std::uint32_t>& words,
                         uvec2 pixel) {
  const std::uint32_t tile = pixel.y / 8 * kTiles + pixel.x / 8, slot = entries[tile] >> 10;
  if (slot == GLOAM_ALL_LIT || slot == GLOAM_ALL_UNLIT) return slot == GLOAM_ALL_LIT ? 1.0 : 0.0;
  const std::size_t byte = std::size_t{slot} * GLOAM_SLOT_PIXELS + pixel.y % 8 * 8 + pixel.x % 8;
  return byte / 4 < words.size() ? (words[byte / 4] >> 8 * (byte % 4) & 0xFFu) / 255.0 : -1.0;
}

}  // namespace

double FilterScene::depth_at(uvec2 texel) const {
  double nearest = kFloor_m;
  for (const Plate& plate : plates)
    if (texel.x >= plate.begin.x && texel.y >= plate.begin.y && texel.x < plate.end.x && texel.y < plate.end.y)
      nearest = std::min(nearest, plate.depth_m);
  return nearest;
}

glm::dvec2 FilterScene::floor_at(uvec2 pixel) {
  return (2.0 * (glm::dvec2(pixel) + 0.5) / double{kPictureSide} - 1.0) * kPictureTan * kCameraHeight_m;
}

bool FilterScene::in_cone(uvec2 pixel) { return glm::length(floor_at(pixel)) < 0.9 * kTanOuter * kFloor_m; }

double FilterScene::seen_share(uvec2 pixel) const {
  constexpr int kPoints = 512;
  const glm::dvec2 from = floor_at(pixel);
  int seen = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double radius = 0.5 * width_m * std::sqrt((i + 0.5) / kPoints), angle = i * kGoldenTurn;
    const glm::dvec2 emitted(radius * std::cos(angle), radius * std::sin(angle));
    const bool hidden = std::ranges::any_of(plates, [&](const Plate& plate) {
      const glm::dvec2 crossed = emitted + (from - emitted) * (plate.depth_m / kFloor_m);
      const glm::dvec2 texel = (crossed / (plate.depth_m * kTanHalf) + 1.0) * (0.5 * kMapSide);
      return texel.x >= plate.begin.x && texel.y >= plate.begin.y && texel.x < plate.end.x && texel.y < plate.end.y;
    });
    seen += hidden ? 0 : 1;
  }
  return static_cast<double>(seen) / kPoints;
}

Result<std::vector<double>> run_filter(const KernelLab& lab, const FilterScene& scene) {
  std::vector<float> depths;
  for (std::uint32_t y = 0; y < FilterScene::kMapSide; ++y)
    for (std::uint32_t x = 0; x < FilterScene::kMapSide; ++x)
      depths.push_back(static_cast<float>(kNearMapPlane_m / scene.depth_at(uvec2(x, y))));
  MapRun map(lab);
  const double texel = 2.0 * FilterScene::kTanHalf / FilterScene::kMapSide;
  GLOAM_TRY(map.make(depths, FilterScene::kMapSide, static_cast<float>(3.0 * texel)));

  std::vector<std::uint32_t> entries(kTileCount), pairs(std::size_t{2} * kTileCount, 0);
  for (std::uint32_t tile = 0; tile < kTileCount; ++tile) {
    entries[tile] = tile << 10;
    pairs[tile] = tile;
  }
  shaders::ShadowListCommands commands{};
  for (uvec4& kind : commands.pairs) kind = {GLOAM_PAIRS_ROW, 0, 1, 0};
  commands.pairs[GLOAM_PAIRS_IN_FACE] = {GLOAM_PAIRS_ROW, 1, 1, kTileCount};
  std::vector<shaders::ShadowRow> rows = {row_of(scene)};
  const shaders::ShadowBlock block = block_of(rows);

  KernelRun kernel(lab, shaders::shadows::generate_in_face_standard_comp, standard_constants(lab.device().info()));
  kernel.input(0, std::vector{view_constants(view_of_floor())});
  kernel.input(2, std::vector{grid_of_tiles()});
  bind_pictures(kernel);
  kernel.sampled_image(6, gpu::Format::rgba32_float, 3, 1, light_texels());
  kernel.input(7, pairs);
  kernel.in_out(8, entries);
  kernel.output(9, std::uint64_t{kTileCount} * GLOAM_SLOT_PIXELS);
  kernel.output(10, 64);
  kernel.in_out(11, std::vector<shaders::ShadowListCounters>(1));
  kernel.input(12, std::vector{block});
  kernel.sampled_image(13, gpu::Format::rgba32_float, GLOAM_SHADOW_ROW_TEXELS, static_cast<std::uint32_t>(rows.size()),
                       rows);
  kernel.sampled_image(14, map.atlas());
  kernel.sampled_image(15, map.pyramid());
  for (const std::uint32_t binding : {16u, 17u})
    kernel.sampled_image(binding, gpu::Format::rgba8_unorm, 1, 1, std::vector<std::uint32_t>(1, ~0u),
                         gpu::ImageShape::array);
  kernel.input(18, std::vector{commands});
  kernel.input(19, std::vector<std::uint32_t>{0});                                   // no tile is reserved
  kernel.sampled_image(21, gpu::Format::rg32_uint, 1, 1, std::vector<uvec2>(1));     // no smooth surface
  kernel.sampled_image(22, gpu::Format::rgba16_float, 1, 1, std::vector<uvec2>(1));  // nothing passes through
  GLOAM_TRY(kernel.run(GLOAM_PAIRS_ROW));
  const auto written = kernel.read<std::uint32_t>(8), words = kernel.read<std::uint32_t>(9);
  std::vector<double> visibilities;
  for (std::uint32_t y = 0; y < FilterScene::kPictureSide; ++y)
    for (std::uint32_t x = 0; x < FilterScene::kPictureSide; ++x)
      visibilities.push_back(stored_visibility(written, words, uvec2(x, y)));
  return visibilities;
}

}  // namespace gloam
