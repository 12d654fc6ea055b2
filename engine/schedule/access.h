// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace gloam {

enum class AccessKind : std::uint8_t { component, resource, view_resource };

/// One thing a system touches.
struct Access {
  AccessKind kind = AccessKind::component;
  const void* key = nullptr;  ///< type_key of the component or resource
  std::string_view name;      ///< type_name of it
  bool write = false;
};

/// Everything a system touches, as its signature states it.
struct SystemAccess {
  std::vector<Access> accesses;  ///< each kind and key once
  bool commands = false;         ///< records structural changes
  bool per_view = false;         ///< makes sense only for a view

  /// Adds an access; a second one to the same thing widens the first.
  void declare(const Access& access);
  /// Null if the thing is not declared.
  [[nodiscard]] const Access* find(AccessKind kind, const void* key) const;
};

/// Whether the two may not run at once: they share a thing and one writes it. Filters of views do not count, commands
/// neither (they are applied when all systems of the stage have ended).
[[nodiscard]] bool conflict(const SystemAccess& a, const SystemAccess& b);

}  // namespace gloam
