// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "modules/accuracy/module.h"

namespace gloam {

/// A row and the frames of the default that were timed beside it; none for a row of the default, and none if another
/// row that was timed with it has them.
struct TimedRow {
  LedgerRow row;
  std::vector<FrameCost> standard;
  bool operator==(const TimedRow&) const = default;
};

/// One row as JSON on one line, and back. Parse errors are of ErrorKind::input.
[[nodiscard]] std::string row_json(const TimedRow& measured);
[[nodiscard]] Result<TimedRow> parse_row_json(std::string_view text);

}  // namespace gloam
