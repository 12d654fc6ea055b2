// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/ecs/type_key.h"

namespace gloam {

enum class AccessKind : std::uint8_t { component, resource, view_resource };

/// One component or resource that a system accesses.
struct Access {
  AccessKind kind = AccessKind::component;
  TypeKey key = TypeKey::none;  ///< type_key of the component or resource
  std::string_view name;        ///< its type_name
  bool write = false;
};

/// All accesses of a system, as its signature states them.
struct SystemAccess {
  std::vector<Access> accesses;  ///< each kind and key once
  bool commands = false;         ///< records structural changes
  bool per_view = false;         ///< takes a parameter that exists only in Stage::view

  /// Adds an access. A second access to the same kind and key is merged: the result writes if either writes.
  void declare(const Access& access);
  /// The declared access to this kind and key; null if there is none.
  [[nodiscard]] const Access* find(AccessKind kind, TypeKey key) const;
};

/// Whether the two systems must not run at the same time: both access the same component or resource and at least one
/// writes it. Filters of views and commands do not count (commands are applied when all systems of the stage have
/// ended).
[[nodiscard]] bool conflict(const SystemAccess& a, const SystemAccess& b);

}  // namespace gloam
