// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace gloam::soak {

/// Bytes that operator new has given to this process and operator delete has not taken back, by all libraries in it:
/// live_heap.cpp replaces both.
[[nodiscard]] std::int64_t live_heap_bytes();

}  // namespace gloam::soak
