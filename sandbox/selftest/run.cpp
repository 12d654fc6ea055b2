// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/selftest/run.h"

#include <chrono>
#include <utility>

#include "engine/core/system/process.h"
#include "sandbox/output/identity.h"
#include "sandbox/session/session.h"

namespace gloam {
namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

bool matches_all(std::string_view text, std::string_view pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return text == pattern;
  if (!text.starts_with(pattern.substr(0, star))) return false;
  text.remove_prefix(star);
  pattern.remove_prefix(star + 1);
  for (;; text.remove_prefix(1)) {
    if (matches_all(text, pattern)) return true;
    if (text.empty()) return false;
  }
}

}  // namespace

bool matches_check(std::string_view name, std::string_view pattern) {
  if (matches_all(name, pattern)) return true;
  const bool begins = name.starts_with(pattern) && name.size() > pattern.size() && name[pattern.size()] == '.';
  return !pattern.empty() && pattern.find('*') == std::string_view::npos && begins;
}

Result<std::vector<SelfTestCheck>> chosen_checks(const Options& options) {
  std::vector<SelfTestCheck> checks = selftest_checks();
  if (options.only.empty()) {
    if (options.quick) std::erase_if(checks, [](const SelfTestCheck& check) { return !check.quick; });
    return checks;
  }
  std::erase_if(checks, [&](const SelfTestCheck& check) { return !matches_check(check.check.name, options.only); });
  if (!checks.empty()) return checks;
  return Error{ErrorKind::usage, "--only " + options.only + " matches no check; --list prints their names"};
}

Result<StabilityReport> run_selftest(const Options& options, LogSink& log,
                                     const std::function<void(const StabilityCheck&)>& done) {
  const auto begin = std::chrono::steady_clock::now();
  auto checks = chosen_checks(options);
  if (!checks) return checks.error();
  auto device = open_device(options, log);
  if (!device) return device.error();
  const std::shared_ptr<gpu::Device> shared = std::move(device).value();
  StabilityReport report = {.gloam = GLOAM_VERSION,
                            .device = shared->info().name,
                            .driver = shared->info().driver,
                            .device_type = std::string(gpu::name_of(shared->info().type)),
                            .subgroup_size = shared->info().subgroup_size,
                            .host = host_name(),
                            .quick = options.quick};
  auto shaders = options.shaders.empty() ? Result<std::vector<ChangedShader>>(std::vector<ChangedShader>())
                                         : compile_changed_shaders(options.shaders);
  if (!shaders) return shaders.error();
  SelfTestContext context(options, log, shared, std::move(shaders).value());
  for (SelfTestCheck& own : *checks) {
    const auto check_begin = std::chrono::steady_clock::now();
    if (const Status ran = own.run(context, own.check); !ran.ok()) own.check.fault = ran.error().message;
    own.check.seconds = seconds_since(check_begin);
    done(own.check);
    report.checks.push_back(std::move(own.check));
  }
  report.seconds = seconds_since(begin);
  return report;
}

}  // namespace gloam
