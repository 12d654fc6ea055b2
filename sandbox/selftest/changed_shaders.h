// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/types.h"

namespace gloam {

struct ChangedShader {
  const gpu::ShaderCode* shader = nullptr;  ///< the embedded one
  std::vector<std::uint32_t> words;
};

/// Compiles the shaders of a source tree that are, or include, a file that differs from the tree that the program was
/// built from. Error if either tree has no shaders, or with the compiler's message.
[[nodiscard]] Result<std::vector<ChangedShader>> compile_changed_shaders(const std::string& root);

}  // namespace gloam
