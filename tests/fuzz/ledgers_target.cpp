// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Files of measurements that gloam reads back: ledgers, rows of them, self-tests, and the files of sweeps.
#include <set>
#include <string>

#include "modules/accuracy/ledger/row_json.h"
#include "modules/accuracy/outputs.h"
#include "modules/accuracy/stability.h"
#include "sandbox/sweep/scene_list.h"
#include "sandbox/sweep/shard_summary.h"
#include "tests/fuzz/target.h"
#include "tests/modules/accuracy/ledger_rows.h"

namespace gloam::fuzz {
namespace {

/// What was read must be the same when it is written and read again. write, parse: functions of the format.
template <class Write, class Parse>
Outcome check_written(Input input, const Write& write, const Parse& parse) {
  const auto read = parse(text_of(input));
  if (!read) return refused(read.error(), ErrorKind::input);
  const std::string text = write(*read);
  const auto again = parse(text);
  if (!again) return broken("is refused when it is written again: " + again.error().message);
  if (write(*again) != text) return broken("is another one when it is written again");
  return accepted();
}

Outcome read_ledger(Input input) {
  if (const auto ledger = parse_ledger_json(text_of(input)); ledger) {
    // What readers of a ledger make of it.
    static_cast<void>(ledger_table(*ledger) + points_table(*ledger) + ledger_csv(*ledger) + points_csv(*ledger));
    static_cast<void>(front_points(*ledger));
  }
  return check_written(input, ledger_json, parse_ledger_json);
}

Outcome read_row(Input input) { return check_written(input, row_json, parse_row_json); }

Outcome read_stability(Input input) {
  if (const auto report = parse_stability_json(text_of(input)); report)
    for (const StabilityCheck& check : report->checks) {
      const auto range = range_within_bound(check);
      if (range && !(range->low <= range->high)) return broken("a range is empty");
      if (stability_line(check).find('\n') == std::string::npos) return broken("a line does not end");
    }
  return check_written(input, stability_json, parse_stability_json);
}

Outcome read_summary(Input input) { return check_written(input, summary_json, parse_summary); }

Outcome read_scene_list(Input input) {
  const auto entries = parse_scene_list(text_of(input), "folder/list.txt");
  if (!entries) return refused(entries.error(), ErrorKind::input, "folder/list.txt:");
  std::set<std::string> names;
  std::size_t line = 0;
  for (const ListEntry& entry : *entries) {
    if (entry.scene.empty()) return broken("an entry has no scene");
    if (entry.name.find_first_of("/\n") != std::string::npos) return broken("a name is no folder's: " + entry.name);
    if (!names.insert(entry.name).second) return broken("two entries have the name " + entry.name);
    if (entry.line <= line) return broken("lines do not ascend");
    line = entry.line;
  }
  return accepted();
}

std::vector<Bytes> ledgers() {
  Ledger small = test::full_ledger();
  small.points.resize(1);
  small.rows.resize(1);
  return {bytes_of(ledger_json(small)), bytes_of(ledger_json(test::full_ledger())), bytes_of(ledger_json({}))};
}

std::vector<Bytes> rows() {
  return {bytes_of(row_json(test::measured(2))), bytes_of(row_json(test::measured(5))),
          bytes_of(row_json({.row = test::bare_row(), .standard = {}}))};
}

std::vector<Bytes> stability_reports() {
  StabilityReport report = {.gloam = "1", .device = "a device", .driver = "2", .device_type = "cpu", .host = "h"};
  report.checks.push_back({.name = "moved.lamp", .sentence = "a and b", .unit = "of 255", .bound = 1.0, .worst = 0.5});
  report.checks.push_back({.name = "curve", .kind = StabilityKind::curve, .bound = 0.1, .axis = "distance, m"});
  report.checks.back().promised = {1.0, 4.0};
  report.checks.back().curve = {{0.5, 0.2}, {1.0, 0.05}, {2.0, 0.06}, {8.0, 0.3}};
  report.checks.push_back({.name = "broken", .fault = "a fault"});
  return {bytes_of(stability_json(report)), bytes_of(stability_json({}))};
}

std::vector<Bytes> summaries() {
  ShardSummary summary = {.list = "list.txt", .list_hash = "0123456789abcdef", .shard = {2, 3}};
  summary.entries = {{"a-1", "a.glb --size 2x2", EntryState::done, {}},
                     {"b-2", "b.glb", EntryState::failed, "b.glb: cannot be read"},
                     {"c-3", "c.glb", EntryState::waiting, {}}};
  return {bytes_of(summary_json(summary))};
}

std::vector<Bytes> scene_lists() {
  return {bytes_of("builtin:dusk --camera street\n# a comment\n\n'a b.glb' --config \"k.json\" --size 320x180\n"),
          bytes_of("a.gltf\r\na.gltf --config=k.json # again\n/b/c.glb\n")};
}

std::vector<std::string> json_words() {
  return with_json_signs({"\"",
                          "1e308",
                          "1e-320",
                          "\"\\u0000\"",
                          "\"\\ud83d\\ude00\"",
                          "18446744073709551615",
                          "4294967296",
                          "\"rows\"",
                          "\"points\"",
                          "\"settings\"",
                          "\"cameras\"",
                          "\"model\"",
                          "\"counted\"",
                          "\"worst\"",
                          "\"checks\"",
                          "\"promised\"",
                          "\"entries\"",
                          "\"state\"",
                          "\"psnr_db\"",
                          "\"ratio_interval\"",
                          "\"error\"",
                          "\"version\""});
}

std::vector<std::string> list_words() {
  return {"builtin:", "--out", "--config", "--config=", "#", "'", "\"", "\n", "\r", " ", "/", "..", "-"};
}

}  // namespace

Target ledgers_target() {
  return {"ledgers",
          {{"ledger", read_ledger, ledgers, json_words},
           {"row", read_row, rows},
           {"self-test", read_stability, stability_reports},
           {"summary", read_summary, summaries},
           {"scene list", read_scene_list, scene_lists, list_words}}};
}

}  // namespace gloam::fuzz
