// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace gloam {

/// Writes or replaces a file as a whole: readers see all of it or the old file, even if the writer is killed, several
/// processes write the same file, or the disk is full. Creates its folder. A link is followed. On an error nothing
/// changes. New files of the same target that killed writers have left beside it are removed.
[[nodiscard]] Status write_whole_file(const std::string& path, std::string_view bytes);

/// Writes a file with its identity and a checksum before the payload. `identity`: one line.
[[nodiscard]] Status write_sealed(const std::string& path, std::string_view identity, std::string_view payload);
/// The payload, if the file exists, is undamaged and has this identity.
[[nodiscard]] std::optional<std::string> read_sealed(const std::string& path, std::string_view identity);

/// A hash as sixteen hexadecimal digits, for file names.
[[nodiscard]] std::string hash_text(std::string_view text);

}  // namespace gloam
