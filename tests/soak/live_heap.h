// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace gloam::soak {

/// Bytes that operator new has given and operator delete has not taken back. live_heap.cpp replaces both for all
/// libraries in the process, and tells by the caller whose they are.
struct LiveHeap {
  std::int64_t program = 0;    ///< of gloam and the program, which are linked into one file
  std::int64_t libraries = 0;  ///< of shared libraries: the driver, its compiler, the validation layer
};
[[nodiscard]] LiveHeap live_heap();

}  // namespace gloam::soak
