// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/sweep/shard_summary.h"

#include <nlohmann/json.hpp>

#include "engine/core/text/plain_text.h"
#include "sandbox/output/json_text.h"
#include "sandbox/sweep/scene_list.h"

namespace gloam {
namespace {

constexpr const char* kStates[] = {"waiting", "done", "failed"};

EntryState state_of(const std::string& name) {
  if (name == "done") return EntryState::done;
  return name == "failed" ? EntryState::failed : EntryState::waiting;
}

/// 0, which no shard has, for what is no whole number of 32 bits: the library would cast it without a defined result.
std::uint32_t number_of(const Json& json) {
  const bool fits = json.is_number_unsigned() && json.get<std::uint64_t>() <= 0xffffffffu;
  return fits ? json.get<std::uint32_t>() : 0;
}

ShardSummary summary_of(const Json& json) {
  ShardSummary summary = {.list = json.at("list").get<std::string>(),
                          .list_hash = json.at("list_hash").get<std::string>(),
                          .shard = {number_of(json.at("shard")), number_of(json.at("shards"))}};
  for (const Json& entry : json.at("entries"))
    summary.entries.push_back({entry.at("name").get<std::string>(), entry.at("text").get<std::string>(),
                               state_of(entry.at("state").get<std::string>()), entry.value("error", std::string())});
  return summary;
}

}  // namespace

std::string summary_path(const std::string& folder, const ShardSummary& summary) {
  return folder + "/shards/" + summary.list_hash + "-" + std::to_string(summary.shard.number) + "-of-" +
         std::to_string(summary.shard.count) + ".json";
}

std::string summary_json(const ShardSummary& summary) {
  Json json = {{"version", 1},
               {"list", summary.list},
               {"list_hash", summary.list_hash},
               {"shard", summary.shard.number},
               {"shards", summary.shard.count},
               {"entries", Json::array()}};
  for (std::size_t i = 0; i < summary.entries.size(); ++i) {
    const SummaryEntry& entry = summary.entries[i];
    Json item = {{"name", entry.name}, {"text", entry.text}, {"in_shard", in_shard(summary.shard, i)}};
    item["state"] = kStates[static_cast<std::size_t>(entry.state)];
    if (!entry.error.empty()) item["error"] = entry.error;
    json["entries"].push_back(std::move(item));
  }
  return json_text(json);
}

Result<ShardSummary> parse_summary(std::string_view text) {
  try {
    const Json json = Json::parse(text);
    if (number_of(json.at("version")) != 1)
      return Error{ErrorKind::input, "is a shard's summary of another version; this program reads version 1"};
    ShardSummary summary = summary_of(json);
    if (summary.shard.number >= 1 && summary.shard.number <= summary.shard.count) return summary;
    return Error{ErrorKind::input, "is no summary of a shard: its shard is not in 1…N"};
  } catch (const Json::exception& fault) {
    return Error{ErrorKind::input, "is no summary of a shard: " + one_line(fault.what(), 300)};
  }
}

}  // namespace gloam
