// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tests/fuzz/target.h"

namespace gloam::fuzz {

/// Small sound scene files, .gltf and .glb, that together use every part of the loader.
[[nodiscard]] std::vector<Bytes> scene_seeds();

}  // namespace gloam::fuzz
