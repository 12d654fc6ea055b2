// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace gloam::fuzz {

struct LoadOutcome {
  bool loaded = false;
  std::string error;  ///< the loader's message, if it refused the input
  std::string fault;  ///< the loader broke its promise: no input error, or not one sentence that names the file
};

/// Imports the bytes as a scene file with the scene keys of all modules, and runs the scene's systems once. The bytes
/// are first written to scene_path(), so that the input is there after a crash.
[[nodiscard]] LoadOutcome load_bytes(std::span<const std::uint8_t> bytes);

/// Path of the file that load_bytes writes.
[[nodiscard]] const std::string& scene_path();

}  // namespace gloam::fuzz
