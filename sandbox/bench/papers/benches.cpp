// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/papers/tables.h"

namespace gloam {

void add_paper_benches(BenchRegistry& registry) {
  std::vector<BenchRow> made;
  for (const PaperTable& table : paper_tables()) {
    for (const PaperRow& paper : table.rows) {
      const auto measure = std::ranges::find(registry.rows(), std::string(paper.measure), &BenchRow::id);
      GLOAM_ASSERT(measure != registry.rows().end(), "a row of a paper's table names a bench");
      BenchRow row = *measure;
      row.id = std::string("papers.") + table.id + "." + paper.id;
      row.bar.reset();  // the measured row has it
      row.heading = table.heading;
      if (paper.figure) row.paper = PaperFigure{*paper.figure, paper.unit};
      made.push_back(std::move(row));
    }
  }
  for (BenchRow& row : made) registry.add(std::move(row));
}

}  // namespace gloam
