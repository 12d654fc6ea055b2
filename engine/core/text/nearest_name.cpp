// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/text/nearest_name.h"

#include <algorithm>
#include <vector>

namespace gloam {
namespace {

constexpr std::size_t kLongestName = 100;  // bytes; bounds the time that a hostile name can take

char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_letter(char a, char b) { return lower_case(a) == lower_case(b); }

/// Greatest number of edits that counts as a typing mistake: a third of a short name's length, and a smaller share of a
/// long name's, because long names share prefixes.
std::size_t allowed_edits(std::size_t length) { return std::min(length / 3, 2 + length / 8); }

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same_letter(a[i - 1], b[j - 1]) ? 0u : 1u)});
      if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

std::string_view nearest_name(std::string_view wanted, std::span<const std::string> names) {
  if (wanted.size() > kLongestName) return {};
  std::string_view nearest;
  std::size_t fewest = kLongestName;
  for (const std::string& name : names) {
    const std::size_t longer = std::max(wanted.size(), name.size());
    const std::size_t allowed = allowed_edits(longer);
    if (longer - std::min(wanted.size(), name.size()) > allowed) continue;
    const std::size_t distance = edit_distance(wanted, name);
    if (distance > allowed || distance >= fewest) continue;
    fewest = distance;
    nearest = name;
  }
  return nearest;
}

std::string did_you_mean(std::string_view wanted, std::span<const std::string> names) {
  const std::string_view nearest = nearest_name(wanted, names);
  return nearest.empty() ? std::string() : "did you mean " + std::string(nearest) + "? ";
}

std::string valid_names(std::string_view wanted, std::span<const std::string> names) {
  std::string list;
  for (const std::string& name : names) {
    if (!list.empty()) list += ", ";
    list += name;
  }
  return did_you_mean(wanted, names) + "there are " + (names.empty() ? "none" : list);
}

}  // namespace gloam
