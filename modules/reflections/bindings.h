// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "engine/render/declare/shader_pass.h"

namespace gloam {

/// Uploads rows as storage; one default row if there are none, because a binding is never empty.
template <class T>
void bind_rows(ShaderPass& pass, std::string_view binding, std::span<const T> rows) {
  const T none[1] = {};
  pass.items(binding, rows.empty() ? std::span<const T>(none) : rows);
}

}  // namespace gloam
