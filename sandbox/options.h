// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/result.h"

namespace gloam {

enum class Command { play, render, inspect, bake, cost, bench, selftest, compare, scenes, knobs };

struct PixelPosition {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

/// A time for the passes of one module.
struct EffectBudget {
  std::string effect;
  double ms = 0.0;
};

/// A share of a list: the entries whose index modulo `count` is `number` - 1.
struct Shard {
  std::uint32_t number = 1;  ///< 1…count
  std::uint32_t count = 1;
};

/// The parsed command line. Every number is in its documented range.
struct Options {
  Command command = Command::render;
  std::string scene;              ///< path or "builtin:NAME"
  bool scene_is_default = false;  ///< the command line names no scene

  std::uint32_t width = 1280;  ///< pixels, 1…kMaxSize
  std::uint32_t height = 720;
  bool size_given = false;      ///< by --size
  std::string camera;           ///< empty: the scene's first camera; if it has none, one fitted to the scene
  std::uint32_t frames = 1;     ///< play: 0 runs until the window is closed
  bool scale_given = false;     ///< by --scale
  double scale = 0.0;           ///< play: share of the window's size that is drawn, 0.25…1; 0: automatic
  std::string script;           ///< play: file of input events, for tests
  std::string shaders;          ///< play: source tree whose shaders are watched; selftest: whose shaders are tested
  std::uint32_t in_flight = 1;  ///< render: frames that may be unfinished at a time, 1…gpu::Device::kFramesInFlight
  double time_s = 0.0;
  double dt_s = 1.0 / 60.0;
  bool fixed_step = true;  ///< false for play without --dt: the scene follows the wall clock
  std::uint64_t seed = 1;
  bool seed_given = false;
  std::vector<std::string> assignments;  ///< "KNOB=VALUE", in order
  std::string view = "none";
  std::string out;  ///< empty: the command's default
  std::string stats;
  std::string trace;
  std::string device = "auto";
  std::uint32_t threads = 0;  ///< 0: one per core
  std::string animation;
  std::string config;
  std::string lights;                        ///< file of changes to lights; empty: none
  std::string cache_dir;                     ///< empty: compiled pipelines are not kept between runs
  std::optional<double> budget_ms;           ///< play, render, bench: time of a frame
  std::vector<EffectBudget> effect_budgets;  ///< play, render, bench
  std::string ledger;  ///< play, render, bench: file or folder of `cost`, for the budgets; empty: find_ledger()
  bool validate = false;
  std::optional<PixelPosition> pick;
  bool quiet = false;

  bool json = false;               ///< inspect, knobs
  bool markdown = false;           ///< knobs, selftest
  std::uint32_t fit_proxies = 0;   ///< bake
  std::uint32_t grid_probes = 0;   ///< bake
  bool beside = false;             ///< bake: write the captures beside the scene file
  std::string knobs;               ///< cost: comma-separated
  bool quick = false;              ///< cost, selftest
  std::string only;                ///< selftest: pattern of the checks to run; empty: all
  std::string cameras;             ///< cost: comma-separated
  bool path = false;               ///< cost: the camera at times along the scene's animation
  std::string scene_list;          ///< cost: file with one scene a line; empty: the measured scene is `scene`
  Shard shard;                     ///< cost with scene_list
  std::vector<std::string> merge;  ///< cost: folders of sweeps
  /// cost with scene_list: the other given options, as arguments that go before those of each scene of the list.
  std::vector<std::string> shared_arguments;
  std::vector<std::string> names;  ///< bench; compare: the picture and its reference
  double most_flip = 1.0;          ///< compare
  std::string json_file;           ///< bench
  bool list = false;               ///< bench, selftest
  bool strict = false;             ///< bench

  std::optional<double> minutes;        ///< cost: how long to measure; none: as --quick implies
  std::optional<std::uint32_t> points;  ///< cost: combinations to measure; none: as many as --quick implies
};

inline constexpr std::uint32_t kMaxSize = 16384;

/// Whether --budget is given, for frames or for effects.
[[nodiscard]] inline bool has_budget(const Options& options) {
  return options.budget_ms || !options.effect_budgets.empty();
}

/// Text of --help or --version: the program prints it and exits.
struct PrintAndLeave {
  std::string text;
};

/// An option with one value that is given twice is an error, or its last value counts.
enum class RepeatedOptions { error, last };

/// Parses the arguments of main, without the program's name. version: the text that --version prints. All errors are
/// ErrorKind::usage.
[[nodiscard]] Result<std::variant<Options, PrintAndLeave>> parse_options(
    std::span<const std::string> arguments, const std::string& version,
    RepeatedOptions repeated = RepeatedOptions::error);

/// The text that `gloam` prints if it is run without arguments.
[[nodiscard]] std::string help_text();

}  // namespace gloam
