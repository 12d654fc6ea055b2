// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace gloam {

/// Reads a whole file. Errors are of `kind` and name the path.
[[nodiscard]] Result<std::string> read_text_file(const std::string& path, ErrorKind kind);

/// Creates or replaces a file as a whole (write_whole_file), or writes to a device or a pipe. Paths of the standard
/// streams (/dev/stdout, /dev/stderr) and links to them write to the streams that the program was started with. Returns
/// ErrorKind::failed, naming the path, if not all bytes could be written; an old file is then still there.
[[nodiscard]] Status write_file(const std::string& path, std::string_view bytes);

/// Creates the folder that contains `path`, with its parents.
[[nodiscard]] Status make_folder_of(const std::string& path);

}  // namespace gloam
