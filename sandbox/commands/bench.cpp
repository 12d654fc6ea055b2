// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <span>
#include <string>

#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/registry.h"
#include "sandbox/bench/harness/report.h"
#include "sandbox/bench/harness/run_rows.h"
#include "sandbox/commands/commands.h"
#include "sandbox/output/file_io.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

Status write_rows(const Options& options, const gpu::DeviceInfo& device, std::span<const MeasuredRow> rows) {
  if (options.json_file.empty()) return {};
  const RunDescription run = {
      .scene = options.scene, .device = device, .width = options.width, .height = options.height};
  GLOAM_TRY(make_folder_of(options.json_file));
  return write_file(options.json_file, bench_json(run, rows));
}

}  // namespace

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
  std::string missed, heading;
  const RowsRun run = run_rows(*chosen, bench, [&](const MeasuredRow& measured) {
    if (!measured.value.skipped && has_bar(*measured.row, measured.value) &&
        !keeps_bar(*measured.row, measured.value.value))
      missed += (missed.empty() ? "" : ", ") + measured.row->id;
    if (options.quiet) return;
    if (measured.row->heading != heading && !measured.row->heading.empty())
      context.console.print("\n" + measured.row->heading + "\n");
    heading = measured.row->heading;
    context.console.print(bench_line(measured));
  });
  // Write the file even if a row failed, because the rows before it are finished. The failure then decides the exit
  // code.
  const Status written = write_rows(options, bench.device_info(), run.rows);
  GLOAM_TRY(run.status);
  GLOAM_TRY(written);
  if (options.strict && !missed.empty()) return Error{ErrorKind::failed, "bars missed: " + missed};
  return {};
}

}  // namespace gloam
