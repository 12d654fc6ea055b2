// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <spirv/unified1/spirv.hpp>

namespace gloam::test {

/// Calls visit(opcode, words of the instruction) for each instruction of a module.
template <class Visit>
void for_each_instruction(std::span<const std::uint32_t> words, const Visit& visit) {
  constexpr std::size_t kHeaderWords = 5;
  for (std::size_t at = kHeaderWords; at < words.size(); at += words[at] >> spv::WordCountShift)
    visit(words[at] & spv::OpCodeMask, words.subspan(at, words[at] >> spv::WordCountShift));
}

}  // namespace gloam::test
