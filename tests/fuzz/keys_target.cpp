// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Settings that users write: knobs, scene keys, command lines, lights, and what `play` keeps.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "engine/render/knobs/knobs.h"
#include "modules/module_list/module_list.h"
#include "sandbox/play/settings.h"
#include "sandbox/session/loading/light_patch.h"
#include "tests/fuzz/command_line_format.h"
#include "tests/fuzz/scene_target.h"
#include "tests/support/gltf_files.h"

namespace gloam::fuzz {
namespace {

KnobRegistry make_knobs() {
  KnobRegistry knobs;
  for (const auto& module : make_all_modules()) module->knobs(knobs);
  return knobs;
}

std::string knob_fault(const KnobRegistry& knobs) {
  KnobRegistry again = knobs;
  for (const Knob& knob : knobs.knobs()) {
    const double number = knobs.number(knob);
    if (!(number >= knob.min && number <= knob.max)) return knob.name + " is out of range";
    if (knob.type != Knob::Type::number && number != std::floor(number)) return knob.name + " is not a whole number";
    if (!again.set(knob.name, knobs.text(knob)).ok() || again.number(*again.find(knob.name)) != number)
      return knob.name + " has a value that cannot be set: " + knobs.text(knob);
  }
  return {};
}

std::vector<double> numbers_of(const KnobRegistry& knobs) {
  std::vector<double> numbers;
  for (const Knob& knob : knobs.knobs()) numbers.push_back(knobs.number(knob));
  return numbers;
}

/// Lines NAME=VALUE. A refused one changes nothing.
Outcome set_knobs_by_lines(Input input) {
  static const KnobRegistry defaults = make_knobs();
  KnobRegistry knobs = defaults;
  Outcome outcome = accepted();
  for (const std::string& line : lines_of(text_of(input))) {
    const std::vector<double> before = numbers_of(knobs);
    const Status status = knobs.set_assignment(line);
    if (status.ok()) continue;
    outcome = refused(status.error(), ErrorKind::usage);
    if (numbers_of(knobs) != before) return broken("a refused value has changed a knob");
    if (!outcome.fault.empty()) return outcome;
  }
  const std::string fault = knob_fault(knobs);
  return fault.empty() ? outcome : broken(fault);
}

Outcome set_knobs_by_file(Input input) {
  static const KnobRegistry defaults = make_knobs();
  KnobRegistry knobs = defaults;
  const Status status = knobs.set_from_json(text_of(input), "knobs.json");
  if (std::string fault = knob_fault(knobs); !fault.empty()) return broken(std::move(fault));
  return status.ok() ? accepted() : refused(status.error(), ErrorKind::usage, "knobs.json");
}

/// Values of a knob's ends and of its default.
std::vector<std::string> values_of(const Knob& knob) {
  if (knob.type == Knob::Type::choice) return knob.choices;
  return {value_text(knob, knob.min), value_text(knob, knob.max), value_text(knob, knob.default_number)};
}

std::vector<Bytes> knob_lines() {
  std::vector<Bytes> seeds;
  const KnobRegistry knobs = make_knobs();
  std::string all;
  for (const Knob& knob : knobs.knobs()) all += knob.name + "=" + values_of(knob).back() + "\n";
  for (const Knob& knob : knobs.knobs())
    if (seeds.size() < 8) seeds.push_back(bytes_of(knob.name + "=" + values_of(knob).front()));
  seeds.push_back(bytes_of(all));
  return seeds;
}

std::vector<Bytes> knob_files() {
  const KnobRegistry knobs = make_knobs();
  std::string all = "{";
  for (const Knob& knob : knobs.knobs())
    all += std::string(all.size() > 1 ? ", " : "") + "\"" + knob.name + "\": \"" + values_of(knob).back() + "\"";
  return {bytes_of("{}"), bytes_of(R"({"shadows.filter": "hard", "dof.radius": 7})"), bytes_of(all + "}")};
}

std::vector<std::string> knob_words() {
  std::vector<std::string> words = {"=", "\n", "nan", "inf", "-0", "1e-400", "0x1p3", "\"", "{", "true", "null"};
  const KnobRegistry knobs = make_knobs();
  for (const Knob& knob : knobs.knobs()) {
    words.push_back(knob.name);
    for (const std::string& value : values_of(knob)) words.push_back(value);
  }
  return words;
}

const std::map<std::string, KeyElement, std::less<>>& elements() {
  static const std::map<std::string, KeyElement, std::less<>> all = {
      {"node", KeyElement::node},          {"light", KeyElement::light_node},  {"mesh", KeyElement::mesh_node},
      {"camera", KeyElement::camera_node}, {"material", KeyElement::material}, {"scene", KeyElement::scene}};
  return all;
}

/// A scene of one node of each kind, with keys of lines ELEMENT KEY VALUE, whose value is JSON.
Outcome load_keys(Input input) {
  std::map<std::string, std::string> keys;
  for (const std::string& line : lines_of(text_of(input))) {
    const std::size_t space = line.find(' '), second = line.find(' ', space + 1);
    if (space == std::string::npos || second == std::string::npos) continue;
    std::string& members = keys[line.substr(0, space)];
    members += (members.empty() ? "\"" : ", \"") + line.substr(space + 1, second - space - 1) + "\": ";
    members += line.substr(second + 1);
  }
  test::GltfText gltf;
  gltf.mesh("\"POSITION\": " + std::to_string(gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")), ", \"material\": 0");
  gltf.add("cameras", R"({"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}})");
  gltf.set("extensions", R"({"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}}]}})");
  gltf.add("materials", R"({"extras": {)" + keys["material"] + "}}");
  for (const auto& [name, own] : {std::pair{"node", "\"name\": \"a\""},
                                  {"light", R"("name": "b", "extensions": {"KHR_lights_punctual": {"light": 0}})"},
                                  {"mesh", R"("name": "c", "mesh": 0)"},
                                  {"camera", R"("name": "d", "camera": 0)"}})
    gltf.add("nodes", "{" + std::string(own) + R"(, "extras": {)" + keys[name] + "}}");
  gltf.add("scenes", R"({"nodes": [0, 1, 2, 3], "extras": {)" + keys["scene"] + "}}");
  return load_scene_bytes(bytes_of(gltf.text()));
}

const KeyRegistry& scene_keys() {
  static const KeyRegistry registry = make_key_registry(make_all_modules());
  return registry;
}

std::string value_of(const SceneKey& key) {
  const double number = std::clamp(1.0, key.min, key.max);
  const std::string text = std::to_string(key.type == KeyType::integer ? std::floor(number) : number);
  switch (key.type) {
    case KeyType::boolean:
      return "true";
    case KeyType::number:
      return text;
    case KeyType::integer:
      return text.substr(0, text.find('.'));
    case KeyType::text:
      return "\"b\"";
    case KeyType::choice:
      return "\"" + key.choices.front() + "\"";
    case KeyType::vec2:
      return "[" + text + ", " + text + "]";
    case KeyType::vec3:
      return "[" + text + ", " + text + ", " + text + "]";
  }
  return "null";
}

std::string line_of(const SceneKey& key) {
  for (const auto& [name, element] : elements())
    if (element == key.on) return name + " " + key.name + " " + value_of(key) + "\n";
  return {};
}

/// Keys that need other keys or files are refused alone: they are words only.
std::vector<Bytes> key_lines() {
  static const std::vector<Bytes> all = [] {
    std::vector<Bytes> seeds = {bytes_of("light gloam.light.width 0.5\nscene gloam.exposure 3\n")};
    std::string together;
    for (const SceneKey& key : scene_keys().keys()) {
      const std::string longer = together + line_of(key);
      if (load_keys(bytes_of(line_of(key))).accepted && load_keys(bytes_of(longer)).accepted) together = longer;
    }
    seeds.push_back(bytes_of(together));
    return seeds;
  }();
  return all;
}

std::vector<std::string> key_words() {
  std::vector<std::string> words = {"\n",     " ",         "true", "false", "null",
                                    "[1, 1]", "[0, 0, 0]", "1e38", "-1e38", "1e-45"};
  for (const SceneKey& key : scene_keys().keys()) {
    words.push_back(line_of(key));
    for (const std::string& choice : key.choices) words.push_back("\"" + choice + "\"");
  }
  for (const auto& [name, element] : elements()) words.push_back(name);
  return words;
}

Outcome read_lights(Input input) {
  const auto patch = parse_light_patch(text_of(input), "lights.json");
  if (!patch) return refused(patch.error(), ErrorKind::usage, "lights.json");
  const std::string text = light_patch_text(*patch);
  const auto again = parse_light_patch(text, "lights.json");
  if (!again) return broken("is refused when it is written again: " + again.error().message);
  // Rotations are normalised each time they are read, which may change their last bit.
  if (again->lights.size() != patch->lights.size()) return broken("has other lights when it is written again: " + text);
  for (const auto& [name, change] : patch->lights) {
    LightChange other = again->lights.at(name);
    if (other.rotation && change.rotation) other.rotation = change.rotation;
    if (!(other == change)) return broken("is another one when it is written again: " + text);
  }
  return accepted();
}

std::vector<Bytes> light_files() {
  return {bytes_of(R"({"version": 1, "lights": {}})"),
          bytes_of(R"({"version": 1, "lights": {"lamp": {"intensity": 40, "color": [1, 0.9, 0.7], "range_m": 8,
      "width_m": 0.1, "on": true, "shadows": false, "cookie": true, "translation": [0, 2, 0],
      "rotation": [0, 0.6, 0, 0.8]}, "sun": {}}})")};
}

std::vector<std::string> light_words() {
  return with_json_signs({"\"intensity\"", "\"color\"", "\"range_m\"", "\"width_m\"", "\"on\"", "\"shadows\"",
                          "\"rotation\"", "\"translation\"", "1e9", "1e-50"});
}

Outcome read_play_settings(Input input) {
  const auto settings = read_settings(text_of(input));
  if (!settings) return refused(settings.error(), ErrorKind::input);
  const auto again = read_settings(settings_text(*settings));
  return again && *again == *settings ? accepted() : broken("is another one when it is written again");
}

std::vector<Bytes> play_settings() {
  return {bytes_of("{}"), bytes_of(settings_text({.width = 640, .height = 360, .scale = 0.5, .panel = true}))};
}

}  // namespace

Target keys_target() {
  return {"keys",
          {{"knobs", set_knobs_by_lines, knob_lines, knob_words},
           {"knob file", set_knobs_by_file, knob_files},
           command_line_format(),
           {"scene keys", load_keys, key_lines, key_words},
           {"lights", read_lights, light_files, light_words},
           {"settings", read_play_settings, play_settings}}};
}

}  // namespace gloam::fuzz
