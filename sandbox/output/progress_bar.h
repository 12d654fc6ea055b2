// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace gloam {

/// "[######----------]  3 of 8  WHAT, about 2 min left". The estimate gives each remaining item the mean time elapsed_s
/// / measured. measured: number of items that took elapsed_s; resumed items do not count. No estimate if measured is 0,
/// all items are done, or less than 1 s is left.
[[nodiscard]] std::string progress_line(std::size_t done, std::size_t total, const std::string& what,
                                        std::size_t measured, double elapsed_s);

}  // namespace gloam
