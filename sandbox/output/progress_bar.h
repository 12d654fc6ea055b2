// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace gloam {

/// "[######----------]  3 of 8  WHAT, about 2 min left". elapsed_s: what the first `measured` of them took, which the
/// estimate goes by; none yet, or little left: no estimate.
[[nodiscard]] std::string progress_line(std::size_t done, std::size_t total, const std::string& what,
                                        std::size_t measured, double elapsed_s);

}  // namespace gloam
