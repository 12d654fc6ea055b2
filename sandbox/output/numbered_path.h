// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gloam {

/// A path with a place for a number: "frame_%04d.png" is frame_0000.png, frame_0001.png, …
struct NumberedPath {
  std::string before;
  std::size_t digits = 0;  ///< at least; zeros are put before shorter numbers
  std::string after;

  [[nodiscard]] std::string of(std::uint32_t number) const;
};

/// Empty if the path has no %d or %0Nd, N in 1…9. Only the first one is a place for the number.
[[nodiscard]] std::optional<NumberedPath> numbered_path(std::string_view path);

}  // namespace gloam
