// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "modules/accuracy/outputs.h"

namespace gloam {

/// One row as JSON on one line, and back. Parse errors are of ErrorKind::input.
[[nodiscard]] std::string row_json(const LedgerRow& row);
[[nodiscard]] Result<LedgerRow> parse_row_json(std::string_view text);

}  // namespace gloam
