// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/kept_selftest.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "engine/core/hash.h"
#include "engine/core/text/formatted.h"
#include "sandbox/output/file_io.h"

namespace gloam {
namespace {

std::string selftest_file(const Options& options, const std::string& device, const std::string& driver) {
  const auto hash = static_cast<unsigned long long>(Hasher().text(device).text(driver).digest());
  return options.cache_dir + "/selftests/" + formatted("%016llx.json", hash);
}

}  // namespace

Status keep_selftest(const StabilityReport& report, const Options& options) {
  if (options.cache_dir.empty()) return {};
  const std::string path = selftest_file(options, report.device, report.driver);
  GLOAM_TRY(make_folder_of(path));
  return write_file(path, stability_json(report));
}

std::optional<StabilityReport> find_selftest(const Options& options, const std::string& device,
                                             const std::string& driver, LogSink& log) {
  if (options.cache_dir.empty()) return std::nullopt;
  const std::string path = selftest_file(options, device, driver);
  std::error_code fault;
  if (!std::filesystem::exists(path, fault)) return std::nullopt;
  const auto text = read_text_file(path, ErrorKind::input);
  auto report = text ? parse_stability_json(*text) : text.error();
  if (report) return std::move(report).value();
  log.warning((text ? path + ": is " : std::string()) + report.error().message + "; the report has no self-test");
  return std::nullopt;
}

}  // namespace gloam
