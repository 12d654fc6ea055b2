// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "engine/ecs/component.h"

namespace gloam {

/// Observes every access to the world that it is set on, and asserts if the access is not allowed. Called on the thread
/// that makes the access, possibly from many threads at once. The checker itself must know which system a thread runs.
class AccessChecker {
 public:
  virtual ~AccessChecker() = default;

  /// Called before values of a component are read or written: by get() and the like, or once per call of a view's
  /// function.
  virtual void component(ComponentId id, bool write) = 0;

  /// Called before a resource, or a resource of a view, of this type is returned.
  virtual void resource(std::string_view type_name, bool write) = 0;

  /// Called before entities or components are added or removed.
  virtual void structure() = 0;
};

}  // namespace gloam
