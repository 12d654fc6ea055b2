// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Files of blade types (gloam.grass.types).
#include <cmath>
#include <cstdio>
#include <string>

#include "modules/grass/growth/blade_types.h"
#include "tests/fuzz/target.h"

namespace gloam::fuzz {
namespace {

/// The types as a file, with all digits. Names are numbers: those that were read may hold blanks.
std::string written(const std::vector<BladeType>& types) {
  std::string text;
  int number_of_type = 1;
  const auto add = [&text](const char* before, float number) {
    char digits[40];
    std::snprintf(digits, sizeof(digits), "%s%.9g", before, static_cast<double>(number));
    text += digits;
  };
  for (const BladeType& type : types) {
    text += std::to_string(number_of_type++);
    for (const float number : {type.share, type.length_scale, type.width_scale, type.stiffness, type.taper})
      add(" ", number);
    add(" damping=", type.damping);
    for (const vec2& point : type.points) {
      add(" ", point.x);
      add(",", point.y);
    }
    text += "\n";
  }
  return text;
}

/// Knots lie above the ground, at equal distances, on a stem of length 1.
std::string knot_fault(const BladeType& type) {
  for (const std::size_t count : {std::size_t{2}, std::size_t{16}}) {
    const std::vector<glm::dvec2> knots = stem_knots(type, count);
    if (knots.size() != count) return "a stem has another number of knots";
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(knots[i].x) || !std::isfinite(knots[i].y)) return "a knot is not finite";
      if (knots[i].y < 0.0) return "a knot is below the ground";
      if (i > 0 && glm::length(knots[i] - knots[i - 1]) > 1.0 / static_cast<double>(count - 1) + 1e-6)
        return "knots are farther apart than along the stem";
    }
  }
  return {};
}

std::string row_fault(const BladeType& type) {
  const shaders::GrassTypeRow row = blade_type_row(type);
  static_assert(sizeof(row) % sizeof(float) == 0);
  const auto* numbers = reinterpret_cast<const float*>(&row);
  for (std::size_t i = 0; i < sizeof(row) / sizeof(float); ++i)
    if (!std::isfinite(numbers[i])) return "a number for the GPU is not finite";
  return {};
}

Outcome read_blades(Input input) {
  const auto types = parse_blade_types(text_of(input), "blades.txt");
  if (!types) return refused(types.error(), ErrorKind::input, "blades.txt");
  if (types->empty() || types->size() > GLOAM_GRASS_TYPES) return broken("the number of types is out of range");
  for (const BladeType& type : *types) {
    if (std::string fault = knot_fault(type); !fault.empty()) return broken(std::move(fault));
    if (std::string fault = row_fault(type); !fault.empty()) return broken(std::move(fault));
  }
  const std::string text = written(*types);
  const auto again = parse_blade_types(text, "blades.txt");
  if (!again) return broken("is refused when it is written again: " + again.error().message + "\n" + text);
  if (written(*again) != text) return broken("is another one when it is written again: " + text);
  return accepted();
}

std::vector<Bytes> blade_files() {
  return {bytes_of(builtin_blade_types_text()), bytes_of("a 1 1 1 0.5 0.1 0,0 0,1\n"),
          bytes_of("a 1 2 0.5 0 1 damping=3 0,0 0.5,0.5 0.5,0.5 1,0\n# comment\n\tb 2 1 1 1 0 0,0 1e-3,0\r\n")};
}

std::vector<std::string> blade_words() {
  return {"#",  "\n",    " ",     "\t",      ",",    "0,0",   "0,1",   "damping=", "nan",   "inf",
          "-0", "1e-45", "1e-38", "100,100", "1e-3", "0x1p3", "1e400", "+1",       "0.001", "100"};
}

}  // namespace

Target blades_target() { return {"blades", {{"blade types", read_blades, blade_files, blade_words}}}; }

}  // namespace gloam::fuzz
