// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/progress_bar.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

constexpr std::size_t kCells = 16;

std::string estimate(double left_s) {
  if (left_s < 1.0) return {};
  if (left_s < 90.0) return ", about " + std::to_string(std::lround(left_s)) + " s left";
  return ", about " + std::to_string(std::lround(left_s / 60.0)) + " min left";
}

}  // namespace

std::string progress_line(std::size_t done, std::size_t total, const std::string& what, std::size_t measured,
                          double elapsed_s) {
  const std::size_t filled = total == 0 ? kCells : std::min(done, total) * kCells / total;
  std::string line = "[" + std::string(filled, '#') + std::string(kCells - filled, '-') + "]  " + std::to_string(done) +
                     " of " + std::to_string(total) + "  " + what;
  if (measured == 0 || done >= total) return line;
  return line + estimate(elapsed_s / static_cast<double>(measured) * static_cast<double>(total - done));
}

}  // namespace gloam
