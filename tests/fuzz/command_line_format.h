// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/fuzz/target.h"

namespace gloam::fuzz {

/// Command lines, one argument a line.
[[nodiscard]] Format command_line_format();

}  // namespace gloam::fuzz
