// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace gloam {

/// How a light casts shadows. A light without this component casts them with these defaults.
struct ShadowCaster {
  bool enabled = true;
  std::uint32_t resolution = 0;  ///< texels of a face's side; 0: chosen from screen coverage
};

}  // namespace gloam
