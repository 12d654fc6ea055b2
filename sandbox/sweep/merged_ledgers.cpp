// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/sweep/merged_ledgers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace gloam {
namespace {

auto place_of(const LedgerHeader& header) {
  return std::tie(header.host, header.device, header.driver, header.subgroup_size, header.version, header.build);
}

void add(const FoundLedger& found, MergedLedgers& merged) {
  const auto same_place = [&](const LedgerGroup& group) {
    return place_of(group.header()) == place_of(found.ledger.header);
  };
  const auto group = std::ranges::find_if(merged.groups, same_place);
  if (group == merged.groups.end()) {
    merged.groups.push_back({{&found}});
    return;
  }
  for (const FoundLedger*& kept : group->ledgers) {
    if (kept->name != found.name || kept->ledger.header != found.ledger.header) continue;
    const bool better = found.ledger.rows.size() > kept->ledger.rows.size();
    merged.duplicates.push_back(better ? kept->folder + " is left out: " + found.folder + " has more rows of the same"
                                       : found.folder + " is left out: " + kept->folder + " is the same measurement");
    if (better) kept = &found;
    return;
  }
  group->ledgers.push_back(&found);
}

/// Shards and entries of one list.
void add_missing(std::span<const ShardSummary* const> shards, const std::set<std::string>& found,
                 std::vector<std::string>& missing) {
  const ShardSummary& first = *shards.front();
  std::set<std::uint32_t> seen;
  std::map<std::string, std::string> errors;
  for (const ShardSummary* shard : shards) {
    seen.insert(shard->shard.number);
    for (const SummaryEntry& entry : shard->entries)
      if (entry.state == EntryState::failed) errors[entry.name] = entry.error;
  }
  for (std::uint32_t number = 1; number <= first.shard.count; ++number)
    if (!seen.contains(number))
      missing.push_back("shard " + std::to_string(number) + "/" + std::to_string(first.shard.count) + " of " +
                        first.list);
  for (std::size_t i = 0; i < first.entries.size(); ++i) {
    const SummaryEntry& entry = first.entries[i];
    if (found.contains(entry.name)) continue;
    const auto error = errors.find(entry.name);
    missing.push_back("entry '" + entry.text + "' of " + first.list + ", in shard " +
                      std::to_string(i % first.shard.count + 1) + "/" + std::to_string(first.shard.count) +
                      (error == errors.end() ? "" : ", which failed: " + error->second));
  }
}

}  // namespace

MergedLedgers merge_ledgers(std::span<const FoundLedger> found, std::span<const ShardSummary> summaries) {
  MergedLedgers merged;
  std::set<std::string> names;
  for (const FoundLedger& ledger : found) {
    add(ledger, merged);
    names.insert(ledger.name);
  }
  for (LedgerGroup& group : merged.groups)
    std::ranges::stable_sort(group.ledgers, {}, [](const FoundLedger* ledger) { return ledger->name; });
  std::map<std::pair<std::string, std::uint32_t>, std::vector<const ShardSummary*>> lists;
  for (const ShardSummary& summary : summaries) lists[{summary.list_hash, summary.shard.count}].push_back(&summary);
  for (const auto& [list, shards] : lists) add_missing(shards, names, merged.missing);
  return merged;
}

std::vector<ValueSummary> summarize_values(const LedgerGroup& group) {
  std::vector<ValueSummary> values;
  std::map<std::pair<std::string, std::string>, std::size_t> index;
  for (const FoundLedger* found : group.ledgers) {
    for (const LedgerRow& row : found->ledger.rows) {
      const auto [at, added] = index.try_emplace({row.knob, row.value}, values.size());
      if (added) values.push_back({.knob = row.knob, .value = row.value, .mean_ratio = 0.0, .worst_ratio = row.ratio});
      ValueSummary& value = values[at->second];
      ++value.ledgers;
      value.mean_ratio += std::log(row.ratio);
      value.worst_ratio = std::max(value.worst_ratio, row.ratio);
      if (row.flip && (!value.worst_flip || row.flip->mean > *value.worst_flip)) {
        value.worst_flip = row.flip->mean;
        value.worst_in = found->name;
      }
    }
  }
  for (ValueSummary& value : values) value.mean_ratio = std::exp(value.mean_ratio / static_cast<double>(value.ledgers));
  return values;
}

}  // namespace gloam
