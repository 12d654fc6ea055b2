// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "engine/scene/keys/registry.h"
#include "engine/scene/resources.h"
#include "engine/scene/scene_path.h"

namespace gloam {

/// Component C of the target's entity; added with defaults if absent.
template <class C>
C& component_of(KeyTarget& target) {
  if (C* there = target.world.try_get<C>(target.entity)) return *there;
  return target.world.add<C>(target.entity, C{});
}

/// Input error if `count` > 1, for a property that only one node of a scene may have. `what`: subject of the message.
[[nodiscard]] inline Status at_most_one(std::size_t count, const std::string& what) {
  if (count <= 1) return {};
  return Error{ErrorKind::input, what + " may stand on one node a scene, but stands on " + std::to_string(count)};
}

/// A key without type, range and setter, which the functions below add.
[[nodiscard]] inline SceneKey key_line(std::string module, KeyElement on, std::string name, std::string default_text,
                                       std::string unit, std::string meaning) {
  SceneKey key;
  key.module = std::move(module);
  key.on = on;
  key.name = std::move(name);
  key.default_text = std::move(default_text);
  key.unit = std::move(unit);
  key.meaning = std::move(meaning);
  return key;
}

/// The setter stores a number, times `factor` (file units → code units), in a float member of component C.
template <class C>
[[nodiscard]] SceneKey number_key(SceneKey key, double min, double max, float C::*member, double factor = 1.0) {
  key.type = KeyType::number;
  key.min = min;
  key.max = max;
  key.set = [member, factor](KeyTarget& target, const KeyValue& value) -> Status {
    component_of<C>(target).*member = static_cast<float>(std::get<double>(value) * factor);
    return {};
  };
  return key;
}

template <class C>
[[nodiscard]] SceneKey integer_key(SceneKey key, double min, double max, std::uint32_t C::*member) {
  key.type = KeyType::integer;
  key.min = min;
  key.max = max;
  key.set = [member](KeyTarget& target, const KeyValue& value) -> Status {
    component_of<C>(target).*member = static_cast<std::uint32_t>(std::get<long long>(value));
    return {};
  };
  return key;
}

template <class C>
[[nodiscard]] SceneKey boolean_key(SceneKey key, bool C::*member) {
  key.type = KeyType::boolean;
  key.set = [member](KeyTarget& target, const KeyValue& value) -> Status {
    component_of<C>(target).*member = std::get<bool>(value);
    return {};
  };
  return key;
}

template <class C>
[[nodiscard]] SceneKey vec2_key(SceneKey key, double min, double max, vec2 C::*member) {
  key.type = KeyType::vec2;
  key.min = min;
  key.max = max;
  key.set = [member](KeyTarget& target, const KeyValue& value) -> Status {
    component_of<C>(target).*member = std::get<vec2>(value);
    return {};
  };
  return key;
}

template <class C>
[[nodiscard]] SceneKey vec3_key(SceneKey key, double min, double max, vec3 C::*member) {
  key.type = KeyType::vec3;
  key.min = min;
  key.max = max;
  key.set = [member](KeyTarget& target, const KeyValue& value) -> Status {
    component_of<C>(target).*member = std::get<vec3>(value);
    return {};
  };
  return key;
}

/// The setter stores the enumerator of the chosen word: `first` is the enumerator of choices[0], the others follow in
/// order.
template <class C, class Enum>
[[nodiscard]] SceneKey choice_key(SceneKey key, std::vector<std::string> choices, Enum first, Enum C::*member) {
  key.type = KeyType::choice;
  key.choices = choices;
  key.set = [choices = std::move(choices), first, member](KeyTarget& target, const KeyValue& value) -> Status {
    const std::string& word = std::get<std::string>(value);
    for (std::size_t i = 0; i < choices.size(); ++i)
      if (choices[i] == word) component_of<C>(target).*member = static_cast<Enum>(static_cast<std::size_t>(first) + i);
    return {};
  };
  return key;
}

/// The setter adds the string to SceneStrings and stores its number.
template <class C>
[[nodiscard]] SceneKey text_key(SceneKey key, std::uint32_t C::*member) {
  key.type = KeyType::text;
  key.set = [member](KeyTarget& target, const KeyValue& value) -> Status {
    const std::uint32_t id = target.world.resource<SceneStrings>().intern(std::get<std::string>(value));
    component_of<C>(target).*member = id;
    return {};
  };
  return key;
}

/// Adds the path of a file in the scene's folder to SceneStrings and returns its number. Input error if the file is
/// absent or outside the folder.
[[nodiscard]] inline Result<std::uint32_t> intern_scene_file(KeyTarget& target, const std::string& name) {
  auto path = resolve_scene_path(target.directory, name);
  if (!path.ok()) return path.error();
  std::error_code error;
  if (!std::filesystem::is_regular_file(*path, error))
    return Error{ErrorKind::input, "names a file that is absent: " + *path};
  return target.world.resource<SceneStrings>().intern(*path);
}

/// The setter stores the number from intern_scene_file.
template <class C>
[[nodiscard]] SceneKey file_key(SceneKey key, std::uint32_t C::*member) {
  key.type = KeyType::text;
  key.set = [member](KeyTarget& target, const KeyValue& value) -> Status {
    const auto id = intern_scene_file(target, std::get<std::string>(value));
    if (!id.ok()) return id.error();
    component_of<C>(target).*member = *id;
    return {};
  };
  return key;
}

}  // namespace gloam
