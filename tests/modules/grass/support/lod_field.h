// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "engine/math/packing.h"
#include "engine/render/view.h"
#include "modules/grass/lod/detail.h"
#include "shaders/grass/grass_shared.h"
#include "shaders/grass/lod/lod_shared.h"
#include "tests/support/render_scene.h"

namespace gloam::test {

[[nodiscard]] inline RenderView camera_at(const dvec3& eye, const dvec3& target) {
  return make_view(look_at(eye, target, 640, 360), 0);
}

/// Level of detail with the default knobs.
[[nodiscard]] inline shaders::GrassLod lod_of(const RenderView& view, float range_m) {
  return grass_lod(view, {}, {range_m, 0.4f});
}

/// Patches of random blades around the origin as the kernels of the level of detail see them.
struct LodField {
  std::vector<shaders::GrassPatchRow> patches;  ///< with origins in the world, until camera() is applied
  std::vector<shaders::GrassBladeRow> blades;
  std::uint32_t places = 0;  ///< of masters
  float range_m = 0.0f;

  [[nodiscard]] static LodField random(std::uint32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    LodField field;
    field.patches.resize(count);
    for (std::uint32_t p = 0; p < count; ++p) {
      shaders::GrassPatchRow& row = field.patches[count - 1 - p];
      row.origin = vec3(30.0f * unit(random) - 15.0f, 2.0f * unit(random) - 1.0f, 30.0f * unit(random) - 15.0f);
      row.box_from = vec3(-0.7f, -0.1f, -0.6f);
      row.box_size = vec3(1.5f, 0.2f, 1.1f);
      row.first_blade = static_cast<std::uint32_t>(field.blades.size());
      row.blades = p == 0 ? 1 : 1 + static_cast<std::uint32_t>(random() % GLOAM_GRASS_PATCH_BLADES);
      const std::uint32_t masters = 1 + static_cast<std::uint32_t>(random() % row.blades);
      row.first_place = field.places;
      row.max_distance_m = p % 2 == 0 ? 20.0f : 9.0f;
      field.range_m = std::max(field.range_m, row.max_distance_m);
      field.places += masters;
      for (std::uint32_t i = 0; i < GLOAM_GRASS_PATCH_BLADES; ++i) {
        shaders::GrassBladeRow blade{};
        if (i < row.blades) {
          const auto word = [&] { return static_cast<std::uint32_t>(random() & 0xFFFFFFFFu); };
          blade.root_xz = word();
          blade.root_y_normal = word() & 0xFFFFu;
          const float length_m = i % 37 == 5 ? 0.0f : 0.1f + 0.5f * unit(random);
          blade.size = std::uint32_t{float_to_half(length_m)} | std::uint32_t{float_to_half(0.006f)} << 16;
          const std::uint32_t master = i < masters ? i : word() % masters;
          blade.kind = (word() & 0xFF0000FFu) | master << 16;
        }
        field.blades.push_back(blade);
      }
    }
    return field;
  }
  /// A camera in the field; the patches' origins become relative to it.
  [[nodiscard]] RenderView camera(std::uint32_t seed) {
    std::mt19937 random(seed + 1000);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const dvec3 eye(6.0 * unit(random), 1.0 + 0.5 * unit(random), 6.0 * unit(random));
    const RenderView view = camera_at(eye, eye + dvec3(unit(random), 0.3 * unit(random), unit(random)));
    for (shaders::GrassPatchRow& row : patches) row.origin = vec3(dvec3(row.origin) - eye);
    return view;
  }
};

struct ExpectedKey {
  std::uint32_t key = GLOAM_GRASS_CULLED;
  bool doubtful = false;  ///< a rounding error could change it
};

/// The key of a blade, in double. blade: 256 · patch row + index in the patch.
[[nodiscard]] inline ExpectedKey expected_key(const LodField& field, const RenderView& view,
                                              const shaders::GrassLod& lod, std::uint32_t blade) {
  constexpr double kDoubt_m = 1e-4;
  const shaders::GrassPatchRow& patch = field.patches[blade / GLOAM_GRASS_PATCH_BLADES];
  const std::uint32_t index = blade % GLOAM_GRASS_PATCH_BLADES;
  if (index >= patch.blades) return {};
  const shaders::GrassBladeRow& row = field.blades[patch.first_blade + index];
  const auto length_m = static_cast<double>(half_to_float(static_cast<std::uint16_t>(row.size & 0xFFFFu)));
  const auto width_m = static_cast<double>(half_to_float(static_cast<std::uint16_t>(row.size >> 16)));
  if (length_m <= 0.0) return {};
  const dvec3 share(row.root_xz & 0xFFFFu, row.root_y_normal & 0xFFFFu, row.root_xz >> 16);
  const dvec3 root = dvec3(patch.origin) + dvec3(patch.box_from) + dvec3(patch.box_size) * share / 65535.0;
  const double distance_m = glm::length(root);
  ExpectedKey expected;
  const auto less = [&](double a, double b) {
    expected.doubtful = expected.doubtful || std::abs(a - b) < kDoubt_m;
    return a < b;
  };
  // Distance of the root from the view's pyramid: every knot lies within the blade's length of the root.
  bool in_view = true;
  for (int i = 0; i < 5; ++i) {
    const auto& plane = view.frustum.planes[static_cast<std::size_t>(i)];
    in_view = !less(glm::dot(dvec3(plane.normal), root) + static_cast<double>(plane.distance), -length_m) && in_view;
  }
  const bool casts = lod.cast_m > 0.0f && less(distance_m, static_cast<double>(lod.cast_m));
  bool drawn = less(distance_m, static_cast<double>(patch.max_distance_m)) && (in_view || casts);
  // Thinning: a blade is left out if its rank is above 1.25 times the share, which is at least 1/16.
  const double pixel_m =
      2.0 * distance_m / (static_cast<double>(std::abs(view.clip_from_view[1][1])) * static_cast<double>(view.height));
  const double kept =
      lod.width_px > 0.0f ? std::clamp(width_m / (static_cast<double>(lod.width_px) * pixel_m), 1.0 / 16.0, 1.0) : 1.0;
  const double rank = static_cast<double>(row.kind >> 24) / 255.0;
  if (kept < 1.0) drawn = less(rank, 1.25 * kept) && drawn;
  const double key = distance_m / static_cast<double>(lod.range_m) * 255.0;
  expected.doubtful = expected.doubtful || std::abs(key - std::round(key)) < 2e-3;
  const auto whole = static_cast<std::uint32_t>(std::clamp(key, 0.0, 254.0));
  if (drawn && whole <= lod.threshold) expected.key = whole;
  return expected;
}

}  // namespace gloam::test
