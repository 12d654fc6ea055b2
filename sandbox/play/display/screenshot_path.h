// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace gloam {

/// The first out/<scene>-NNN.png that does not exist, from 001 on.
[[nodiscard]] std::string screenshot_path(const std::string& scene);

}  // namespace gloam
