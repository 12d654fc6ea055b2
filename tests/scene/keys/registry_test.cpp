// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/keys/registry.h"

#include <gmock/gmock.h>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using Kind = SceneValue::Kind;

SceneValue number(double value) {
  return {.kind = Kind::number, .number = value, .integral = value == static_cast<double>(static_cast<int>(value))};
}
SceneValue text(std::string value) { return {.kind = Kind::text, .text = std::move(value)}; }
SceneValue boolean(bool value) { return {.kind = Kind::boolean, .boolean = value}; }
SceneValue list(std::vector<double> values) {
  SceneValue result{.kind = Kind::array};
  for (const double value : values) result.items.push_back(number(value));
  return result;
}

SceneKey key_of(KeyType type) {
  SceneKey key;
  key.name = "gloam.test";
  key.type = type;
  return key;
}

std::string fault_of(const SceneKey& key, const SceneValue& value) {
  const Result<KeyValue> converted = KeyRegistry::convert(key, value);
  return converted ? "(none)" : converted.error().message;
}

TEST(KeyRegistry, a_number_outside_its_range_is_told_with_range_and_unit) {
  SceneKey key = key_of(KeyType::number);
  key.min = 0.0;
  key.unit = "m";
  EXPECT_EQ(fault_of(key, text("wide")), "must be a number ≥ 0 m, is \"wide\"");
  EXPECT_EQ(fault_of(key, number(-0.5)), "must be a number ≥ 0 m, is -0.5");
  key.unit.clear();
  key.max = 1.0;
  EXPECT_EQ(fault_of(key, number(1.5)), "must be a number in 0…1, is 1.5");
  EXPECT_DOUBLE_EQ(std::get<double>(*KeyRegistry::convert(key, number(0.25))), 0.25);
}

TEST(KeyRegistry, booleans_may_be_0_or_1) {
  const SceneKey key = key_of(KeyType::boolean);
  EXPECT_TRUE(std::get<bool>(*KeyRegistry::convert(key, boolean(true))));
  EXPECT_TRUE(std::get<bool>(*KeyRegistry::convert(key, number(1))));
  EXPECT_FALSE(std::get<bool>(*KeyRegistry::convert(key, number(0))));
  EXPECT_EQ(fault_of(key, number(2)), "must be true or false, is 2");
  EXPECT_EQ(fault_of(key, text("yes")), "must be true or false, is \"yes\"");
}

TEST(KeyRegistry, integers_must_be_whole) {
  SceneKey key = key_of(KeyType::integer);
  key.min = 1.0;
  EXPECT_EQ(std::get<long long>(*KeyRegistry::convert(key, number(128.0))), 128);
  EXPECT_EQ(fault_of(key, number(1.5)), "must be an integer ≥ 1, is 1.5");
  EXPECT_EQ(fault_of(key, number(1e18)), "must be an integer ≥ 1, is 1e+18");
}

TEST(KeyRegistry, vectors_have_exactly_their_length_and_every_component_in_range) {
  SceneKey key = key_of(KeyType::vec3);
  key.min = 0.0;
  EXPECT_EQ(std::get<vec3>(*KeyRegistry::convert(key, list({1, 2, 3}))), vec3(1, 2, 3));
  EXPECT_EQ(fault_of(key, list({1, 2})), "must be 3 numbers ≥ 0, is [1, 2]");
  EXPECT_EQ(fault_of(key, list({1, 2, -3})), "must be 3 numbers ≥ 0, is [1, 2, -3]");
  EXPECT_EQ(fault_of(key, list({1, 2, 1e300})), "must be 3 numbers ≥ 0, is [1, 2, 1e+300]");
  EXPECT_EQ(fault_of(key_of(KeyType::vec2), number(3)), "must be 2 numbers, is 3");
}

TEST(KeyRegistry, choices_are_listed_when_none_fits) {
  SceneKey key = key_of(KeyType::choice);
  key.choices = {"sphere", "capsule", "box"};
  EXPECT_EQ(std::get<std::string>(*KeyRegistry::convert(key, text("box"))), "box");
  EXPECT_EQ(fault_of(key, text("cube")), R"(must be "sphere", "capsule" or "box", is "cube")");
  EXPECT_EQ(fault_of(key, {}), R"(must be "sphere", "capsule" or "box", is null)");
}

TEST(KeyRegistry, texts_are_texts) {
  EXPECT_EQ(std::get<std::string>(*KeyRegistry::convert(key_of(KeyType::text), text("key,rim"))), "key,rim");
  EXPECT_EQ(fault_of(key_of(KeyType::text), {.kind = Kind::object}), "must be a string, is an object");
}

TEST(KeyRegistry, a_misspelt_key_gets_the_nearest_known_one) {
  KeyRegistry registry;
  add_engine_keys(registry);
  EXPECT_EQ(registry.nearest("gloam.exposur"), "gloam.exposure");
  EXPECT_EQ(registry.nearest("gloam.sky.zentih"), "gloam.sky.zenith");
  EXPECT_EQ(registry.nearest("gloam.something.else"), "");
  EXPECT_EQ(registry.nearest(std::string(100000, 'g')), "");
}

TEST(KeyRegistry, a_key_is_registered_once) {
  KeyRegistry registry;
  registry.add(key_of(KeyType::text));
  EXPECT_ASSERT(registry.add(key_of(KeyType::number)), "a scene key is registered once: gloam.test");
}

TEST(KeyRegistry, finishers_run_in_order_until_one_fails) {
  KeyRegistry registry;
  std::string ran;
  registry.add_finish("a", [&](World&) -> Status {
    ran += "a";
    return {};
  });
  registry.add_finish("b", [&](World&) -> Status { return Error{ErrorKind::input, "b found a fault"}; });
  registry.add_finish("c", [&](World&) -> Status {
    ran += "c";
    return {};
  });
  World world;
  const Status status = registry.finish(world);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "b found a fault");
  EXPECT_EQ(ran, "a");
}

TEST(KeyRegistry, nothing_is_a_light_until_somebody_says_so) {
  KeyRegistry registry;
  const World world;
  EXPECT_FALSE(registry.is_light(world, kNoEntity));
  registry.set_light_test([](const World&, Entity) { return true; });
  EXPECT_TRUE(registry.is_light(world, kNoEntity));
}

TEST(EngineKeys, set_the_environment_and_the_material) {
  KeyRegistry registry;
  add_engine_keys(registry);
  World world;
  prepare_scene_world(world);
  world.resource<SceneAssets>().materials.resize(2);
  KeyTarget scene{world, kNoEntity, ~0u, ""};
  ASSERT_TRUE(registry.find("gloam.sky.ground")->set(scene, KeyValue(vec3(1, 2, 3))).ok());
  ASSERT_TRUE(registry.find("gloam.exposure")->set(scene, KeyValue(-2.0)).ok());
  KeyTarget material{world, kNoEntity, 1, ""};
  ASSERT_TRUE(registry.find("gloam.subsurface")->set(material, KeyValue(true)).ok());
  ASSERT_TRUE(registry.find("gloam.reflectivity")->set(material, KeyValue(0.5)).ok());
  const auto& environment = world.resource<SceneEnvironment>();
  EXPECT_EQ(environment.sky_ground, vec3(1, 2, 3));
  EXPECT_TRUE(environment.has_exposure);
  EXPECT_EQ(environment.exposure_ev100, -2.0f);
  EXPECT_TRUE(world.resource<SceneAssets>().materials[1].subsurface);
  EXPECT_EQ(world.resource<SceneAssets>().materials[1].reflectivity, 0.5f);
  EXPECT_EQ(world.resource<SceneAssets>().materials[0].reflectivity, -1.0f);
}

}  // namespace
}  // namespace gloam
