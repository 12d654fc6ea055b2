// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/registry.h"
#include "sandbox/bench/harness/report.h"
#include "sandbox/commands/commands.h"
#include "sandbox/output/file_io.h"
#include "sandbox/session/scene_loading.h"

namespace gloam {

Status run_bench(const CommandContext& context) {
  const Options& options = context.options;
  const BenchRegistry registry = make_bench_registry();
  if (options.list) {
    for (const BenchRow& row : registry.rows()) context.console.print(row.id + "\n");
    return {};
  }
  const auto chosen = registry.choose(options.names);
  if (!chosen) return chosen.error();
  GLOAM_TRY(check_scene_exists(options.scene));

  BenchContext bench(options, context.log);
  std::vector<MeasuredRow> measured;
  std::string missed;
  for (const BenchRow* row : *chosen) {
    auto value = row->run(bench);
    if (!value) return value.error();
    measured.push_back({.row = row, .value = std::move(value).value()});
    if (!holds(*row, measured.back().value.value)) missed += (missed.empty() ? "" : ", ") + row->id;
    if (!options.quiet) context.console.print(bench_line(measured.back()));
  }
  if (!options.json_file.empty()) {
    const RunDescription run = {
        .scene = options.scene, .device = bench.device_info(), .width = options.width, .height = options.height};
    GLOAM_TRY(make_folder_of(options.json_file));
    GLOAM_TRY(write_file(options.json_file, bench_json(run, measured)));
  }
  if (options.strict && !missed.empty()) return Error{ErrorKind::failed, "bars missed: " + missed};
  return {};
}

}  // namespace gloam
