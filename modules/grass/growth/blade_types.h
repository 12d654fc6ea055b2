// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/math/types.h"
#include "shaders/grass/grass_shared.h"

namespace gloam {

/// One blade type: the shape of its stem at rest, and how often growth picks it. The format of files is documented at
/// the head of builtin_blade_types_text().
struct BladeType {
  std::string name;
  float share = 1.0f;         ///< probability times the sum of all shares, > 0
  float length_scale = 1.0f;  ///< factor on GrassSurface::height_m
  float width_scale = 1.0f;   ///< factor on GrassSurface::width_m
  float stiffness = 0.5f;     ///< 0…1
  float taper = 0.1f;         ///< width at the tip over width at the root, 0…1
  float damping = 1.0f;       ///< factor on GrassSurface::damping, 0…100
  std::vector<vec2> points;   ///< control points of the stem: forward, up; the first is (0, 0); up ≥ 0
};

/// Reads 1…16 types, one a line. `file` names the text in errors, which also name the line.
[[nodiscard]] Result<std::vector<BladeType>> parse_blade_types(std::string_view text, std::string_view file);
[[nodiscard]] Result<std::vector<BladeType>> read_blade_types(const std::string& path);

/// The built-in five types, as a file.
[[nodiscard]] std::string_view builtin_blade_types_text();
[[nodiscard]] std::vector<BladeType> builtin_blade_types();

/// Samples the stem at `count` ≥ 2 knots (forward, up) with equal distances, so that its length is 1. The curve of the
/// control points is a quadratic B-spline: it begins at the first and ends at the last, and bends sharply at a point
/// that is given twice. No knot is below 0.
[[nodiscard]] std::vector<glm::dvec2> stem_knots(const BladeType& type, std::size_t count);
/// The stem at 16 knots, 1/15 apart, and what else the GPU reads of a type. damping: GrassSurface::damping.
[[nodiscard]] shaders::GrassTypeRow blade_type_row(const BladeType& type, float damping = 1.5f);

}  // namespace gloam
