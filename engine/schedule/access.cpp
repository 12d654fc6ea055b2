// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/schedule/access.h"

#include <algorithm>

namespace gloam {

void SystemAccess::declare(const Access& access) {
  for (Access& known : accesses) {
    if (known.kind != access.kind || known.key != access.key) continue;
    known.write = known.write || access.write;
    return;
  }
  accesses.push_back(access);
}

const Access* SystemAccess::find(AccessKind kind, TypeKey key) const {
  const auto found = std::ranges::find_if(accesses, [&](const Access& a) { return a.kind == kind && a.key == key; });
  return found == accesses.end() ? nullptr : &*found;
}

bool conflict(const SystemAccess& a, const SystemAccess& b) {
  return std::ranges::any_of(a.accesses, [&](const Access& mine) {
    const Access* other = b.find(mine.kind, mine.key);
    return other != nullptr && (mine.write || other->write);
  });
}

}  // namespace gloam
