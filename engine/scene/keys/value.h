// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gloam {

struct SceneMember;

/// A JSON-like value as found in a scene file's extras and extensions.
struct SceneValue {
  enum class Kind { null, boolean, number, text, array, object };
  Kind kind = Kind::null;
  bool boolean = false;
  double number = 0.0;
  bool integral = false;  ///< the number was written without fraction or exponent
  std::string text;
  std::vector<SceneValue> items;
  std::vector<SceneMember> members;  ///< in file order

  /// The member of an object, or null when absent.
  [[nodiscard]] const SceneValue* find(std::string_view name) const;
};

/// One named value of an object.
struct SceneMember {
  std::string name;
  SceneValue value;
};

inline const SceneValue* SceneValue::find(std::string_view name) const {
  for (const SceneMember& member : members)
    if (member.name == name) return &member.value;
  return nullptr;
}

}  // namespace gloam
