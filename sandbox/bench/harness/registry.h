// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"

namespace gloam {

class BenchContext;

/// The result of a bench.
struct BenchValue {
  double value = 0.0;
  std::optional<double> p10;
  std::optional<double> p90;
  std::optional<std::string> hash;   ///< of the computed data, so that a fast wrong answer shows
  std::optional<std::string> scene;  ///< scene of the measurement, if it is not the run's scene
  bool informs = false;              ///< the row's bar is not for this device: the value only informs
  /// Reason why nothing could be measured here (a scene file is missing). The other members mean nothing then, and the
  /// bar counts as kept.
  std::optional<std::string> skipped;
};

[[nodiscard]] inline BenchValue skipped_row(std::string reason) {
  BenchValue value;
  value.skipped = std::move(reason);
  return value;
}

enum class Better { lower, higher };

/// A figure of a paper that stands beside ours.
struct PaperFigure {
  double value = 0.0;
  std::string unit;  ///< with the machine: "ms on a console"
};

/// One bench.
struct BenchRow {
  std::string id;             ///< "jobs.empty"; unique
  std::string unit;           ///< "ms", "ratio", "ns/entity", "bytes"
  std::optional<double> bar;  ///< limit that the value must keep; none: the value only informs
  Better better = Better::lower;
  std::string heading;  ///< of the table that the row belongs to; empty: none
  std::optional<PaperFigure> paper;
  std::function<Result<BenchValue>(BenchContext&)> run;
};

class BenchRegistry {
 public:
  /// Asserts that no row has the same id.
  void add(BenchRow row);
  /// All rows, in the order of adding.
  [[nodiscard]] const std::vector<BenchRow>& rows() const { return rows_; }
  /// Rows whose id is a name or starts with a name and a dot, in the order of adding, each once. A name that chooses
  /// nothing is a usage error.
  [[nodiscard]] Result<std::vector<const BenchRow*>> choose(std::span<const std::string> names) const;

 private:
  std::vector<BenchRow> rows_;
};

/// Whether the row's bar applies to a measured value.
[[nodiscard]] bool has_bar(const BenchRow& row, const BenchValue& value);

/// Whether a value keeps its row's bar; true without one.
[[nodiscard]] bool keeps_bar(const BenchRow& row, double value);

/// Every bench of the program.
[[nodiscard]] BenchRegistry make_bench_registry();

}  // namespace gloam
