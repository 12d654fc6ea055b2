// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/modules_in_use/visualizers.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/assert.h"
#include "engine/core/text/nearest_name.h"
#include "engine/core/text/plain_text.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

struct EngineVisualizer {
  std::string_view name;
  std::string_view legend;
};

/// Visualizers of the geometry buffer; index + 1 is the code in debug_view.frag.
constexpr EngineVisualizer kEngineVisualizers[] = {
    {"albedo", "base colour without light"},
    {"normal", "shading normal: x, y, z as red, green, blue; -1 is 0, 0 is 128 and 1 is 255"},
    {"depth", "distance: white near, grey far, black sky"}};

/// Whether the knob is at one of the choices, which are separated by '|'.
bool is_one_of(const KnobRegistry& knobs, std::string_view name, std::string_view choices) {
  const Knob* knob = knobs.find(name);
  GLOAM_ASSERT(knob != nullptr, "the knob of a visualizer must be declared: " + std::string(name));
  for (std::size_t end = 0; !choices.empty(); choices.remove_prefix(std::min(end + 1, choices.size()))) {
    end = std::min(choices.find('|'), choices.size());
    if (knobs.text(*knob) == choices.substr(0, end)) return true;
  }
  return false;
}

Status check_one(const VisualizerInfo& info, std::optional<std::string_view> argument, const KnobRegistry& knobs,
                 const World& world) {
  const auto fault = [&](const std::string& text) { return Error{ErrorKind::usage, "view " + info.name + text}; };
  if (!info.knob.empty() && !is_one_of(knobs, info.knob, info.value))
    return fault(" needs " + info.knob + "=" + info.value);
  if (info.argument.empty() && argument) return fault(" takes no argument");
  if (!info.argument.empty() && !argument) return fault(" needs :" + info.argument);
  if (info.argument != "LIGHT") return {};
  const auto light = world.resource<SceneNames>().find("light", *argument);
  return light.ok() ? Status() : Error{ErrorKind::usage, light.error().message};
}

}  // namespace

std::vector<VisualizerInfo> all_visualizers(const ModuleList& modules) {
  std::vector<VisualizerInfo> all = {{"none", "engine", "", "the lit picture"}};
  for (const EngineVisualizer& own : kEngineVisualizers)
    all.push_back({std::string(own.name), "engine", "", std::string(own.legend)});
  for (const auto& module : modules)
    for (VisualizerInfo& info : module->visualizers()) all.push_back(std::move(info));
  return all;
}

std::uint32_t engine_visualizer_code(std::string_view name) {
  const auto found = std::ranges::find(kEngineVisualizers, name, &EngineVisualizer::name);
  const auto index = static_cast<std::uint32_t>(found - std::begin(kEngineVisualizers));
  return found == std::end(kEngineVisualizers) ? 0 : index + 1;
}

Status check_visualizer_name(const ModuleList& modules, std::string_view name) {
  if (name == "none") return {};
  const std::string_view stem = name.substr(0, name.find(':'));
  std::vector<std::string> names;
  std::string list;
  for (const VisualizerInfo& info : all_visualizers(modules)) {
    if (info.name == stem) return {};
    names.push_back(info.name);
    list += (list.empty() ? "" : ", ") + info.name + (info.argument.empty() ? "" : ":" + info.argument);
  }
  return Error{ErrorKind::usage,
               "unknown view " + one_line(name) + "; " + did_you_mean(stem, names) + "there are " + list};
}

Status check_visualizer(const ModuleList& modules, const KnobRegistry& knobs, const World& world,
                        std::string_view name) {
  GLOAM_TRY(check_visualizer_name(modules, name));
  const std::string_view stem = name.substr(0, name.find(':'));
  const auto argument =
      stem.size() == name.size() ? std::nullopt : std::optional<std::string_view>(name.substr(stem.size() + 1));
  for (const VisualizerInfo& info : all_visualizers(modules))
    if (info.name == stem) return check_one(info, argument, knobs, world);
  return {};
}

}  // namespace gloam
