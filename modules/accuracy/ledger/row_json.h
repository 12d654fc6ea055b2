// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "modules/accuracy/module.h"

namespace gloam {

/// A row and the frames of the default that were timed beside it; none for a row of the default.
struct MeasuredRow {
  LedgerRow row;
  std::vector<FrameCost> standard;
  bool operator==(const MeasuredRow&) const = default;
};

/// One row as JSON on one line, and back. Parse errors are of ErrorKind::input.
[[nodiscard]] std::string row_json(const MeasuredRow& measured);
[[nodiscard]] Result<MeasuredRow> parse_row_json(std::string_view text);

}  // namespace gloam
