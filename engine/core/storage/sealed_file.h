// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace gloam {

/// Writes or replaces a file as a whole: readers see all of it or the old file, even if the writer is killed, several
/// processes write the same file, or the disk is full. Creates its folder. A link is followed. On an error nothing
/// changes. New files of the same target that killed writers have left beside it are removed.
[[nodiscard]] Status write_whole_file(const std::string& path, std::string_view bytes);

/// Removes the files that write_whole_file() has not renamed yet. For handlers of signals that end the process.
void remove_unfinished_files();

/// Writes a file with its identity and a checksum before the payload. `identity`: one line.
[[nodiscard]] Status write_sealed(const std::string& path, std::string_view identity, std::string_view payload);
/// Why a sealed file was not read.
enum class SealedFault : std::uint8_t {
  none,
  absent,
  not_a_file,  ///< a folder or a pipe
  unreadable,  ///< the system refuses
  damaged,     ///< or not a sealed file
  other,       ///< sound, with another identity
};
/// For the end of a sentence: "is damaged".
[[nodiscard]] std::string_view text_of(SealedFault fault);

/// The payload, if the file exists, is undamaged and has this identity. fault: gets the reason if there is none.
[[nodiscard]] std::optional<std::string> read_sealed(const std::string& path, std::string_view identity,
                                                     SealedFault* fault = nullptr);

/// A hash as sixteen hexadecimal digits, for file names.
[[nodiscard]] std::string hash_text(std::string_view text);

}  // namespace gloam
