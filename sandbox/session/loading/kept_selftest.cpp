// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/kept_selftest.h"

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
                                             const std::string& driver) {
  if (options.cache_dir.empty()) return std::nullopt;
  const auto text = read_text_file(selftest_file(options, device, driver), ErrorKind::input);
  if (!text) return std::nullopt;
  auto report = parse_stability_json(*text);
  if (!report) return std::nullopt;
  return std::move(report).value();
}

}  // namespace gloam
