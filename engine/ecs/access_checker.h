// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "engine/ecs/component.h"

namespace gloam {

/// Sees every access to a world it is set on. Called from whichever thread makes the access, possibly from many at
/// once; knowing which system that thread runs is the checker's business. It reports by asserting.
class AccessChecker {
 public:
  virtual ~AccessChecker() = default;

  /// Values of a component are about to be read or written: by get, or once a call of a view's each, …
  virtual void component(ComponentId id, bool write) = 0;

  /// A resource or a view's resource of this type is about to be handed out.
  virtual void resource(std::string_view type_name, bool write) = 0;

  /// Entities or components are about to come or go.
  virtual void structure() = 0;
};

}  // namespace gloam
