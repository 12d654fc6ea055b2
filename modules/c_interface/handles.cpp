// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/c_interface/handles.h"

#include <atomic>

namespace gloam::c_interface {

std::uintptr_t next_handle() {
  static std::atomic<std::uintptr_t> next{1};
  return next.fetch_add(1);
}

HandleTable<EngineObject, gloam_engine>& engines() {
  static auto& table = *new HandleTable<EngineObject, gloam_engine>();
  return table;
}

HandleTable<WorldObject, gloam_world>& worlds() {
  static auto& table = *new HandleTable<WorldObject, gloam_world>();
  return table;
}

}  // namespace gloam::c_interface
