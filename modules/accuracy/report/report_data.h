// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "modules/accuracy/module.h"

namespace gloam {

/// The rows of one knob.
struct KnobResults {
  std::string name;
  std::string meaning;                  ///< may be empty
  std::vector<const LedgerRow*> rows;   ///< at least one
  const LedgerRow* standard = nullptr;  ///< the default's row; null: it has none
  /// Pictures of all values are equal, and no difference in time is significant.
  bool no_effect = false;
};

/// A value that takes significantly less time than its default.
struct Saving {
  const LedgerRow* row = nullptr;
  const LedgerRow* standard = nullptr;
};

/// The first screen: one value at most for each knob and list, the greatest saving first.
struct Savings {
  std::vector<Saving> no_less_right;  ///< FLIP no greater than the default's
  std::vector<Saving> below_001;      ///< mean FLIP below 0.01; not in the list above
  std::vector<Saving> below_003;      ///< mean FLIP below 0.03; not in the lists above
};

/// A ledger and its pictures, prepared for the sections. The ledger must outlive it.
struct ReportData {
  const Ledger& ledger;
  std::string command;
  std::vector<KnobMeaning> meanings;
  std::vector<KnobResults> knobs;  ///< in the order of the ledger
  Savings savings;
  const StabilityReport* stability = nullptr;  ///< null: no self-test of the device is known
  const LedgerPoint* users = nullptr;          ///< the user's own settings; null: no combinations were measured
  /// The fastest combination that is significantly faster than the user's and whose error is below 0.01, or no greater
  /// than that of the user's; or else below 0.03. Null: there is none.
  const LedgerPoint* recommended = nullptr;
  /// Name and data: URI of all pictures, the most important first.
  std::vector<std::pair<std::string, std::string>> pictures;
  std::vector<std::string> linked;  ///< names of all pictures in the folder, sorted

  [[nodiscard]] bool has_picture(std::string_view name) const;
};

[[nodiscard]] ReportData report_data(const Ledger& ledger, const ReportRequest& request);

}  // namespace gloam
