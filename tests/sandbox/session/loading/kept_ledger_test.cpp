// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/kept_ledger.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "sandbox/output/file_io.h"
#include "sandbox/output/identity.h"
#include "tests/sandbox/play/budget/empty_session.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

Ledger ledger_of(const std::vector<std::string>& knobs, const std::string& build) {
  Ledger ledger = {.header = {.scene = "builtin:lanterns", .scene_hash = "abc", .device = "llvmpipe", .build = build}};
  for (const std::string& knob : knobs)
    for (const char* value : {"low", "high"}) ledger.rows.push_back({.knob = knob, .value = value});
  ledger.points.push_back({.settings = {{knobs.front(), "low"}}});
  ledger.points.back().measured.flip = ErrorPair();
  ledger.points.back().measured.whole = WholeError();
  return ledger;
}

/// Number of knobs in the only file of the cache.
std::size_t kept_rows(const std::string& cache) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(cache))
    if (entry.path().extension() == ".json")
      return parse_ledger_json(*read_text_file(entry.path().string(), ErrorKind::input))->rows.size();
  return 0;
}

TEST(KeptLedger, one_of_few_knobs_does_not_replace_a_fuller_one_of_the_same_program) {
  const test::TestFolder folder;
  const Options options = {.cache_dir = folder.path()};
  ASSERT_TRUE(keep_ledger(ledger_of({"a.x", "a.y", "b.z"}, "1"), options).ok());
  EXPECT_EQ(kept_rows(options.cache_dir), 6u);
  ASSERT_TRUE(keep_ledger(ledger_of({"a.x"}, "1"), options).ok());
  EXPECT_EQ(kept_rows(options.cache_dir), 6u);
  ASSERT_TRUE(keep_ledger(ledger_of({"a.x", "a.y", "b.w"}, "1"), options).ok());
  EXPECT_EQ(kept_rows(options.cache_dir), 6u) << "as many: the newer one";
  ASSERT_TRUE(keep_ledger(ledger_of({"a.x"}, "2"), options).ok());
  EXPECT_EQ(kept_rows(options.cache_dir), 2u) << "another program may have other times";
}

TEST(KeptLedger, that_is_damaged_is_told_once_and_replaced) {
  const test::TestFolder folder;
  const Options options = {.scene = "builtin:plain", .cache_dir = folder.path()};
  gpu::RecordingDevice* device = nullptr;
  const auto session = test::empty_session(device);
  Ledger ledger = ledger_of({"a.x"}, "1");
  ledger.header.device = device->info().name;
  ledger.header.scene_hash = scene_hash(options.scene, session->world);
  std::vector<std::string> warnings;
  FunctionLog log([&](LogLevel, std::string_view line) { warnings.emplace_back(line); });
  const auto is_found = [&] {
    const auto found = find_own_ledger(*session, options, log);
    return found.ok() && found->has_value();
  };
  ASSERT_TRUE(keep_ledger(ledger, options).ok());
  ASSERT_TRUE(is_found());
  ASSERT_TRUE(warnings.empty()) << warnings.front();
  const std::string path = (*find_own_ledger(*session, options, log))->path;
  const std::string sound = *read_text_file(path, ErrorKind::input);
  for (const std::string& damaged : {std::string(), sound.substr(0, sound.size() / 2), std::string(sound.size(), '\0'),
                                     R"({"version": 2})" + sound.substr(sound.find('\n'))}) {
    ASSERT_TRUE(write_file(path, damaged).ok());
    warnings.clear();
    EXPECT_FALSE(is_found());
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings.front().find(path), std::string::npos) << warnings.front();
    ASSERT_TRUE(keep_ledger(ledger, options).ok());
    EXPECT_TRUE(is_found());
    EXPECT_EQ(warnings.size(), 1u);
  }
}

}  // namespace
}  // namespace gloam
