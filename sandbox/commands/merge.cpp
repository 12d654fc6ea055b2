// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "sandbox/commands/sweep.h"
#include "sandbox/output/file_io.h"
#include "sandbox/sweep/merged_ledgers.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// The paths in a folder, sorted. Empty if the folder cannot be read.
std::vector<fs::path> sorted_paths(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code failed;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
    paths.push_back(at->path());
  std::ranges::sort(paths);
  return paths;
}

struct Found {
  std::vector<FoundLedger> ledgers;
  std::vector<ShardSummary> summaries;
};

/// Adds the folder's own ledger, if it has one.
Status add_ledger(const fs::path& folder, Found& found) {
  const std::string path = (folder / "ledger.json").string();
  std::error_code absent;
  if (!fs::exists(path, absent)) return {};
  const auto text = read_text_file(path, ErrorKind::input);
  if (!text) return text.error();
  auto ledger = parse_ledger_json(*text);
  if (!ledger) return Error{ledger.error().kind, path + " " + ledger.error().message};
  const fs::path named = folder.has_filename() ? folder : folder.parent_path();
  found.ledgers.push_back({named.filename().string(), folder.string(), std::move(ledger).value()});
  return {};
}

Status add_folder(const std::string& folder, Found& found) {
  std::error_code absent;
  if (!fs::is_directory(folder, absent)) return Error{ErrorKind::input, folder + " is no folder"};
  const std::size_t before = found.ledgers.size();
  GLOAM_TRY(add_ledger(folder, found));
  for (const fs::path& entry : sorted_paths(folder))
    if (fs::is_directory(entry, absent)) GLOAM_TRY(add_ledger(entry, found));
  for (const fs::path& path : sorted_paths(fs::path(folder) / "shards")) {
    if (path.extension() != ".json") continue;
    const auto text = read_text_file(path.string(), ErrorKind::input);
    if (!text) return text.error();
    auto summary = parse_summary(*text);
    if (!summary) return Error{summary.error().kind, path.string() + " " + summary.error().message};
    found.summaries.push_back(std::move(summary).value());
  }
  if (found.ledgers.size() > before) return {};
  return Error{ErrorKind::input, folder + " has no ledgers: no ledger.json in it or in a folder below it"};
}

}  // namespace

Status run_merge(const CommandContext& context) {
  Found found;
  std::set<fs::path> seen;
  for (const std::string& folder : context.options.merge) {
    // A folder that is named twice counts once.
    std::error_code failed;
    if (seen.insert(fs::weakly_canonical(folder, failed)).second) GLOAM_TRY(add_folder(folder, found));
  }
  const MergedLedgers merged = merge_ledgers(found.ledgers, found.summaries);
  const std::string& out = context.options.out;
  GLOAM_TRY(make_folder_of(out + "/sweep.json"));
  GLOAM_TRY(write_file(out + "/sweep.json", merged_json(merged)));
  GLOAM_TRY(write_file(out + "/sweep.csv", merged_csv(merged)));
  GLOAM_TRY(write_file(out + "/index.html", merged_page(merged, out)));
  for (const std::string& line : merged.missing) context.console.print_warning("missing: " + line);
  for (const std::string& line : merged.duplicates) context.console.print_warning("duplicate: " + line);
  if (context.options.quiet) return {};
  std::size_t ledgers = 0;
  for (const LedgerGroup& group : merged.groups) ledgers += group.ledgers.size();
  context.console.print(std::to_string(ledgers) + " ledgers in " + std::to_string(merged.groups.size()) +
                        (merged.groups.size() == 1 ? " group" : " groups") + " of one host, device and build\nwrote " +
                        out + "/index.html, sweep.json and sweep.csv\n");
  return {};
}

}  // namespace gloam
