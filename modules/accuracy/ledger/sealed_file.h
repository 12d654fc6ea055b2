// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace gloam {

/// Writes or replaces a file as a whole: who reads it sees all of it or the old one, also when the writer is killed.
/// Makes its folder.
[[nodiscard]] Status write_whole_file(const std::string& path, std::string_view bytes);

/// A file that knows what it is of: `identity` and a checksum stand before the payload. identity: one line.
[[nodiscard]] Status write_sealed(const std::string& path, std::string_view identity, std::string_view payload);
/// The payload, if the file exists, is undamaged and is of this identity.
[[nodiscard]] std::optional<std::string> read_sealed(const std::string& path, std::string_view identity);

/// Sixteen hexadecimal digits, for names of files.
[[nodiscard]] std::string hash_text(std::string_view text);

}  // namespace gloam
