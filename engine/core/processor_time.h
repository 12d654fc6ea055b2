// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace gloam {

/// Processor time that all threads of this process have used, in ms. Other processes hardly change the time of the same
/// work, which they do to a clock on the wall.
[[nodiscard]] double processor_time_ms();

/// Processor cores that this process may run on, >= 1.
[[nodiscard]] std::uint32_t usable_cores();

}  // namespace gloam
