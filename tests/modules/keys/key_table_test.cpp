// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/key_table.h"

#include <gmock/gmock.h>

#include <set>
#include <sstream>
#include <string>

#include "modules/fog/components.h"
#include "modules/grass/components.h"
#include "modules/particles/components.h"
#include "tests/modules/keys/scene_format_table.h"

namespace gloam {
namespace {

using test::Line;
using test::list;
using test::number;
using test::Place;
using test::text;
using test::yes_or_no;
using Kind = SceneValue::Kind;

/// The value of a default as the table prints it.
SceneValue parsed(const std::string& words) {
  if (words == "true" || words == "false") return yes_or_no(words == "true");
  if (words.front() == '[') {
    SceneValue array{.kind = Kind::array};
    std::istringstream in(words.substr(1));
    double value = 0.0;
    for (char separator = ','; separator == ',' && in >> value; in >> separator) array.items.push_back(number(value));
    return array;
  }
  std::istringstream in(words);
  double value = 0.0;
  return in >> value ? number(value) : text(words);
}

struct KeyTable : ::testing::Test {
  ModuleList modules = make_all_modules();
  KeyRegistry registry = make_key_registry(modules);
  std::vector<Line> lines = test::scene_format_table();
  static Status set(const SceneKey& key, const SceneValue& value, KeyTarget& target) {
    const auto converted = KeyRegistry::convert(key, value);
    return converted.ok() ? key.set(target, *converted) : Status(converted.error());
  }
};

TEST_F(KeyTable, has_exactly_the_keys_of_the_scene_format) {
  std::set<std::string> expected;
  for (const Line& line : lines) EXPECT_TRUE(expected.insert(line.name).second) << line.name;
  std::set<std::string> actual;
  for (const SceneKey& key : registry.keys()) EXPECT_TRUE(actual.insert(key.name).second) << key.name;
  EXPECT_EQ(actual, expected);
}

TEST_F(KeyTable, says_where_a_key_stands_its_type_unit_default_and_meaning) {
  for (const Line& line : lines) {
    const SceneKey* key = registry.find(line.name);
    ASSERT_NE(key, nullptr) << line.name;
    EXPECT_EQ(key->on, line.on) << line.name;
    EXPECT_EQ(key->module, line.module) << line.name;
    EXPECT_EQ(key->type, line.type) << line.name;
    EXPECT_EQ(key->unit, line.unit) << line.name;
    EXPECT_EQ(key->default_text, line.default_text) << line.name;
    EXPECT_FALSE(key->meaning.empty()) << line.name;
    EXPECT_TRUE(key->set != nullptr) << line.name;
    EXPECT_LT(key->min, key->max) << line.name;
  }
}

TEST_F(KeyTable, stores_values) {
  for (const Line& line : lines) {
    SCOPED_TRACE(line.name);
    Place place(modules, line.light);
    const Status status = set(*registry.find(line.name), line.good, place.target);
    ASSERT_TRUE(status.ok()) << status.error().message;
    line.look(place, true);
  }
}

TEST_F(KeyTable, refuses_wrong_types_and_values_out_of_range) {
  for (const Line& line : lines) {
    SCOPED_TRACE(line.name);
    Place place(modules, line.light);
    std::vector<SceneValue> bad = line.bad;
    bad.push_back({});
    bad.push_back({.kind = Kind::object});
    bad.push_back({.kind = Kind::array});
    for (const SceneValue& value : bad) {
      const Status status = set(*registry.find(line.name), value, place.target);
      ASSERT_FALSE(status.ok());
      EXPECT_EQ(status.error().kind, ErrorKind::input);
      EXPECT_THAT(status.error().message, ::testing::StartsWith("must be "));
    }
  }
}

TEST_F(KeyTable, prints_the_default_that_a_component_has) {
  for (const Line& line : lines) {
    const std::string words = line.default_text;
    if (words.empty() || words == "automatic" || words.starts_with("from ")) continue;
    SCOPED_TRACE(line.name);
    Place place(modules, line.light);
    const Status status = set(*registry.find(line.name), parsed(words), place.target);
    ASSERT_TRUE(status.ok()) << status.error().message;
    line.look(place, false);
  }
}

TEST_F(KeyTable, every_choice_can_be_chosen) {
  for (const Line& line : lines) {
    const SceneKey& key = *registry.find(line.name);
    if (line.type != KeyType::choice) continue;
    EXPECT_GE(key.choices.size(), 2u) << line.name;
    for (const std::string& choice : key.choices) {
      Place place(modules, line.light);
      EXPECT_TRUE(set(key, text(choice), place.target).ok()) << line.name << " " << choice;
    }
  }
  Place place(modules, LightKind::spot);
  const std::pair<const char*, EmitterKind> kinds[] = {{"fog", EmitterKind::fog},
                                                       {"dust", EmitterKind::dust},
                                                       {"smoke", EmitterKind::smoke},
                                                       {"fire", EmitterKind::fire}};
  for (const auto& [word, kind] : kinds) {
    ASSERT_TRUE(set(*registry.find("gloam.particles"), text(word), place.target).ok());
    EXPECT_EQ(place.world.get<ParticleEmitter>(place.target.entity).kind, kind);
  }
  const std::pair<const char*, ColliderShape> shapes[] = {
      {"sphere", ColliderShape::sphere}, {"capsule", ColliderShape::capsule}, {"box", ColliderShape::box}};
  for (const auto& [word, shape] : shapes) {
    ASSERT_TRUE(set(*registry.find("gloam.collider"), text(word), place.target).ok());
    EXPECT_EQ(place.world.get<Collider>(place.target.entity).shape, shape);
  }
}

TEST_F(KeyTable, keeps_what_earlier_keys_of_a_component_said) {
  Place place(modules, LightKind::spot);
  ASSERT_TRUE(set(*registry.find("gloam.grass.density"), number(30), place.target).ok());
  ASSERT_TRUE(set(*registry.find("gloam.grass.width"), number(0.01), place.target).ok());
  const auto& grass = place.world.get<GrassSurface>(place.target.entity);
  EXPECT_EQ(grass.density, 30.0f);
  EXPECT_EQ(grass.width_m, 0.01f);
}

TEST_F(KeyTable, exposure_is_automatic_until_it_is_set) {
  Place place(modules, LightKind::spot);
  EXPECT_FALSE(place.world.resource<SceneEnvironment>().has_exposure);
  ASSERT_TRUE(set(*registry.find("gloam.exposure"), number(0), place.target).ok());
  EXPECT_TRUE(place.world.resource<SceneEnvironment>().has_exposure);
}

TEST_F(KeyTable, files_must_be_in_the_scenes_folder) {
  for (const char* name : {"gloam.light.cookie", "gloam.ibr_proxy.texture", "gloam.grass.types"}) {
    for (const char* file : {"absent.bin", "../file.bin", "/etc/passwd", "", "."}) {
      Place place(modules, LightKind::spot);
      const Status status = set(*registry.find(name), text(file), place.target);
      ASSERT_FALSE(status.ok()) << name << " " << file;
      EXPECT_EQ(status.error().kind, ErrorKind::input);
    }
  }
}

TEST_F(KeyTable, finds_the_nearest_key_for_a_typing_mistake) {
  EXPECT_EQ(registry.nearest("gloam.light.widht"), "gloam.light.width");
  EXPECT_EQ(registry.nearest("gloam.grass.densty"), "gloam.grass.density");
  EXPECT_EQ(registry.nearest("gloam.fog.colour"), "gloam.fog.color");
}

TEST_F(KeyTable, allows_one_wind_and_one_fog_a_scene) {
  Place place(modules, LightKind::spot);
  EXPECT_TRUE(registry.finish(place.world).ok());
  place.world.create(Wind{});
  place.world.create(Fog{});
  EXPECT_TRUE(registry.finish(place.world).ok());
  const Entity second = place.world.create(Wind{});
  const Status winds = registry.finish(place.world);
  ASSERT_FALSE(winds.ok());
  EXPECT_EQ(winds.error().message, "gloam.wind may stand on one node a scene, but stands on 2");
  place.world.destroy(second);
  place.world.create(Fog{});
  const Status fogs = registry.finish(place.world);
  ASSERT_FALSE(fogs.ok());
  EXPECT_EQ(fogs.error().message, "gloam.fog may stand on one node a scene, but stands on 2");
}

TEST_F(KeyTable, resolves_light_names_of_closeups_and_proxies_at_the_end) {
  for (const char* name : {"gloam.closeup.lights", "gloam.ibr_proxy.lights"}) {
    Place place(modules, LightKind::spot);
    place.world.resource<SceneNames>().add("light", "lamp", place.target.entity);
    ASSERT_TRUE(set(*registry.find(name), text("lamp"), place.target).ok());
    EXPECT_TRUE(registry.finish(place.world).ok());
    ASSERT_TRUE(set(*registry.find(name), text("lamp, lantern"), place.target).ok());
    const Status status = registry.finish(place.world);
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().message,
                ::testing::AllOf(::testing::StartsWith(name), ::testing::HasSubstr("\"lantern\"")));
  }
}

}  // namespace
}  // namespace gloam
