// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The standard filter of a spot light's shadow map, run alone by the kernel that generates visibilities, and what all
// texels of the map hide of the light in double precision.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/math/types.h"
#include "engine/render/kernel_check/kernel_lab.h"

namespace gloam {

/// A spot light 4 m above a floor, plates between them that are parallel to it, and a view of the floor.
struct FilterScene {
  /// Texels of the map that show a plate at this distance from the light.
  struct Plate {
    double depth_m = 2.0;
    uvec2 begin;
    uvec2 end;
  };
  static constexpr std::uint32_t kMapSide = 256;     ///< texels
  static constexpr std::uint32_t kPictureSide = 96;  ///< pixels
  static constexpr double kFloor_m = 4.0;            ///< distance of the floor from the light
  static constexpr double kTanHalf = 0.5;            ///< of the map

  double width_m = 0.1;  ///< of the light
  std::vector<Plate> plates;

  /// Distance from the light of what a texel of the map shows.
  [[nodiscard]] double depth_at(uvec2 texel) const;
  /// A pixel's point of the floor, from the point below the light: along the map's columns and rows, metres.
  [[nodiscard]] static glm::dvec2 floor_at(uvec2 pixel);
  /// Whether the light's cone holds the pixel with its surroundings.
  [[nodiscard]] static bool in_cone(uvec2 pixel);
  /// The part of the light's disc that the pixel sees: of 512 points of the disc, those that no texel hides.
  [[nodiscard]] double seen_share(uvec2 pixel) const;
};

/// Visibilities of all pixels, row by row, as the kernel stores them: in steps of 1/255.
[[nodiscard]] Result<std::vector<double>> run_filter(const KernelLab& lab, const FilterScene& scene);

}  // namespace gloam
