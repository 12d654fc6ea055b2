// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/gpu/types.h"

namespace gloam::gpu {

/// How description_hash identifies a shader.
enum class ShaderIdentity : std::uint8_t {
  address,  ///< by the address of its words: fast, valid while the words live
  words,    ///< by its words: equal in all processes
};

/// A hash of everything that decides what a pipeline does: shaders, constants, formats and states. Names and modules do
/// not count.
[[nodiscard]] std::uint64_t description_hash(const ComputePipelineDesc& desc, ShaderIdentity identity);
[[nodiscard]] std::uint64_t description_hash(const GraphicsPipelineDesc& desc, ShaderIdentity identity);

}  // namespace gloam::gpu
