// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gloam::gpu::spirv {

/// The module with each branch that uniforms and constants alone decide made to depend on an input too, which changes
/// no result. Mesa's lavapipe (22.3) puts the values of uniform blocks and push constants into such branches as
/// constants, and if that removes half of a shader, it compiles the shader anew in each frame: milliseconds to a second
/// for one dispatch. Whether it does depends on the values, such as the size of the picture. An input is a value that
/// it does not know. words: a valid module of one vertex, fragment or compute shader. Empty if there is no such branch:
/// use the module as it is then.
[[nodiscard]] std::vector<std::uint32_t> hide_uniform_conditions(std::span<const std::uint32_t> words);

}  // namespace gloam::gpu::spirv
