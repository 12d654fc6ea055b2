// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#if defined(__GNUC__)
#define GLOAM_PRINTF_FORMAT __attribute__((format(printf, 1, 2)))
#else
#define GLOAM_PRINTF_FORMAT
#endif

namespace gloam {

/// The text that std::printf would print in the "C" locale: the decimal separator is a point, whatever locale the host
/// has set. std::snprintf, std::to_string of a floating-point number and streams follow the host's locale instead.
[[nodiscard]] GLOAM_PRINTF_FORMAT std::string formatted(const char* format, ...);

}  // namespace gloam
