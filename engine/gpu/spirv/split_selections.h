// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gloam::gpu::spirv {

/// Ifs with an else in a module, those of a function once for each of its calls: a compiler that walks all paths
/// through a loop may come to the blocks behind them 2^count times. 0 for a module that is not valid, or has an
/// OpSwitch.
[[nodiscard]] std::uint64_t count_selections(std::span<const std::uint32_t> words);

/// The module with each if that has an else as two ifs, the second of which asks for the opposite: no two paths of
/// equal length join then. The result computes the same. words: a valid module. Empty if there is none, or an OpSwitch.
[[nodiscard]] std::vector<std::uint32_t> split_selections(std::span<const std::uint32_t> words);

}  // namespace gloam::gpu::spirv
