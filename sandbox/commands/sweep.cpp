// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/commands/sweep.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/storage/sealed_file.h"
#include "sandbox/output/file_io.h"
#include "sandbox/sweep/scene_list.h"
#include "sandbox/sweep/shard_summary.h"

namespace gloam {
namespace {

/// The options of one entry: shared ones, then those of its line.
Result<Options> options_of(const ListEntry& entry, const Options& sweep) {
  std::vector<std::string> arguments = {"cost", entry.scene};
  arguments.insert(arguments.end(), sweep.shared_arguments.begin(), sweep.shared_arguments.end());
  arguments.insert(arguments.end(), entry.arguments.begin(), entry.arguments.end());
  arguments.insert(arguments.end(), {"--out", sweep.out + "/" + entry.name});
  auto parsed = parse_options(arguments, "", RepeatedOptions::last);
  const std::string place = sweep.scene_list + ":" + std::to_string(entry.line) + ": ";
  if (!parsed) return Error{ErrorKind::input, place + parsed.error().message};
  if (!std::holds_alternative<Options>(*parsed))
    return Error{ErrorKind::input, place + "--help and --version are no options of a scene"};
  return std::get<Options>(std::move(parsed).value());
}

/// Errors of the machine, which every other entry would have, too.
bool stops_all(const Error& error) { return error.kind == ErrorKind::no_device; }

}  // namespace

Status run_sweep(const CommandContext& context) {
  const Options& sweep = context.options;
  const auto text = read_text_file(sweep.scene_list, ErrorKind::input);
  if (!text) return text.error();
  const auto list = parse_scene_list(*text, sweep.scene_list);
  if (!list) return list.error();
  ShardSummary summary = {.list = sweep.scene_list, .list_hash = hash_text(*text), .shard = sweep.shard, .entries = {}};
  std::vector<Options> options;
  for (const ListEntry& entry : *list) {
    auto own = options_of(entry, sweep);
    if (!own) return own.error();
    options.push_back(std::move(own).value());
    summary.entries.push_back({.name = entry.name, .text = entry.text});
  }
  const std::string path = summary_path(sweep.out, summary);
  GLOAM_TRY(make_folder_of(path));
  GLOAM_TRY(write_file(path, summary_json(summary)));

  std::optional<Error> first;
  std::size_t failed = 0;
  std::size_t measured = 0;
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (!in_shard(sweep.shard, i)) continue;
    SummaryEntry& entry = summary.entries[i];
    if (!sweep.quiet)
      context.console.print("entry " + std::to_string(i + 1) + " of " + std::to_string(options.size()) + ": " +
                            entry.text + "\n");
    const Status status = measure_scene(
        {.options = options[i], .console = context.console, .log = context.log, .device = context.device});
    if (!status.ok() && stops_all(status.error())) return status;
    entry.state = status.ok() ? EntryState::done : EntryState::failed;
    ++(status.ok() ? measured : failed);
    if (!status.ok()) {
      entry.error = status.error().message;
      if (!first)
        first = Error{status.error().kind,
                      sweep.scene_list + ":" + std::to_string((*list)[i].line) + ": " + status.error().message};
    }
    GLOAM_TRY(write_file(path, summary_json(summary)));
  }
  if (first)
    return Error{first->kind, std::to_string(failed) + " of " + std::to_string(measured + failed) +
                                  " entries failed; the first: " + first->message};
  if (!sweep.quiet) context.console.print("wrote " + path + ": " + std::to_string(measured) + " entries are done\n");
  return {};
}

}  // namespace gloam
