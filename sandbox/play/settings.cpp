// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/settings.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "engine/core/env.h"
#include "sandbox/output/file_io.h"
#include "sandbox/output/json_text.h"

namespace gloam {
namespace {

constexpr double kLeastSide = 64.0;
constexpr double kMostSide = 16384.0;
constexpr double kLeastScale = 0.25;

/// The number of this name if it lies in a range.
bool read_number(const Json& json, const char* name, double least, double most, double& value) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number()) return false;
  const auto number = found->get<double>();
  if (!(number >= least && number <= most)) return false;
  value = number;
  return true;
}

}  // namespace

std::string play_settings_path() {
  if (const auto config = environment_text("XDG_CONFIG_HOME")) return *config + "/gloam/play.json";
  if (const auto home = environment_text("HOME")) return *home + "/.config/gloam/play.json";
  return {};
}

std::string settings_text(const PlaySettings& settings) {
  Json json;
  json["width"] = settings.width;
  json["height"] = settings.height;
  json["scale"] = settings.scale;
  json["panel"] = settings.panel;
  return json_text(json);
}

Result<PlaySettings> read_settings(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return Error{ErrorKind::input, "is not a JSON object"};
  PlaySettings settings;
  double width = 0.0;
  double height = 0.0;
  if (read_number(json, "width", kLeastSide, kMostSide, width) &&
      read_number(json, "height", kLeastSide, kMostSide, height)) {
    settings.width = static_cast<std::uint32_t>(width);
    settings.height = static_cast<std::uint32_t>(height);
  }
  read_number(json, "scale", kLeastScale, 1.0, settings.scale);
  if (const auto panel = json.find("panel"); panel != json.end() && panel->is_boolean())
    settings.panel = panel->get<bool>();
  return settings;
}

PlaySettings load_play_settings(const std::string& path, LogSink& log) {
  std::error_code fault;
  if (path.empty() || !std::filesystem::exists(path, fault)) return {};
  const auto text = read_text_file(path, ErrorKind::input);
  if (!text) {
    log.warning(text.error().message);
    return {};
  }
  const auto settings = read_settings(*text);
  if (!settings) {
    log.warning(path + ": " + settings.error().message);
    return {};
  }
  return *settings;
}

void save_play_settings(const std::string& path, const PlaySettings& settings, LogSink& log) {
  if (path.empty()) return;
  Status saved = make_folder_of(path);
  if (saved.ok()) saved = write_file(path, settings_text(settings));
  if (!saved.ok()) log.warning(saved.error().message);
}

}  // namespace gloam
