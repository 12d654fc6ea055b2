// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/result.h"
#include "engine/core/text/plain_text.h"

namespace gloam::gltf {

/// Place of an element in messages: `node 12 "torch-03"`.
[[nodiscard]] inline std::string place(std::string_view what, std::size_t index, std::string_view name = {}) {
  std::string text = std::string(what) + " " + std::to_string(index);
  if (!name.empty()) text += " " + in_quotes(name);
  return text;
}

/// Input error "place: fault". import_gltf puts the file's name in front.
[[nodiscard]] inline Error fault_at(const std::string& where, const std::string& fault) {
  return {ErrorKind::input, where + ": " + fault};
}

}  // namespace gloam::gltf
