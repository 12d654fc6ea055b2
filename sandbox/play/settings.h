// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/log.h"
#include "engine/core/result.h"

namespace gloam {

/// Settings that `play` keeps from run to run.
struct PlaySettings {
  std::uint32_t width = 1280;  ///< of the window, in desktop units
  std::uint32_t height = 720;
  double scale = 0.0;  ///< ResolutionScale::setting
  bool panel = false;  ///< whether the panel is open
  bool operator==(const PlaySettings&) const = default;
};

/// gloam/play.json in the user's folder of settings; empty if there is none.
[[nodiscard]] std::string play_settings_path();

[[nodiscard]] std::string settings_text(const PlaySettings& settings);
/// Values that are missing or out of range keep their defaults. An error if the text is not a JSON object.
[[nodiscard]] Result<PlaySettings> read_settings(std::string_view text);

/// Defaults if there is no file. A file that cannot be read or written is a warning.
[[nodiscard]] PlaySettings load_play_settings(const std::string& path, LogSink& log);
void save_play_settings(const std::string& path, const PlaySettings& settings, LogSink& log);

}  // namespace gloam
