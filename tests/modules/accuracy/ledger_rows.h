// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <random>
#include <string>

#include "modules/accuracy/ledger/row_json.h"

namespace gloam::test {

/// A row with a different number in every field.
inline LedgerRow full_row(std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  LedgerRow row = {.knob = "shadows.filter", .value = "exact \"16\", wide", .is_default = seed % 2 == 0};
  row.reference_kind = "traced";
  row.reference_name = "visibility, traced\nin jobs";
  row.reference_noise = number(random) * 1e-4;
  row.below_noise = seed % 3 == 0;
  if (seed % 4 == 1) row.counted = CountedError{number(random) * 100.0, "false positives a tile, \"all\"", {}};
  if (seed % 3 == 2) row.counted = CountedError{number(random), "mm", number(random)};
  row.no_reference = seed % 2 == 0 ? "" : "a look, \"warm\"";
  row.no_effect_reason = "no lamp, " + std::to_string(seed);
  if (seed % 5 == 4) row.wrong = "3 lights, missing";
  row.flip = ErrorPair{number(random), number(random)};
  row.rmse = number(random) * 1e3;
  row.rmse_p99 = number(random) * 1e-9;
  row.psnr_db = number(random) * 60.0;
  row.temporal = ErrorPair{number(random), number(random)};
  row.edges = EdgeError{{number(random), number(random)}, number(random) * 60.0, number(random)};
  if (seed % 4 != 3) row.whole = WholeError{{number(random), number(random)}, number(random) * 1e3, number(random)};
  row.ms = {number(random) * 10.0, number(random), number(random) * 100.0};
  row.wall_ms = number(random);
  row.cpu_ms = number(random);
  row.gpu_ms = number(random);
  row.module_cpu_ms = number(random);
  row.module_gpu_ms = number(random);
  row.ratio = number(random) * 2.0;
  row.ratio_low = number(random);
  row.ratio_high = number(random) * 3.0;
  row.sure_low = number(random);
  row.sure_high = number(random) * 4.0;
  row.pairs = seed + 7;
  row.picture = "a hash, " + std::to_string(seed);
  row.reference_picture = "another, " + std::to_string(seed);
  for (std::uint32_t area = 0; area < seed % 4; ++area) row.worst.push_back({area, 2 * area, 7, 5 + seed});
  row.no_effect = seed % 3 == 1;
  row.gpu_bytes = 0x1234567890abcull + seed;
  row.on_front = seed % 2 == 1;
  if (seed % 3 == 1)
    row.effect_model = EffectModelError{"rays, \"marched\"", {number(random), number(random)}, number(random), 1e-5};
  return row;
}

/// full_row() beside frames of the default.
inline TimedRow measured(std::uint32_t seed = 1) {
  TimedRow row = {.row = full_row(seed), .standard = {}};
  for (std::uint32_t frame = 0; frame < seed; ++frame)
    row.standard.push_back({0.1 * frame, 1.0 / 3.0, 1e-9 * seed, {{"fog", 0.7, 1e300}, {"lights", 0.0, 2.0}}});
  return row;
}

/// A row without a reference and therefore without errors.
inline LedgerRow bare_row() {
  LedgerRow row = {.knob = "lighting.tone_map", .value = "filmic", .is_default = true};
  row.ms = {1.0, 0.5, 2.0};
  return row;
}

inline LedgerPoint full_point(std::uint32_t seed) {
  LedgerRow row = full_row(seed);
  LedgerPoint point = {.settings = {{"shadows.filter", "hard"}, {"views.scale", "0." + std::to_string(seed)}}};
  point.is_exact = seed % 2 == 0;
  point.predicted_ms = row.temporal->mean;
  point.predicted_flip = row.temporal->p99;
  point.measured = {.value = settings_text(point.settings), .is_default = seed % 3 == 0};
  point.measured.reference_kind = kWholeFrameKind;
  point.measured.reference_name = kWholeFrameName;
  point.measured.whole = WholeError{*row.flip, *row.rmse, *row.psnr_db};
  point.measured.flip = row.flip;
  point.measured.rmse = row.rmse;
  point.measured.psnr_db = row.psnr_db;
  point.measured.ms = row.ms;
  point.measured.wall_ms = row.wall_ms;
  point.measured.cpu_ms = row.cpu_ms;
  point.measured.gpu_ms = row.gpu_ms;
  point.measured.ratio = row.ratio;
  point.measured.ratio_low = row.ratio_low;
  point.measured.ratio_high = row.ratio_high;
  point.measured.sure_low = row.sure_low;
  point.measured.sure_high = row.sure_high;
  point.measured.pairs = row.pairs;
  point.measured.gpu_bytes = row.gpu_bytes;
  point.measured.picture = row.picture;
  point.measured.reference_picture = row.reference_picture;
  point.measured.worst = row.worst;
  point.measured.on_front = row.on_front;
  return point;
}

inline Ledger full_ledger() {
  Ledger ledger;
  ledger.header = {.scene = "scenes/court \"yard\".gltf",
                   .scene_hash = "0123456789abcdef",
                   .camera = "lawn",
                   .time_s = 0.1,
                   .device = "a device",
                   .driver = "a driver, 1.2",
                   .device_type = "cpu",
                   .subgroup_size = 8,
                   .width = 320,
                   .height = 180,
                   .clock = "a clock, \"on the wall\"",
                   .version = "0.1.0",
                   .build = "fedcba9876543210",
                   .quick = true,
                   .frames = 5,
                   .samples = 64};
  for (std::uint32_t seed = 1; seed < 5; ++seed) ledger.rows.push_back(full_row(seed));
  ledger.rows.push_back(bare_row());
  ledger.rows.back().flip = ErrorPair{};
  ledger.rows.back().psnr_db = std::numeric_limits<double>::infinity();
  ledger.rows.push_back(bare_row());
  for (std::uint32_t seed = 5; seed < 9; ++seed) ledger.points.push_back(full_point(seed));
  ledger.model = ModelQuality{2, {1.25, 0.5}, {0.75, 3.5}};
  ledger.skipped = {{"grass.lod", "the scene does not call for grass: no patch"}};
  return ledger;
}

/// The same of two cameras.
inline Ledger ledger_of_two_cameras() {
  Ledger ledger = full_ledger();
  ledger.header.camera = "lawn,pond";
  ledger.cameras = {{"lawn", 0.0, ledger.rows}, {"pond", 1.5, ledger.rows}};
  for (LedgerPoint& point : ledger.points) {
    point.cameras = {point.measured, point.measured};
    point.cameras[1].ms.median_ms *= 0.5;
    point.cameras[1].picture = "of the pond";
  }
  return ledger;
}

}  // namespace gloam::test
