// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "engine/math/types.h"

namespace gloam {

/// A mark over the picture, below the panel. Places in pixels of the window.
struct PanelMark {
  enum class Shape : std::uint8_t { line, square, circle, cross };
  Shape shape = Shape::line;
  glm::dvec2 from = glm::dvec2(0.0);  ///< or the middle
  glm::dvec2 to = glm::dvec2(0.0);    ///< of a line
  std::array<std::uint8_t, 3> color = {255, 255, 255};
  std::string label = {};  ///< beside it
};

}  // namespace gloam
