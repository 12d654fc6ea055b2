// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "sandbox/options.h"

namespace gloam {

enum class EntryState { waiting, done, failed };

struct SummaryEntry {
  std::string name;  ///< ListEntry::name
  std::string text;  ///< ListEntry::text
  EntryState state = EntryState::waiting;
  std::string error;  ///< of a failed entry
};

/// What one shard of a sweep has measured: a file beside the measurements, written again after each.
struct ShardSummary {
  std::string list;       ///< path as the user gave it
  std::string list_hash;  ///< of the list's content
  Shard shard;
  std::vector<SummaryEntry> entries;  ///< of the whole list: those of other shards wait
};

/// DIR/shards/LIST_HASH-I-of-N.json
[[nodiscard]] std::string summary_path(const std::string& folder, const ShardSummary& summary);

/// JSON, schema version 1.
[[nodiscard]] std::string summary_json(const ShardSummary& summary);
/// An error of ErrorKind::input names the fault.
[[nodiscard]] Result<ShardSummary> parse_summary(std::string_view text);

}  // namespace gloam
