// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/numbered_path.h"

#include <algorithm>

namespace gloam {

std::string NumberedPath::of(std::uint32_t number) const {
  std::string text = std::to_string(number);
  if (text.size() < digits) text.insert(0, digits - text.size(), '0');
  return before + text + after;
}

std::optional<NumberedPath> numbered_path(std::string_view path) {
  for (std::size_t at = path.find('%'); at != std::string_view::npos; at = path.find('%', at + 1)) {
    const std::string_view after_percent = path.substr(at + 1);
    std::size_t digits = 0, length = 1;
    if (after_percent.size() >= 3 && after_percent[0] == '0' && after_percent[1] >= '1' && after_percent[1] <= '9') {
      digits = static_cast<std::size_t>(after_percent[1] - '0');
      length = 3;
    }
    if (after_percent.size() >= length && after_percent[length - 1] == 'd')
      return NumberedPath{std::string(path.substr(0, at)), digits, std::string(after_percent.substr(length))};
  }
  return std::nullopt;
}

}  // namespace gloam
