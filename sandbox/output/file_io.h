// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace gloam {

/// The whole file. Errors name the path; their kind is `kind`.
[[nodiscard]] Result<std::string> read_text_file(const std::string& path, ErrorKind kind);

/// Writes or replaces a file. ErrorKind::failed, naming the path, when any of it cannot be written.
[[nodiscard]] Status write_file(const std::string& path, std::string_view bytes);

/// Makes the folder that `path` lies in, with its parents.
[[nodiscard]] Status make_folder_of(const std::string& path);

}  // namespace gloam
