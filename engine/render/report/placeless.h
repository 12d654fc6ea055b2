// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/render/module.h"
#include "engine/scene/components.h"

namespace gloam {

/// Adds the first entity that has a T but no WorldTransform, if there is one.
template <class T>
void add_placeless(const World& world, std::string_view fault, std::vector<Oversight>& all) {
  const auto placeless = world.view<const T, Without<WorldTransform>>();
  if (placeless.size() == 0) return;
  Entity first = kNoEntity;
  placeless.each([&](Entity entity, const T&) {
    if (entity.index < first.index) first = entity;
  });
  all.push_back({first, std::string(fault)});
}

}  // namespace gloam
