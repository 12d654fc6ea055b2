// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gloam {

/// Settings by name.
using SettingValue = std::variant<std::string, std::vector<double>>;
using Settings = std::map<std::string, SettingValue>;

/// Changes of settings that the user has made, to take them back and to make them again. A change has only the settings
/// that differ, so that taking it back leaves the others, which may have changed by themselves, alone.
class UndoStack {
 public:
  static constexpr std::size_t kMost = 200;  ///< changes; older ones are forgotten

  /// After each frame of the panel: the settings before and after the user's input. held: a widget is being dragged or
  /// typed into; all changes until it is let go are one.
  void note(const Settings& before, const Settings& after, bool held);

  /// The settings to restore; none if there is no such change.
  [[nodiscard]] std::optional<Settings> undo();
  [[nodiscard]] std::optional<Settings> redo();

 private:
  struct Change {
    Settings before;
    Settings after;
  };
  std::vector<Change> done_;
  std::vector<Change> undone_;  ///< the last one was undone last
  bool open_ = false;           ///< the last change goes on
};

}  // namespace gloam
