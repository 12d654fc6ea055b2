// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/keys/table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "modules/fog/components.h"
#include "modules/grass/components.h"
#include "modules/particles/components.h"
#include "tests/modules/keys/line_checks.h"

namespace gloam {
namespace {

using test::Line;
using test::list;
using test::number;
using test::Place;
using test::text;
using test::yes_or_no;
using Kind = SceneValue::Kind;

struct KeyTable : ::testing::Test {
  ModuleList modules = make_all_modules();
  KeyRegistry registry = make_key_registry(modules);
  static Status set(const SceneKey& key, const SceneValue& value, KeyTarget& target) {
    return test::set_key(key, value, target);
  }
};

TEST_F(KeyTable, holds_the_lines_of_the_scene_format) {
  std::map<std::string, std::vector<Line>> of_module;
  for (const Line& line : test::scene_format_table()) of_module[line.module].push_back(line);
  for (const auto& [module, lines] : of_module) test::expect_key_lines(module, lines);
}

// The tests below need no lines: they hold for the keys of every module.

/// Values that no key of this type and range takes.
std::vector<SceneValue> bad_values(const SceneKey& key) {
  const double too_small = key.min - 1.0, too_great = key.max + 1.0;
  const bool from = too_small<key.min, to = too_great> key.max;
  std::vector<SceneValue> bad = {{}, {.kind = Kind::object}, {.kind = Kind::array}};
  const auto vectors = [&](std::size_t count) {
    for (const std::size_t wrong : {count - 1, count + 1})
      bad.push_back({.kind = Kind::array, .items = std::vector<SceneValue>(wrong, number(key.max))});
    bad.push_back({.kind = Kind::array, .items = std::vector<SceneValue>(count, text("a"))});
    if (from) bad.push_back({.kind = Kind::array, .items = std::vector<SceneValue>(count, number(too_small))});
    if (to) bad.push_back({.kind = Kind::array, .items = std::vector<SceneValue>(count, number(too_great))});
  };
  switch (key.type) {
    case KeyType::boolean:
      bad.insert(bad.end(), {text("true"), number(2)});
      break;
    case KeyType::integer:
      bad.push_back(number(0.5 * key.min + 0.5 * key.max + 0.25));
      [[fallthrough]];
    case KeyType::number:
      bad.insert(bad.end(), {text("1"), yes_or_no(true)});
      if (from) bad.push_back(number(too_small));
      if (to) bad.push_back(number(too_great));
      break;
    case KeyType::vec2:
      vectors(2);
      break;
    case KeyType::vec3:
      vectors(3);
      break;
    case KeyType::choice:
      bad.insert(bad.end(), {text("no choice"), number(0)});
      break;
    case KeyType::text:
      bad.insert(bad.end(), {number(1), yes_or_no(true)});
  }
  return bad;
}

TEST_F(KeyTable, every_key_has_a_name_of_the_project_a_module_and_a_meaning) {
  std::set<std::string> names, known = {"engine"};
  for (const auto& module : modules) known.emplace(module->name());
  for (const SceneKey& key : registry.keys()) {
    SCOPED_TRACE(key.name);
    EXPECT_TRUE(names.insert(key.name).second);
    EXPECT_TRUE(key.name.starts_with("gloam."));
    EXPECT_TRUE(known.contains(key.module)) << key.module;
    EXPECT_FALSE(key.meaning.empty());
    EXPECT_TRUE(key.set != nullptr);
    EXPECT_LT(key.min, key.max);
  }
}

// Hard case: scene.wrong_type, scene.out_of_range
TEST_F(KeyTable, every_key_refuses_other_types_and_values_out_of_range) {
  for (const SceneKey& key : registry.keys()) {
    SCOPED_TRACE(key.name);
    Place place(modules, LightKind::spot);
    for (const SceneValue& value : bad_values(key)) {
      const Status status = set(key, value, place.target);
      ASSERT_FALSE(status.ok());
      EXPECT_EQ(status.error().kind, ErrorKind::input);
      EXPECT_THAT(status.error().message, ::testing::StartsWith("must be "));
    }
  }
}

TEST_F(KeyTable, every_key_takes_the_ends_of_its_range) {
  for (const SceneKey& key : registry.keys()) {
    SCOPED_TRACE(key.name);
    for (const double end : {key.min, key.max}) {
      if (std::abs(end) > 1e30) continue;  // no bound
      SceneValue value = number(end);
      if (key.type == KeyType::vec2) value = list({end, end});
      if (key.type == KeyType::vec3) value = list({end, end, end});
      if (value.kind == Kind::number && key.type != KeyType::number && key.type != KeyType::integer) continue;
      bool taken = false;  // some keys of lights are for one kind of light
      for (const LightKind kind : {LightKind::spot, LightKind::directional}) {
        Place place(modules, kind);
        taken = taken || set(key, value, place.target).ok();
      }
      EXPECT_TRUE(taken) << end;
    }
  }
}

TEST_F(KeyTable, every_choice_can_be_chosen) {
  for (const SceneKey& key : registry.keys()) {
    if (key.type != KeyType::choice) continue;
    EXPECT_GE(key.choices.size(), 2u) << key.name;
    for (const std::string& choice : key.choices) {
      Place place(modules, LightKind::spot);
      EXPECT_TRUE(set(key, text(choice), place.target).ok()) << key.name << " " << choice;
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
  for (const char* name :
       {"gloam.light.cookie", "gloam.ibr_proxy.texture", "gloam.grass.types", "gloam.grass.texture"}) {
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
