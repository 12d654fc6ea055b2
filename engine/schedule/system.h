// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/schedule/access.h"
#include "engine/schedule/parameters.h"

namespace gloam {

/// When systems run: once per frame for the world, then once for each view. A set of flags.
enum class Stage : std::uint8_t { world = 1, view = 2 };

[[nodiscard]] constexpr Stage operator|(Stage a, Stage b) {
  return static_cast<Stage>(static_cast<std::uint8_t>(a) | static_cast<std::uint8_t>(b));
}
[[nodiscard]] constexpr bool contains(Stage set, Stage stage) {
  return (static_cast<std::uint8_t>(set) & static_cast<std::uint8_t>(stage)) != 0;
}

/// A registered system.
struct System {
  std::string name;
  std::string module;
  Stage stages = Stage::world;
  SystemAccess access;
  std::vector<std::uint32_t> after;  ///< indices of earlier systems that this one waits for, regardless of their access
  std::function<void(const SystemContext&)> run;
  Commands commands;
  bool failed = false;  ///< it threw in the last run of its stage
};

/// The access list that follows from a function's signature.
template <class... Parameters>
[[nodiscard]] SystemAccess access_of(void (*)(Parameters...)) {
  SystemAccess access;
  (detail::SystemParameter<Parameters>::declare(access), ...);
  return access;
}

/// Wraps a system's function: the parameters are made from the context.
template <class... Parameters>
[[nodiscard]] std::function<void(const SystemContext&)> bind_system(void (*function)(Parameters...)) {
  return [function]([[maybe_unused]] const SystemContext& context) {
    function(detail::SystemParameter<Parameters>::make(context)...);
  };
}

}  // namespace gloam
