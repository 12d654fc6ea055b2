// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/core/log.h"

namespace gloam {

/// The last of the dropped files that is a scene; empty if there is none. Warns of each file that is none.
[[nodiscard]] std::string dropped_scene(const std::vector<std::string>& paths, LogSink& log);

}  // namespace gloam
