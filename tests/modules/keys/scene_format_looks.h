// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tests/modules/keys/scene_format_table.h"

namespace gloam::test {

template <class T>
void expect_same(const T& actual, const T& expected) {
  if constexpr (std::is_floating_point_v<T>)
    EXPECT_NEAR(actual, expected, std::abs(expected) * 1e-6f);
  else
    EXPECT_EQ(actual, expected);
}
template <class C, class T>
Look field(T C::*member, std::type_identity_t<T> expected) {
  return [=](const Place& place, bool wanted) {
    const C* component = place.world.try_get<C>(place.target.entity);
    ASSERT_NE(component, nullptr);
    expect_same(component->*member, wanted ? expected : C{}.*member);
  };
}
template <class T>
Look environment(T SceneEnvironment::*member, std::type_identity_t<T> expected) {
  return [=](const Place& place, bool wanted) {
    expect_same(place.world.resource<SceneEnvironment>().*member, wanted ? expected : SceneEnvironment{}.*member);
  };
}
template <class T>
Look material_field(T Material::*member, std::type_identity_t<T> expected) {
  return [=](const Place& place, bool wanted) {
    expect_same(place.world.resource<SceneAssets>().materials.at(0).*member, wanted ? expected : Material{}.*member);
  };
}
template <class C>
Look string_field(std::uint32_t C::*member, std::string expected_end) {
  return [=](const Place& place, bool) {
    const C* component = place.world.try_get<C>(place.target.entity);
    ASSERT_NE(component, nullptr);
    EXPECT_THAT(place.world.resource<SceneStrings>().text(component->*member), ::testing::EndsWith(expected_end));
  };
}

// Parts of scene_format_table() that are in separate files.
std::vector<Line> grass_lines();
std::vector<Line> particle_lines();

}  // namespace gloam::test
