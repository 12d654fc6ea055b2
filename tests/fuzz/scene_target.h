// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/fuzz/target.h"

namespace gloam::fuzz {

/// Imports the bytes as a scene file with the scene keys of all modules, and runs the scene's systems once.
[[nodiscard]] Outcome load_scene_bytes(Input bytes);

}  // namespace gloam::fuzz
