// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/stability.h"
#include "sandbox/commands/commands.h"
#include "sandbox/output/file_io.h"
#include "sandbox/selftest/run.h"
#include "sandbox/session/loading/kept_selftest.h"

namespace gloam {
namespace {

Status write_report(const std::string& folder, const StabilityReport& report) {
  const std::string json = folder + "/selftest.json";
  GLOAM_TRY(make_folder_of(json));
  GLOAM_TRY(write_file(json, stability_json(report)));
  return write_file(folder + "/selftest.html", stability_html(report));
}

}  // namespace

Status run_selftest_command(const CommandContext& context) {
  const Options& options = context.options;
  if (options.list) {
    const auto checks = chosen_checks(options);
    if (!checks) return checks.error();
    if (options.markdown) {
      std::vector<StabilityCheck> listed;
      for (const SelfTestCheck& own : *checks) listed.push_back(own.check);
      context.console.print(limits_table(listed));
      return {};
    }
    for (const SelfTestCheck& own : *checks) context.console.print(own.check.name + ": " + own.check.sentence + "\n");
    return {};
  }
  const auto report = run_selftest(options, context.log, [&](const StabilityCheck& check) {
    if (!options.quiet || !holds(check)) context.console.print(stability_line(check));
  });
  if (!report) return report.error();
  const std::size_t failed = failed_checks(*report);
  context.console.print(formatted("%s: %zu of %zu checks hold, %.0f s\n", report->device.c_str(),
                                  report->checks.size() - failed, report->checks.size(), report->seconds));
  if (!options.out.empty()) GLOAM_TRY(write_report(options.out, *report));
  // Of the program as it is: reports of gloam cost show it.
  const bool is_own = options.only.empty() && options.shaders.empty() && options.assignments.empty();
  if (is_own) GLOAM_TRY(keep_selftest(*report, options));
  if (failed == 0) return {};
  return Error{ErrorKind::failed, formatted("%zu of %zu checks failed", failed, report->checks.size())};
}

}  // namespace gloam
