// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/light_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "engine/core/text/json_nesting.h"
#include "engine/core/text/plain_text.h"
#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"
#include "sandbox/output/json_text.h"

namespace gloam {
namespace {

constexpr double kLargest = 1e9;

/// A name from the file for a message.
std::string in_single_quotes(std::string_view name) {
  constexpr std::size_t kMostBytes = 80;
  return "'" + one_line(name, kMostBytes) + "'";
}

/// Reads the members of one light. The first fault is kept.
class LightReader {
 public:
  LightReader(const Json& json, std::string place) : json_(json), place_(std::move(place)) {}

  void read(const char* name, std::optional<bool>& value) {
    if (const Json* found = take(name)) {
      if (found->is_boolean())
        value = found->get<bool>();
      else
        fail(name, "is not true or false");
    }
  }
  void read(const char* name, std::optional<float>& value) {
    if (const auto numbers = take_numbers(name, 1, 0.0)) value = static_cast<float>((*numbers)[0]);
  }
  void read(const char* name, std::optional<vec3>& value) {
    if (const auto n = take_numbers(name, 3, 0.0)) value = vec3(dvec3((*n)[0], (*n)[1], (*n)[2]));
  }
  void read(const char* name, std::optional<dvec3>& value) {
    if (const auto n = take_numbers(name, 3, -kLargest)) value = dvec3((*n)[0], (*n)[1], (*n)[2]);
  }
  void read(const char* name, std::optional<dquat>& value) {
    const auto n = take_numbers(name, 4, -1.0);
    if (!n) return;
    const dquat rotation((*n)[3], (*n)[0], (*n)[1], (*n)[2]);
    if (std::abs(glm::length(rotation) - 1.0) < 1e-3)
      value = glm::normalize(rotation);
    else
      fail(name, "is not a unit quaternion");
  }
  /// After all members.
  [[nodiscard]] Status end() {
    if (status_.ok() && json_.is_object())
      for (const auto& [name, value] : json_.items())
        if (std::ranges::find(taken_, name) == taken_.end()) fail(name, "is unknown");
    return status_;
  }

 private:
  [[nodiscard]] const Json* take(const std::string& name) {
    taken_.push_back(name);
    const auto found = json_.find(name);
    return found == json_.end() ? nullptr : &*found;
  }
  /// `count` numbers from `least` on; a single one is not in an array.
  [[nodiscard]] std::optional<std::vector<double>> take_numbers(const char* name, std::size_t count, double least) {
    const Json* found = take(name);
    if (found == nullptr) return std::nullopt;
    const Json list = count == 1 ? Json::array({*found}) : *found;
    std::vector<double> numbers;
    if (list.is_array())
      for (const Json& one : list) numbers.push_back(one.is_number() ? one.get<double>() : std::nan(""));
    const bool fits =
        numbers.size() == count && std::ranges::all_of(numbers, [&](double n) { return n >= least && n <= kLargest; });
    if (fits) return numbers;
    const std::string what = count == 1 ? "is not a number" : "does not have " + std::to_string(count) + " numbers";
    fail(name, what + (least == 0.0 ? " from 0 on" : ""));
    return std::nullopt;
  }
  void fail(const std::string& name, const std::string& fault) {
    if (status_.ok()) status_ = Error{ErrorKind::usage, place_ + ": " + in_single_quotes(name) + " " + fault};
  }

  const Json& json_;
  std::string place_;
  std::vector<std::string> taken_;
  Status status_;
};

Json numbers_of(std::initializer_list<double> numbers) { return Json(std::vector<double>(numbers)); }

Json json_of(const LightChange& change) {
  Json json = Json::object();
  if (change.intensity) json["intensity"] = *change.intensity;
  if (change.color) json["color"] = numbers_of({change.color->r, change.color->g, change.color->b});
  if (change.range_m) json["range_m"] = *change.range_m;
  if (change.width_m) json["width_m"] = *change.width_m;
  if (change.on) json["on"] = *change.on;
  if (change.shadows) json["shadows"] = *change.shadows;
  if (change.cookie) json["cookie"] = *change.cookie;
  if (const auto& t = change.translation) json["translation"] = numbers_of({t->x, t->y, t->z});
  if (const auto& r = change.rotation) json["rotation"] = numbers_of({r->x, r->y, r->z, r->w});
  return json;
}

void apply(World& world, Entity entity, const LightChange& change) {
  Light& light = world.get<Light>(entity);
  light.intensity = change.intensity.value_or(light.intensity);
  light.color = change.color.value_or(light.color);
  light.range_m = change.range_m.value_or(light.range_m);
  light.width_m = change.width_m.value_or(light.width_m);
  if (!change.on.value_or(true)) light.intensity = 0.0f;
  if (!change.cookie.value_or(true)) light.cookie = 0;
  world.mark_changed<Light>(entity);
  if (change.shadows) {
    ShadowCaster caster;
    if (const auto* old = std::as_const(world).try_get<ShadowCaster>(entity)) caster = *old;
    caster.enabled = *change.shadows;
    world.add<ShadowCaster>(entity, caster);
  }
  if ((!change.translation && !change.rotation) || !world.has<LocalTransform>(entity)) return;
  auto& pose = world.get<LocalTransform>(entity);
  pose.translation = change.translation.value_or(pose.translation);
  pose.rotation = change.rotation.value_or(pose.rotation);
  world.mark_changed<LocalTransform>(entity);
}

}  // namespace

Result<LightPatch> parse_light_patch(std::string_view text, std::string_view source) {
  const std::string place(source);
  if (nests_too_deep(text)) return Error{ErrorKind::usage, place + ": " + too_deep_text()};
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return Error{ErrorKind::usage, place + ": is not a JSON object"};
  for (const auto& [name, value] : json.items())
    if (name != "version" && name != "lights")
      return Error{ErrorKind::usage, place + ": " + in_single_quotes(name) + " is unknown"};
  if (json.value("version", Json()) != 1) return Error{ErrorKind::usage, place + ": 'version' is not 1"};
  const auto lights = json.find("lights");
  if (lights == json.end() || !lights->is_object())
    return Error{ErrorKind::usage, place + ": 'lights' is not an object"};
  LightPatch patch;
  for (const auto& [name, members] : lights->items()) {
    if (!members.is_object())
      return Error{ErrorKind::usage, place + ": light " + in_single_quotes(name) + " is not an object"};
    LightReader reader(members, place + ": light " + in_single_quotes(name));
    LightChange& change = patch.lights[name];
    reader.read("intensity", change.intensity);
    reader.read("color", change.color);
    reader.read("range_m", change.range_m);
    reader.read("width_m", change.width_m);
    reader.read("on", change.on);
    reader.read("shadows", change.shadows);
    reader.read("cookie", change.cookie);
    reader.read("translation", change.translation);
    reader.read("rotation", change.rotation);
    GLOAM_TRY(reader.end());
  }
  return patch;
}

std::string light_patch_text(const LightPatch& patch) {
  Json json = {{"version", 1}, {"lights", Json::object()}};
  for (const auto& [name, change] : patch.lights) json["lights"][name] = json_of(change);
  return json_text(json);
}

Status apply_light_patch(World& world, const LightPatch& patch) {
  const auto& names = world.resource<SceneNames>();
  std::map<std::string, std::vector<Entity>, std::less<>> lights;
  std::string known;
  std::as_const(world).view<const Light>().each([&](Entity entity, const Light&) {
    const std::string name(names.name_of(entity));
    if (lights[name].empty()) known += (known.empty() ? "" : ", ") + name;
    lights[name].push_back(entity);
  });
  for (const auto& [name, change] : patch.lights) {
    const auto found = lights.find(name);
    if (found == lights.end())
      return Error{ErrorKind::usage, "there is no light '" + name + "'; lights: " + (known.empty() ? "none" : known)};
    if (found->second.size() > 1) return Error{ErrorKind::input, "several lights have the name '" + name + "'"};
  }
  for (const auto& [name, change] : patch.lights) apply(world, lights.find(name)->second.front(), change);
  return {};
}

}  // namespace gloam
