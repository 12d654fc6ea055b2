// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>

namespace gloam {

/// An environment variable; nothing when it is absent or empty. Programs and tests read these at start and pass the
/// values on: engine systems take parameters instead. Not safe beside a thread that changes the environment.
[[nodiscard]] inline std::optional<std::string> environment_text(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr || *text == '\0') return std::nullopt;
  return std::string(text);
}

/// The same as a number; nothing unless the whole text is one, written with a decimal point in every locale.
[[nodiscard]] inline std::optional<double> environment_number(const char* name) {
  const std::optional<std::string> text = environment_text(name);
  if (!text) return std::nullopt;
  double number = 0.0;
  const char* end = text->data() + text->size();
  const auto [rest, fault] = std::from_chars(text->data(), end, number);
  if (fault != std::errc() || rest != end) return std::nullopt;
  return number;
}

}  // namespace gloam
