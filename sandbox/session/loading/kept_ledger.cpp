// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/kept_ledger.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/core/text/formatted.h"
#include "sandbox/output/file_io.h"
#include "sandbox/output/identity.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

std::string device_folder(const Options& options, const std::string& device) {
  return options.cache_dir + "/ledgers/" +
         formatted("%016llx", static_cast<unsigned long long>(Hasher().text(device).digest()));
}

Result<LedgerFile> read_ledger(const std::string& path) {
  const auto text = read_text_file(path, ErrorKind::input);
  if (!text) return text.error();
  auto ledger = parse_ledger_json(*text);
  if (!ledger) return Error{ledger.error().kind, path + " " + ledger.error().message};
  if (ledger->points.empty())
    return Error{ErrorKind::input, path + " has no combinations to choose from: measure it with gloam cost --points N"};
  return LedgerFile{std::move(ledger).value(), path};
}

bool exists(const std::string& path) {
  std::error_code fault;
  return !path.empty() && fs::is_regular_file(path, fault);
}

/// The files in the folder, beginning with the one that was written last.
std::vector<std::string> newest_first(const std::string& folder) {
  std::vector<std::pair<fs::file_time_type, std::string>> files;
  std::error_code fault;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end; entry.increment(fault)) {
    std::error_code unknown;
    const auto written = entry->last_write_time(unknown);
    if (!unknown && entry->path().extension() == ".json") files.emplace_back(written, entry->path().string());
  }
  std::ranges::sort(files, std::greater());
  std::vector<std::string> paths;
  for (auto& [written, path] : files) paths.push_back(std::move(path));
  return paths;
}

/// A ledger of the cache folder. One that cannot be read is as if it were not there: the next measurement replaces it.
std::optional<LedgerFile> read_kept(const std::string& path, LogSink& log) {
  auto found = read_ledger(path);
  if (found) return std::move(found).value();
  log.warning(found.error().message + "; it is not used");
  return std::nullopt;
}

std::size_t measured_knobs(const Ledger& ledger) {
  std::set<std::string_view> names;
  for (const LedgerRow& row : ledger.rows) names.insert(row.knob);
  return names.size();
}

/// Whether the kept ledger tells more: it is of the same program, and has rows of more knobs.
bool tells_more(const std::string& kept, const Ledger& ledger) {
  if (!exists(kept)) return false;
  const auto before = read_ledger(kept);
  return before && before->ledger.header.build == ledger.header.build &&
         measured_knobs(before->ledger) > measured_knobs(ledger);
}

}  // namespace

std::string ledger_beside(const std::string& scene) {
  if (is_builtin(scene)) return {};
  return fs::path(scene).replace_extension(".ledger.json").string();
}

Status keep_ledger(const Ledger& ledger, const Options& options) {
  if (options.cache_dir.empty() || ledger.points.empty()) return {};
  const std::string path = device_folder(options, ledger.header.device) + "/" + ledger.header.scene_hash + ".json";
  if (tells_more(path, ledger)) return {};
  GLOAM_TRY(make_folder_of(path));
  return write_file(path, ledger_json(ledger));
}

Result<std::optional<LedgerFile>> find_own_ledger(const Session& session, const Options& options, LogSink& log) {
  std::string path;
  if (!options.ledger.empty()) {
    std::error_code fault;
    path = fs::is_directory(options.ledger, fault) ? options.ledger + "/ledger.json" : options.ledger;
  } else if (const std::string beside = ledger_beside(options.scene); exists(beside)) {
    path = beside;
  } else if (!options.cache_dir.empty()) {
    const std::string kept =
        device_folder(options, session.device->info().name) + "/" + scene_hash(options.scene, session.world) + ".json";
    return exists(kept) ? read_kept(kept, log) : std::nullopt;
  }
  if (path.empty()) return std::optional<LedgerFile>();
  auto found = read_ledger(path);
  if (!found) return found.error();
  return std::optional<LedgerFile>(std::move(found).value());
}

Result<LedgerFile> find_ledger(const Session& session, const Options& options, LogSink& log) {
  auto own = find_own_ledger(session, options, log);
  if (!own) return own.error();
  if (*own) return std::move(**own);
  if (!options.cache_dir.empty())
    for (const std::string& other : newest_first(device_folder(options, session.device->info().name)))
      if (auto found = read_ledger(other)) return found;
  return Error{ErrorKind::usage, "--budget needs a ledger of this device: measure one with gloam cost " +
                                     options.scene + " --quick --out DIR, or name one with --ledger"};
}

}  // namespace gloam
