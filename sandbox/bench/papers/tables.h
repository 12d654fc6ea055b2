// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

namespace gloam {

/// A row of a paper's table beside a row of ours.
struct PaperRow {
  const char* id;       ///< "papers." and the table's id are put before it
  const char* measure;  ///< id of the bench that measures it here
  /// The paper's figure; none: the paper shows it in a picture only, or says nothing.
  std::optional<double> figure = std::nullopt;
  const char* unit = "";  ///< of `figure`, with the machine: "ms on PS5"
};

/// A table or figure of a paper, or figures that its text states.
struct PaperTable {
  const char* id;
  const char* heading;
  std::span<const PaperRow> rows;
};

/// All tables, in the order of the papers.
[[nodiscard]] std::span<const PaperTable> paper_tables();

}  // namespace gloam
