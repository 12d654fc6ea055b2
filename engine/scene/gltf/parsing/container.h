// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gloam::gltf {

/// A .gltf or .glb file in memory. `binary`: it is a .glb, by its first bytes and not by its name.
struct Container {
  std::vector<std::uint8_t> bytes;
  bool binary = false;
  bool has_binary_chunk = false;
  std::size_t json_offset = 0;
  std::size_t json_size = 0;
  std::size_t length = 0;  ///< bytes that belong to the file; a .glb may have more behind them

  [[nodiscard]] std::string_view json() const {
    return {reinterpret_cast<const char*>(bytes.data()) + json_offset, json_size};
  }
};

/// Finds the JSON text in the bytes of a file. Checks the length of every chunk of a .glb. An error's message holds
/// only the fault, not the place.
[[nodiscard]] Result<Container> open_container(std::vector<std::uint8_t> bytes);

}  // namespace gloam::gltf
