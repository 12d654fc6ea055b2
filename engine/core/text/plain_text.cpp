// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/text/plain_text.h"

#include <algorithm>

namespace gloam {

namespace {

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u; }

/// Size in bytes of the UTF-8 character at the front; 0 if there is no valid one.
std::size_t character_size(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t size = first < 0x80   ? 1
                           : first < 0xc2 ? 0
                           : first < 0xe0 ? 2
                           : first < 0xf0 ? 3
                           : first < 0xf5 ? 4
                                          : 0;
  if (size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i)
    if (!is_continuation(text[i])) return 0;
  return size;
}

}  // namespace

std::string one_line(std::string_view text, std::size_t max_bytes) {
  std::string line;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    if (line.size() + std::max<std::size_t>(size, 1) > max_bytes) return line + "…";
    if (size == 0)
      line += '?';
    else if (size == 1 && (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7f))
      line += ' ';
    else
      line += text.substr(0, size);
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return line;
}

std::string in_quotes(std::string_view text) { return "\"" + one_line(text) + "\""; }

}  // namespace gloam
