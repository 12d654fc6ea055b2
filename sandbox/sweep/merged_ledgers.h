// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "modules/accuracy/outputs.h"
#include "sandbox/sweep/shard_summary.h"

// The ledgers of several folders of a sweep, put together.

namespace gloam {

/// A ledger that was found below a folder of a sweep.
struct FoundLedger {
  std::string name;    ///< of its own folder: ListEntry::name
  std::string folder;  ///< path of its own folder
  Ledger ledger;
};

/// Ledgers whose times may be compared: of one host, device and build.
struct LedgerGroup {
  std::vector<const FoundLedger*> ledgers;  ///< at least one, sorted by name
  [[nodiscard]] const LedgerHeader& header() const { return ledgers.front()->ledger.header; }
};

/// One value of a knob, over all ledgers of a group.
struct ValueSummary {
  std::string knob;
  std::string value;
  std::size_t ledgers = 0;
  double mean_ratio = 1.0;  ///< geometric mean of LedgerRow::ratio
  double worst_ratio = 1.0;
  std::optional<double> worst_flip;  ///< highest mean FLIP
  std::string worst_in;              ///< name of the ledger with worst_flip
};

struct MergedLedgers {
  std::vector<LedgerGroup> groups;
  std::vector<std::string> duplicates;  ///< sentences: a ledger that is left out, and the kept one
  std::vector<std::string> missing;     ///< sentences: shards without a summary, entries without a ledger
};

/// found and summaries must outlive the result. Of ledgers of one name and equal headers, the one with the most rows is
/// kept, and of those the first.
[[nodiscard]] MergedLedgers merge_ledgers(std::span<const FoundLedger> found, std::span<const ShardSummary> summaries);

/// In the order in which the group's ledgers first name them.
[[nodiscard]] std::vector<ValueSummary> summarize_values(const LedgerGroup& group);

/// Texts of the merged files. folder: where the page will lie, for its links.
[[nodiscard]] std::string merged_json(const MergedLedgers& merged);
[[nodiscard]] std::string merged_csv(const MergedLedgers& merged);
[[nodiscard]] std::string merged_page(const MergedLedgers& merged, const std::string& folder);

}  // namespace gloam
