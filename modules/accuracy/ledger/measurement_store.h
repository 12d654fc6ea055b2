// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "engine/core/result.h"
#include "modules/accuracy/outputs.h"

namespace gloam {

/// Finished rows in a folder, one file each, so that an interrupted run goes on where it was. A row is found again only
/// under all that it was measured under: the caller's `identity`, one line.
class MeasurementStore {
 public:
  explicit MeasurementStore(std::string folder) : folder_(std::move(folder)) {}

  /// Files that are absent, damaged or of something else are nothing.
  [[nodiscard]] std::optional<LedgerRow> load(const std::string& identity) const;
  [[nodiscard]] Status save(const std::string& identity, const LedgerRow& row) const;
  [[nodiscard]] std::string path_of(const std::string& identity) const;

 private:
  std::string folder_;
};

}  // namespace gloam
