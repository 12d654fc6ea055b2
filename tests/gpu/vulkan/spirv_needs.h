// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>

namespace gloam::test {

struct SpirvNeeds {
  std::set<std::string> features;  ///< names of Vulkan's feature flags
  std::set<std::string> unknown;   ///< capabilities and extensions whose features the tables do not hold
};

/// The Vulkan features that a valid SPIR-V module needs: by its capabilities, extensions and execution modes, by
/// buffers and images that other stages than compute write, and by block layouts that the rules without
/// scalarBlockLayout forbid. Vulkan specification 1.3, "Offset and Stride Assignment" and appendix "Vulkan Environment
/// for SPIR-V".
[[nodiscard]] SpirvNeeds find_spirv_needs(std::span<const std::uint32_t> words);

}  // namespace gloam::test
