// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>

namespace gloam {

/// Value of an environment variable; nullopt if it is absent or empty. Programs and tests read variables at start and
/// pass the values on; engine systems take parameters instead. Not safe while another thread changes the environment.
[[nodiscard]] inline std::optional<std::string> environment_text(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr || *text == '\0') return std::nullopt;
  return std::string(text);
}

/// Value of an environment variable as a number; nullopt unless the whole text is a number. The decimal separator is a
/// point in every locale.
[[nodiscard]] inline std::optional<double> environment_number(const char* name) {
  const std::optional<std::string> text = environment_text(name);
  if (!text) return std::nullopt;
  double number = 0.0;
  const char* end = text->data() + text->size();
  const auto [number_end, fault] = std::from_chars(text->data(), end, number);
  if (fault != std::errc() || number_end != end) return std::nullopt;
  return number;
}

}  // namespace gloam
