// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "engine/render/readback/geometry_picture.h"
#include "modules/grass/reference/slave_pose.h"
#include "tests/modules/grass/support/grass_stage.h"

namespace gloam::test {

/// A live blade as it must be drawn: its knots in the world, and its width at the root before the LOD widens it.
struct Stem {
  std::array<dvec3, kGrassKnots> at{};
  dvec3 side = dvec3(1.0, 0.0, 0.0);  ///< across the blade at the root
  double width_m = 0.0;
  std::uint32_t slot = 0;
  double distance_m = 0.0;  ///< of the root from the camera

  [[nodiscard]] double distance_to(const dvec3& point) const {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < kGrassKnots; ++k) {
      const dvec3 along = at[k] - at[k - 1];
      const double t = glm::dot(point - at[k - 1], along) / std::max(glm::dot(along, along), 1e-18);
      best = std::min(best, glm::length(point - at[k - 1] - std::clamp(t, 0.0, 1.0) * along));
    }
    return best;
  }
};

/// The stems of all live blades, from the masters' knots that were read back.
[[nodiscard]] inline std::vector<Stem> stems_of(const GrassField& field, const GrassCopy& copy, const dvec3& camera) {
  std::vector<Stem> stems;
  const auto stem_of = [](const GrassBlade& b) {
    return SlaveStem{dvec3(b.ground_normal), static_cast<double>(b.yaw), static_cast<double>(b.length_m)};
  };
  for (std::uint32_t i = 0; i < copy.draws.live; ++i) {
    const ResidentPatch& resident = copy.patches[copy.blades[i] / GLOAM_GRASS_PATCH_BLADES];
    const std::uint32_t index = copy.blades[i] % GLOAM_GRASS_PATCH_BLADES;
    const GrassPatch& patch = field.patches[resident.patch];
    const GrassBlade& blade = field.blades[resident.patch * GLOAM_GRASS_PATCH_BLADES + index];
    const GrassBlade& master = field.blades[blade.master];
    const std::size_t first =
        (std::size_t{resident.slot} * copy.slot_masters + blade.master % GLOAM_GRASS_PATCH_BLADES) * kGrassKnots;
    const BladeModel model = blade_model(master, field.types);
    constexpr std::size_t kTip = kGrassKnots - 1;
    const dvec3 tip(copy.knots[first + kTip]);
    const double speed =
        glm::length(tip - dvec3(copy.previous_knots[first + kTip])) / static_cast<double>(copy.steps.step_s);
    SlaveTurn turn{{dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)}};
    if (blade.slot != master.slot)
      turn = slave_turn(stem_of(master), stem_of(blade), index, tip - model.root, model.rest[kTip], speed);
    Stem stem;
    for (std::size_t k = 0; k < kGrassKnots; ++k)
      stem.at[k] = patch.origin + dvec3(blade.root_m) + slave_knot(turn, dvec3(copy.knots[first + k]) - model.root);
    stem.side = glm::normalize(slave_knot(turn, glm::cross(model.normal, model.forward)));
    stem.width_m = static_cast<double>(blade.width_m);
    stem.slot = blade.slot;
    stem.distance_m = glm::length(stem.at[0] - camera);
    stems.push_back(stem);
  }
  return stems;
}

/// Where a ray from the origin meets a triangle: its parameter; none if it misses.
[[nodiscard]] inline std::optional<double> meets(const dvec3& ray, const dvec3& a, const dvec3& b, const dvec3& c) {
  const dvec3 e = b - a, f = c - a, p = glm::cross(ray, f);
  const double det = glm::dot(e, p);
  if (std::abs(det) < 1e-18) return std::nullopt;
  const double u = -glm::dot(a, p) / det;
  const dvec3 q = glm::cross(-a, e);
  const double v = glm::dot(ray, q) / det, t = glm::dot(f, q) / det;
  if (u < 0.0 || v < 0.0 || u + v > 1.0 || t <= 0.0) return std::nullopt;
  return t;
}

/// A picture of a view's geometry with grass and without.
struct GrassPicture {
  GeometryPicture with;
  GeometryPicture without;

  [[nodiscard]] std::uint32_t width() const { return with.view.width; }
  [[nodiscard]] bool is_grass(std::size_t at) const { return with.depth[at] != without.depth[at]; }
  [[nodiscard]] std::size_t grass_pixels() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < with.depth.size(); ++i) count += is_grass(i) ? 1 : 0;
    return count;
  }
  [[nodiscard]] dvec3 world(std::size_t at) const {
    return with.view.position +
           with.position(static_cast<std::uint32_t>(at % width()), static_cast<std::uint32_t>(at / width()));
  }
};

/// Draws a view without grass, then a frame with it. The copies of the grass are of the latter.
[[nodiscard]] inline GrassPicture grass_picture(GrassStage& stage, const ViewSettings& view) {
  GrassPicture picture;
  ViewSettings bare = view;
  bare.without.push_back("grass");
  stage.draw(bare);
  picture.without = stage.geometry(view.id);
  stage.draw(view);
  picture.with = stage.geometry(view.id);
  return picture;
}

/// Size of a pixel at a point, metres.
[[nodiscard]] inline double pixel_at(const RenderView& view, const dvec3& point) {
  const double distance = view.camera.orthographic ? 1.0 : glm::length(point - view.position);
  return distance * 2.0 / (std::abs(static_cast<double>(view.clip_from_view[1][1])) * view.height);
}

/// Every pixel of grass must show a point on a blade. Rows are packed, which moves a blade by up to `slack_m`. Blades
/// narrower than a pixel are drawn one pixel wide.
inline void expect_grass_on_stems(const GrassPicture& picture, const std::vector<Stem>& stems, double widened = 1.0,
                                  double slack_m = 0.004) {
  std::size_t astray = 0;
  double farthest = 0.0;
  for (std::size_t i = 0; i < picture.with.depth.size(); ++i) {
    if (!picture.is_grass(i)) continue;
    const dvec3 point = picture.world(i);
    double best = std::numeric_limits<double>::infinity();
    const double pixel_m = pixel_at(picture.with.view, point);
    for (const Stem& stem : stems)
      best = std::min(best, stem.distance_to(point) - 0.5 * std::max(widened * stem.width_m, 1.06 * pixel_m));
    farthest = std::max(farthest, best);
    astray += best <= slack_m ? 0 : 1;
  }
  EXPECT_EQ(astray, 0u) << "of " << picture.grass_pixels() << " pixels; the farthest is " << farthest
                        << " m from all blades";
}

/// Pixels whose centre the middle of a blade's lower third covers, and those of them that show something farther away.
/// Without the places that are seen so nearly edge-on that they are narrower than a pixel: some of them are left out.
struct MissedPixels {
  std::size_t covered = 0;
  std::size_t missed = 0;
};
[[nodiscard]] inline MissedPixels missed_pixels(const GrassPicture& picture, const std::vector<Stem>& stems) {
  constexpr double kMiddle = 0.5;  // share of the width at the root, which a blade has at least in its lower third
  const RenderView& view = picture.with.view;
  MissedPixels found;
  const auto pixel_of = [&](const dvec3& p) {
    const dvec4 clip = dmat4(view.clip_from_relative) * dvec4(p, 1.0);
    return glm::dvec2((0.5 + 0.5 * clip.x / clip.w) * view.width, (0.5 - 0.5 * clip.y / clip.w) * view.height);
  };
  for (const Stem& stem : stems)
    for (std::size_t k = 1; k <= 5; ++k) {
      const dvec3 low = stem.at[k - 1] - view.position, high = stem.at[k] - view.position;
      const dvec3 half = 0.5 * kMiddle * stem.width_m * stem.side;
      const dvec3 corners[4] = {low - half, low + half, high + half, high - half};
      const glm::dvec2 along = glm::normalize(pixel_of(high) - pixel_of(low));
      const glm::dvec2 across = (pixel_of(low + half) - pixel_of(low - half)) / kMiddle;
      if (std::abs(across.x * along.y - across.y * along.x) < 1.3) continue;
      glm::dvec2 from(1e9), to(-1e9);
      for (const dvec3& corner : corners) {
        from = glm::min(from, pixel_of(corner));
        to = glm::max(to, pixel_of(corner));
      }
      for (int y = std::max(0, static_cast<int>(from.y));
           y <= std::min(static_cast<int>(view.height) - 1, static_cast<int>(to.y)); ++y)
        for (int x = std::max(0, static_cast<int>(from.x));
             x <= std::min(static_cast<int>(view.width) - 1, static_cast<int>(to.x)); ++x) {
          const auto px = static_cast<std::uint32_t>(x), py = static_cast<std::uint32_t>(y);
          const dvec3 ray = glm::normalize(surface_position(view, px, py, 0.5f));
          auto t = meets(ray, corners[0], corners[1], corners[2]);
          if (!t) t = meets(ray, corners[0], corners[2], corners[3]);
          if (!t) continue;
          ++found.covered;
          const std::size_t at = std::size_t{py} * view.width + px;
          const double seen = picture.with.is_sky(at) ? 1e9 : glm::length(picture.with.position(px, py));
          found.missed += seen > *t + 0.004 ? 1 : 0;
        }
    }
  return found;
}

}  // namespace gloam::test
