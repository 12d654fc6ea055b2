// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "engine/core/result.h"
#include "modules/accuracy/ledger/row_json.h"

namespace gloam {

/// Finished rows in a folder, one file each, so that an interrupted run can resume. A row is found only under the same
/// `identity`: one line, from the caller, with everything the row depends on.
class MeasurementStore {
 public:
  explicit MeasurementStore(std::string folder) : folder_(std::move(folder)) {}

  /// None if the file is absent, damaged or of another identity.
  [[nodiscard]] std::optional<TimedRow> load(const std::string& identity) const;
  [[nodiscard]] Status save(const std::string& identity, const TimedRow& row) const;
  [[nodiscard]] std::string path_of(const std::string& identity) const;

 private:
  std::string folder_;
};

}  // namespace gloam
