// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/decoding/jpeg_segments.h"

#include <algorithm>
#include <cstddef>

namespace gloam {
namespace {

// Markers of ISO/IEC 10918-1, table B.1.
constexpr std::uint8_t kHuffmanTables = 0xc4;
constexpr std::uint8_t kFirstRestart = 0xd0;
constexpr std::uint8_t kLastRestart = 0xd7;
constexpr std::uint8_t kEndOfImage = 0xd9;
constexpr std::uint8_t kStartOfScan = 0xda;

/// Whether each table of a segment has at most 256 codes. A table states how many codes it has of each of 16 lengths.
bool tables_fit(std::span<const std::uint8_t> file, std::size_t begin, std::size_t end) {
  constexpr std::size_t kLengths = 16;
  for (std::size_t at = begin; at < end;) {
    std::size_t codes = 0;
    for (std::size_t i = at + 1; i <= at + kLengths && i < file.size(); ++i) codes += file[i];
    if (codes > 256) return false;
    at += 1 + kLengths + codes;
  }
  return true;
}

}  // namespace

Result<std::uint32_t> count_jpeg_scans(std::span<const std::uint8_t> file) {
  std::uint32_t scans = 0;
  std::size_t at = 2;
  while (at + 3 < file.size()) {
    // Inside a scan, 0xff is followed by 0, by a restart marker, or by the marker of the next segment.
    const std::uint8_t marker = file[at + 1];
    if (file[at] != 0xff || marker == 0xff) {
      ++at;
      continue;
    }
    at += 2;
    if (marker == 0 || (marker >= kFirstRestart && marker <= kLastRestart)) continue;
    if (marker == kEndOfImage) break;
    const std::size_t length = std::size_t{file[at]} << 8 | file[at + 1];
    if (marker == kHuffmanTables && !tables_fit(file, at + 2, std::min(at + length, file.size())))
      return Error{ErrorKind::input, "is a damaged image (a Huffman table has more than 256 codes)"};
    if (marker == kStartOfScan) ++scans;
    at += std::max<std::size_t>(length, 2);
  }
  return std::max(scans, 1u);
}

}  // namespace gloam
