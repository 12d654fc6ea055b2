// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace gloam {
namespace {

using ::testing::HasSubstr;
using Arguments = std::vector<std::string>;

Result<std::variant<Options, PrintAndLeave>> parse(const Arguments& arguments) {
  return parse_options(arguments, "gloam 9.8.7");
}

Options parsed(const Arguments& arguments) {
  const auto outcome = parse(arguments);
  EXPECT_TRUE(outcome.ok()) << (outcome.ok() ? "" : outcome.error().message);
  if (!outcome.ok() || !std::holds_alternative<Options>(*outcome)) return {};
  return std::get<Options>(*outcome);
}

std::string fault(const Arguments& arguments) {
  const auto outcome = parse(arguments);
  EXPECT_FALSE(outcome.ok()) << "nothing was wrong with the arguments";
  if (outcome.ok()) return {};
  EXPECT_EQ(outcome.error().kind, ErrorKind::usage);
  EXPECT_FALSE(outcome.error().message.empty());
  return outcome.error().message;
}

TEST(Options, defaults_are_the_documented_ones) {
  const Options options = parsed({"render", "scene.gltf"});
  EXPECT_EQ(options.command, Command::render);
  EXPECT_EQ(options.scene, "scene.gltf");
  EXPECT_EQ(options.width, 1280u);
  EXPECT_EQ(options.height, 720u);
  EXPECT_EQ(options.frames, 1u);
  EXPECT_EQ(options.time_s, 0.0);
  EXPECT_DOUBLE_EQ(options.dt_s, 1.0 / 60.0);
  EXPECT_EQ(options.view, "none");
  EXPECT_EQ(options.device, "auto");
  EXPECT_FALSE(options.validate);
  EXPECT_FALSE(options.pick.has_value());
}

TEST(Options, every_common_option_is_read) {
  const Options options = parsed(
      {"render",  "a.glb",    "--size",  "320x180",     "--camera", "court",      "--frames",  "7",     "--time",
       "-1.5",    "--dt",     "0.25",    "--seed",      "42",       "--view",     "depth",     "--out", "x.exr",
       "--stats", "s.json",   "--trace", "t.json",      "--device", "cpu",        "--threads", "3",     "--animation",
       "walk",    "--config", "c.json",  "--cache-dir", "cache",    "--validate", "--pick",    "5,6",   "--quiet"});
  EXPECT_EQ(options.width, 320u);
  EXPECT_EQ(options.height, 180u);
  EXPECT_EQ(options.camera, "court");
  EXPECT_EQ(options.frames, 7u);
  EXPECT_EQ(options.time_s, -1.5);
  EXPECT_EQ(options.dt_s, 0.25);
  EXPECT_EQ(options.seed, 42u);
  EXPECT_EQ(options.view, "depth");
  EXPECT_EQ(options.out, "x.exr");
  EXPECT_EQ(options.stats, "s.json");
  EXPECT_EQ(options.trace, "t.json");
  EXPECT_EQ(options.device, "cpu");
  EXPECT_EQ(options.threads, 3u);
  EXPECT_EQ(options.animation, "walk");
  EXPECT_EQ(options.config, "c.json");
  EXPECT_EQ(options.cache_dir, "cache");
  EXPECT_TRUE(options.validate);
  ASSERT_TRUE(options.pick.has_value());
  EXPECT_EQ(options.pick->x, 5u);
  EXPECT_EQ(options.pick->y, 6u);
  EXPECT_TRUE(options.quiet);
}

TEST(Options, set_may_be_repeated_and_does_not_swallow_the_scene) {
  const Options options = parsed({"render", "--set", "a.b=1", "--set", "c=two", "scene.gltf"});
  EXPECT_EQ(options.assignments, (Arguments{"a.b=1", "c=two"}));
  EXPECT_EQ(options.scene, "scene.gltf");
}

TEST(Options, play_shows_the_dusk_until_the_window_is_closed) {
  const Options options = parsed({"play"});
  EXPECT_EQ(options.scene, "builtin:dusk");
  EXPECT_EQ(options.frames, 0u);
  EXPECT_FALSE(options.fixed_step);
  EXPECT_TRUE(parsed({"play", "--dt", "0.1"}).fixed_step);
  EXPECT_EQ(parsed({"play", "--frames", "3"}).frames, 3u);
}

TEST(Options, play_draws_at_an_automatic_scale_unless_it_measures) {
  EXPECT_EQ(parsed({"play"}).scale, 0.0);
  EXPECT_EQ(parsed({"play", "--scale", "0.4"}).scale, 0.4);
  EXPECT_EQ(parsed({"play", "--stats", "s.json"}).scale, 1.0);
  EXPECT_EQ(parsed({"play", "--stats", "s.json", "--scale", "auto"}).scale, 0.0);
  for (const char* wrong : {"0.2", "1.01", "x", "", "0.5x", "nan"}) fault({"play", "--scale", wrong});
  fault({"render", "a.gltf", "--scale", "0.5"});
}

TEST(Options, bench_takes_names_and_a_scene) {
  const Options options = parsed({"bench", "ecs", "jobs", "--strict", "--json", "rows.json"});
  EXPECT_EQ(options.names, (Arguments{"ecs", "jobs"}));
  EXPECT_EQ(options.scene, "builtin:lanterns");
  EXPECT_TRUE(options.scene_is_default);
  EXPECT_FALSE(parsed({"bench", "ecs", "--scene", "builtin:lanterns"}).scene_is_default);
  EXPECT_TRUE(options.strict);
  EXPECT_EQ(options.json_file, "rows.json");
  EXPECT_TRUE(parsed({"bench", "--list"}).list);
}

TEST(Options, help_and_version_are_to_be_printed) {
  for (const Arguments& arguments : {Arguments{"--help"}, Arguments{"render", "--help"}, Arguments{"--version"}}) {
    const auto outcome = parse(arguments);
    ASSERT_TRUE(outcome.ok());
    EXPECT_TRUE(std::holds_alternative<PrintAndLeave>(*outcome));
  }
  EXPECT_EQ(std::get<PrintAndLeave>(*parse({"--version"})).text, "gloam 9.8.7\n");
  EXPECT_NE(std::get<PrintAndLeave>(*parse({"render", "--help"})).text.find("--stats"), std::string::npos);
  EXPECT_NE(help_text().find("inspect"), std::string::npos);
}

TEST(Options, minutes_are_a_number_with_a_point) {
  EXPECT_EQ(parsed({"cost", "a.gltf", "--out", "x", "--minutes", "2.5"}).minutes, 2.5);
  EXPECT_FALSE(parsed({"cost", "a.gltf", "--out", "x"}).minutes.has_value());
}

TEST(Options, wrong_usage_is_refused) {
  fault({});
  fault({"dance"});
  fault({"render"});
  fault({"render", "a.gltf", "b.gltf"});
  fault({"render", "a.gltf", "--no-such-option"});
  fault({"render", "a.gltf", "--frames", "0"});
  fault({"render", "a.gltf", "--frames", "many"});
  for (const char* minutes : {"0", "-1", "nan", "inf", "1,5", "2m", "1e7"})
    EXPECT_NE(fault({"cost", "a.gltf", "--out", "x", "--minutes", minutes}).find("--minutes"), std::string::npos);
  fault({"render", "a.gltf", "--frames", "-1"});
  fault({"render", "a.gltf", "--time", "nan"});
  fault({"render", "a.gltf", "--dt", "-0.1"});
  fault({"render", "a.gltf", "--dt", "inf"});
  fault({"render", "a.gltf", "--threads", "5000"});
  fault({"render", "a.gltf", "--seed", "x"});
  fault({"render", "a.gltf", "--out", "picture.jpg"});
  fault({"render", "a.gltf", "--set", "no_equals_sign"});
  fault({"cost", "a.gltf"});
  fault({"bench"});
}

TEST(Options, an_unknown_command_is_answered_with_the_nearest_one_before_the_list) {
  const std::string list = "there are play, render, inspect, bake, cost, bench, selftest, compare, knobs, scenes";
  EXPECT_EQ(fault({"rendr", "a.gltf", "--size", "0x0"}), "unknown command 'rendr'; did you mean render? " + list);
  EXPECT_EQ(fault({"Inspect", "a.gltf"}), "unknown command 'Inspect'; did you mean inspect? " + list);
  EXPECT_EQ(fault({"dance"}), "unknown command 'dance'; " + list);
}

TEST(Options, a_budget_is_a_time) {
  for (const char* text : {"33ms", "33", "33.0ms"}) {
    const auto options = parse({"render", "a.gltf", "--budget", text, "--ledger", "l"});
    ASSERT_TRUE(options.ok()) << text;
    EXPECT_EQ(std::get<Options>(*options).budget_ms, 33.0);
    EXPECT_EQ(std::get<Options>(*options).ledger, "l");
  }
  EXPECT_EQ(parsed({"play", "a.gltf", "--budget", "8ms"}).ledger, "");
  EXPECT_EQ(fault({"render", "a.gltf", "--ledger", "l"}), "--ledger needs --budget");
  for (const char* text : {"", "ms", "0", "-8ms", "nan", "inf", "8s", "8 ms", "2e6ms"})
    EXPECT_THAT(fault({"play", "a.gltf", "--ledger", "l", "--budget", text}), HasSubstr("--budget wants a time"))
        << text;
  EXPECT_EQ(fault({"render", "a.gltf", "--budget", "8ms", "--budget", "9ms"}), "--budget gives frames two times");
  for (const char* command : {"inspect", "cost", "bake"})
    EXPECT_EQ(fault({command, "--budget", "8ms", "a.gltf"}), "--budget is of play, render and bench") << command;
  EXPECT_EQ(parsed({"bench", "governor", "--budget", "8ms"}).budget_ms, 8.0);
}

TEST(Options, an_effect_has_a_budget_of_its_own) {
  const Options options =
      parsed({"render", "a.gltf", "--budget", "33ms", "--budget", "grass=8ms", "--budget", "fog=.5"});
  EXPECT_EQ(options.budget_ms, 33.0);
  ASSERT_EQ(options.effect_budgets.size(), 2u);
  EXPECT_EQ(options.effect_budgets[0].effect, "grass");
  EXPECT_EQ(options.effect_budgets[0].ms, 8.0);
  EXPECT_EQ(options.effect_budgets[1].ms, 0.5);
  EXPECT_EQ(parsed({"play", "a.gltf", "--budget", "grass=8ms"}).budget_ms, std::nullopt);
  EXPECT_EQ(fault({"render", "a.gltf", "--budget", "fog=8", "--budget", "fog=9"}), "--budget gives fog two times");
  EXPECT_THAT(fault({"render", "a.gltf", "--budget", "fog="}), HasSubstr("--budget wants a time"));
  EXPECT_THAT(fault({"render", "a.gltf", "--budget", "=8ms"}), HasSubstr("EFFECT=TIME"));
  EXPECT_EQ(parsed({"bench", "governor", "--budget", "fog=8ms"}).effect_budgets.at(0).effect, "fog");
}

// Hard case: further.seed_limits
TEST(Options, the_help_says_that_the_seed_seeds_nothing_yet) {
  const std::string help = std::get<PrintAndLeave>(*parse({"render", "--help"})).text;
  EXPECT_NE(help.find("--seed"), std::string::npos);
  EXPECT_NE(help.find("pictures do not depend on it"), std::string::npos) << help;
}

// Hard case: further.seed_limits
TEST(Options, seeds_are_whole_numbers_of_64_bits) {
  for (const char* seed : {"-1", "18446744073709551616", "1.5", "0x10", "+1", "", " 1", "1e3", "nan"})
    EXPECT_NE(fault({"render", "a.gltf", "--seed", seed}).find("--seed"), std::string::npos) << seed;
  EXPECT_EQ(parsed({"render", "a.gltf", "--seed", "0"}).seed, 0u);
  EXPECT_EQ(parsed({"render", "a.gltf", "--seed", "18446744073709551615"}).seed, ~std::uint64_t{0});
}

TEST(Options, the_help_of_bench_tells_one_batch_from_separate_jobs) {
  const std::string help = std::get<PrintAndLeave>(*parse({"bench", "--help"})).text;
  EXPECT_NE(help.find("jobs.empty is one batch"), std::string::npos) << help;
  EXPECT_NE(help.find("jobs.spawn creates, runs and destroys"), std::string::npos) << help;
}

TEST(Options, faults_are_one_short_line_whatever_was_given) {
  const std::string text = "a\nb\x01" + std::string(100000, 'x');
  for (const Arguments& arguments : {Arguments{text},
                                     {"render", "--size", text},
                                     {"render", "a.glb", "--set", text},
                                     {"knobs", "--" + text},
                                     {"render", "a.glb", "--budget", text + "=5ms", "--budget", text + "=5ms"},
                                     {"play", "--frames", text}}) {
    const auto outcome = parse(arguments);
    ASSERT_FALSE(outcome.ok());
    EXPECT_LT(outcome.error().message.size(), 2100u);
    EXPECT_EQ(outcome.error().message.find_first_of("\n\x01"), std::string::npos) << outcome.error().message;
  }
}

TEST(Options, sizes_are_two_numbers_in_range) {
  for (const char* size :
       {"0x10", "10x0", "10", "10x", "x10", "10x10x10", "-1x5", "10 x10", "99999x10", "4294967297x10", "axb"})
    EXPECT_NE(fault({"render", "a.gltf", "--size", size}).find("--size"), std::string::npos) << size;
  EXPECT_EQ(parsed({"render", "a.gltf", "--size", "1x16384"}).height, 16384u);
}

TEST(Options, one_or_two_frames_are_in_flight) {
  EXPECT_EQ(parsed({"render", "a.gltf"}).in_flight, 1u);
  EXPECT_EQ(parsed({"render", "a.gltf", "--in-flight", "1"}).in_flight, 1u);
  EXPECT_EQ(parsed({"render", "a.gltf", "--in-flight", "2"}).in_flight, 2u);
  for (const char* value : {"0", "3", "-1", "two", "1.5", "2 ", ""})
    EXPECT_EQ(fault({"render", "a.gltf", "--in-flight", value}),
              "--in-flight wants 1 or 2, not '" + std::string(value) + "'");
}

TEST(Options, a_pick_lies_in_the_picture) {
  EXPECT_TRUE(parsed({"render", "a.gltf", "--size", "10x10", "--pick", "9,9"}).pick.has_value());
  for (const char* pick : {"10,0", "0,10", "1", "1,", "-1,2", "1,2,3"})
    EXPECT_NE(fault({"render", "a.gltf", "--size", "10x10", "--pick", pick}).find("--pick"), std::string::npos) << pick;
}

}  // namespace
}  // namespace gloam
