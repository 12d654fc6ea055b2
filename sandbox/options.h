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

enum class Command { play, render, inspect, bake, cost, bench, scenes };

struct PixelPosition {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

/// What a user asked for; every number is in its documented range.
struct Options {
  Command command = Command::render;
  std::string scene;              ///< path or "builtin:NAME"
  bool scene_is_default = false;  ///< the user named none

  std::uint32_t width = 1280;  ///< pixels, 1…kMaxSize
  std::uint32_t height = 720;
  std::string camera;        ///< empty: the first, else one fitted to the scene
  std::uint32_t frames = 1;  ///< play: 0 runs until the window is closed
  double time_s = 0.0;
  double dt_s = 1.0 / 60.0;
  bool fixed_step = true;  ///< play without --dt: false, time passes as on the wall
  std::uint64_t seed = 1;
  std::vector<std::string> assignments;  ///< "KNOB=VALUE", in order
  std::string view = "none";
  std::string out;  ///< empty: the command's default
  std::string stats;
  std::string trace;
  std::string device = "auto";
  std::uint32_t threads = 0;  ///< 0: one a core
  std::string budget;
  std::string animation;
  std::string config;
  std::string cache_dir;  ///< empty: nothing is kept between runs
  std::string ledger;
  bool validate = false;
  std::optional<PixelPosition> pick;
  bool quiet = false;

  bool json = false;               ///< inspect
  std::uint32_t fit_proxies = 0;   ///< bake
  std::string knobs;               ///< cost: comma-separated
  bool quick = false;              ///< cost
  std::vector<std::string> names;  ///< bench
  std::string json_file;           ///< bench
  bool list = false;               ///< bench
  bool strict = false;             ///< bench
};

inline constexpr std::uint32_t kMaxSize = 16384;

/// Help or a version, asked for: to be printed instead of doing anything.
struct PrintAndLeave {
  std::string text;
};

/// `arguments` as of main, without the program's name. `version` is what --version prints. Errors are of
/// ErrorKind::usage.
[[nodiscard]] Result<std::variant<Options, PrintAndLeave>> parse_options(std::span<const std::string> arguments,
                                                                         const std::string& version);

/// What `gloam` alone prints.
[[nodiscard]] std::string help_text();

}  // namespace gloam
