// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "sandbox/output/json_text.h"
#include "sandbox/sweep/merged_ledgers.h"

namespace gloam {
namespace {

Json json_of(const ValueSummary& value) {
  Json json = {{"knob", value.knob},
               {"value", value.value},
               {"ledgers", value.ledgers},
               {"ratio", {{"mean", value.mean_ratio}, {"worst", value.worst_ratio}}}};
  if (value.worst_flip) json["flip"] = {{"worst", *value.worst_flip}, {"in", value.worst_in}};
  return json;
}

Json json_of(const LedgerGroup& group) {
  const LedgerHeader& header = group.header();
  Json json = {{"host", header.host},     {"device", header.device},
               {"driver", header.driver}, {"gloam", {{"version", header.version}, {"build", header.build}}},
               {"values", Json::array()}, {"ledgers", Json::array()}};
  for (const ValueSummary& value : summarize_values(group)) json["values"].push_back(json_of(value));
  for (const FoundLedger* found : group.ledgers)
    json["ledgers"].push_back(
        {{"name", found->name}, {"folder", found->folder}, {"ledger", Json::parse(ledger_json(found->ledger))}});
  return json;
}

/// In quotes (RFC 4180).
std::string csv_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\",";
}

}  // namespace

std::string merged_json(const MergedLedgers& merged) {
  Json json = {{"version", 1},
               {"complete", merged.missing.empty()},
               {"missing", merged.missing},
               {"duplicates", merged.duplicates},
               {"groups", Json::array()}};
  for (const LedgerGroup& group : merged.groups) json["groups"].push_back(json_of(group));
  return json_text(json);
}

std::string merged_csv(const MergedLedgers& merged) {
  const std::string columns = ledger_csv({});
  std::string text = "group,name,scene,scene_hash,width,height,host,device,driver,build," + columns;
  for (std::size_t group = 0; group < merged.groups.size(); ++group) {
    for (const FoundLedger* found : merged.groups[group].ledgers) {
      const LedgerHeader& header = found->ledger.header;
      const std::string place = std::to_string(group + 1) + "," + csv_text(found->name) + csv_text(header.scene) +
                                csv_text(header.scene_hash) + std::to_string(header.width) + "," +
                                std::to_string(header.height) + "," + csv_text(header.host) + csv_text(header.device) +
                                csv_text(header.driver) + csv_text(header.build);
      for (const LedgerRow& row : found->ledger.rows)
        text += place + ledger_csv({.header = header, .rows = {row}, .skipped = {}}).substr(columns.size());
    }
  }
  return text;
}

}  // namespace gloam
