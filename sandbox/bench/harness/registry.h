// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gloam {

class BenchContext;

/// What running a bench gave.
struct BenchValue {
  double value = 0.0;
  std::optional<double> p10;
  std::optional<double> p90;
  std::optional<std::string> hash;   ///< of what was computed, so that a fast wrong answer shows
  std::optional<std::string> scene;  ///< it was measured on, where that is not the run's
};

enum class Better { lower, higher };

/// One thing that can be measured.
struct BenchRow {
  std::string id;             ///< "jobs.empty"; unique
  std::string unit;           ///< "ms", "ratio", "ns/entity", "bytes"
  std::optional<double> bar;  ///< what the value is held against; none: it only informs
  Better better = Better::lower;
  std::function<Result<BenchValue>(BenchContext&)> run;
};

class BenchRegistry {
 public:
  /// Asserts on an id that is there already.
  void add(BenchRow row);
  /// In the order of adding.
  [[nodiscard]] const std::vector<BenchRow>& rows() const { return rows_; }
  /// Rows whose id is a name or starts with a name and a dot, in the order of adding, each once. A name that chooses
  /// nothing is a usage error.
  [[nodiscard]] Result<std::vector<const BenchRow*>> choose(std::span<const std::string> names) const;

 private:
  std::vector<BenchRow> rows_;
};

/// Whether a value keeps its row's bar; true without one.
[[nodiscard]] bool holds(const BenchRow& row, double value);

/// Every bench of the program.
[[nodiscard]] BenchRegistry make_bench_registry();

}  // namespace gloam
