// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/key_table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>

#include "engine/scene/assets.h"
#include "engine/scene/gltf_import.h"
#include "modules/closeups/components.h"
#include "modules/depth_of_field/components.h"
#include "modules/fog/components.h"
#include "modules/grass/components.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "modules/particles/components.h"
#include "modules/reflections/components.h"
#include "modules/shadows/components.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using Kind = SceneValue::Kind;
using enum KeyElement;

SceneValue number(double value) {
  return {.kind = Kind::number, .number = value, .integral = value == std::floor(value)};
}
SceneValue yes_or_no(bool value) { return {.kind = Kind::boolean, .boolean = value}; }
SceneValue text(std::string value) { return {.kind = Kind::text, .text = std::move(value)}; }
SceneValue list(std::initializer_list<double> values) {
  SceneValue array{.kind = Kind::array};
  for (const double value : values) array.items.push_back(number(value));
  return array;
}

/// A default as the table prints it.
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

/// Where keys are set in this test: a light (the kind that `kind` says), a material, a scene's environment, a folder with a file.
struct Place {
  World world;
  test::TemporaryFolder folder;
  KeyTarget target;

  Place(const ModuleList& modules, LightKind kind) : target{world, kNoEntity, 0, folder.path()} {
    prepare_scene_world(world);
    for (const auto& module : modules) module->register_components(world);
    static_cast<void>(folder.write("file.bin", "content"));
    Light light;
    light.kind = kind;
    target.entity = world.create(light);
    world.resource<SceneAssets>().materials.emplace_back();
  }
};

/// Looks at one member after a key was set: is it what was asked for (false: the member's default)?
using Look = std::function<void(const Place&, bool wanted)>;

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

struct Line {
  KeyElement on;
  const char* name;
  const char* module;
  KeyType type;
  const char* unit;
  const char* default_text;
  SceneValue good;
  std::vector<SceneValue> bad;
  Look look;
  LightKind light = LightKind::spot;
};

std::vector<Line> light_and_closeup_lines() {
  return {
      {light_node,
       "gloam.light.width",
       "lights",
       KeyType::number,
       "m",
       "0",
       number(0.25),
       {number(-1), text("a")},
       field(&Light::width_m, 0.25f)},
      {light_node,
       "gloam.light.shadow",
       "shadows",
       KeyType::boolean,
       "",
       "true",
       yes_or_no(false),
       {text("no"), number(2)},
       field(&ShadowCaster::enabled, false)},
      {light_node,
       "gloam.light.shadow_resolution",
       "shadows",
       KeyType::integer,
       "texels",
       "0",
       number(512),
       {number(0.5), number(-1)},
       field(&ShadowCaster::resolution, 512u)},
      {light_node,
       "gloam.light.angle",
       "lights",
       KeyType::number,
       "degrees",
       "0.53",
       number(90),
       {number(-1), number(91)},
       field(&Light::apparent_angle, kPi / 2.0f),
       LightKind::directional},
      {light_node,
       "gloam.light.cookie",
       "lights",
       KeyType::text,
       "",
       "",
       text("file.bin"),
       {number(1), yes_or_no(true)},
       string_field(&Light::cookie, "/file.bin")},
      {node,
       "gloam.closeup",
       "closeups",
       KeyType::boolean,
       "",
       "false",
       number(1),
       {text("true"), list({1})},
       field(&CloseupSubject::enabled, true)},
      {node,
       "gloam.closeup.lights",
       "closeups",
       KeyType::text,
       "",
       "",
       text("a, b"),
       {number(1)},
       string_field(&CloseupSubject::lights, "a, b")},
      {node,
       "gloam.closeup.priority",
       "closeups",
       KeyType::number,
       "",
       "1",
       number(-2.5),
       {text("high"), yes_or_no(true)},
       field(&CloseupSubject::priority, -2.5f)},
  };
}

std::vector<Line> reflection_lines() {
  return {
      {node,
       "gloam.ibr_proxy.size",
       "reflections",
       KeyType::vec2,
       "m",
       "",
       list({2, 3}),
       {list({2}), list({2, 0}), list({1, 2, 3}), number(1)},
       field(&IbrProxy::size_m, vec2(2.0f, 3.0f))},
      {node,
       "gloam.ibr_proxy.kind",
       "reflections",
       KeyType::choice,
       "",
       "scene",
       text("fire"),
       {text("water"), number(1)},
       field(&IbrProxy::kind, IbrProxyKind::fire)},
      {node,
       "gloam.ibr_proxy.texture",
       "reflections",
       KeyType::text,
       "",
       "",
       text("file.bin"),
       {number(1)},
       string_field(&IbrProxy::texture, "/file.bin")},
      {node,
       "gloam.ibr_proxy.lights",
       "reflections",
       KeyType::text,
       "",
       "",
       text("lamp"),
       {list({1})},
       string_field(&IbrProxy::lights, "lamp")},
      {node,
       "gloam.ibr_room.size",
       "reflections",
       KeyType::vec3,
       "m",
       "",
       list({4, 5, 6}),
       {list({4, 5}), list({4, -5, 6})},
       field(&IbrRoom::size_m, vec3(4.0f, 5.0f, 6.0f))},
      {node,
       "gloam.cube_probe.size",
       "reflections",
       KeyType::vec3,
       "m",
       "",
       list({4, 5, 6}),
       {list({4, 5}), list({0, 5, 6}), text("big")},
       field(&CubeProbe::size_m, vec3(4.0f, 5.0f, 6.0f))},
      {node,
       "gloam.cube_probe.resolution",
       "reflections",
       KeyType::integer,
       "texels",
       "128",
       number(64),
       {number(0), number(1.5), number(1e6)},
       field(&CubeProbe::resolution, 64u)},
      {node,
       "gloam.cube_probe.global",
       "reflections",
       KeyType::boolean,
       "",
       "false",
       yes_or_no(true),
       {text("yes"), number(-1)},
       field(&CubeProbe::global, true)},
  };
}

std::vector<Line> grass_lines() {
  return {
      {mesh_node,
       "gloam.grass.density",
       "grass",
       KeyType::number,
       "blades/m²",
       "0",
       number(400),
       {number(-1), text("dense")},
       field(&GrassSurface::density, 400.0f)},
      {mesh_node,
       "gloam.grass.seed",
       "grass",
       KeyType::integer,
       "",
       "1",
       number(4294967295.0),
       {number(1.5), number(-1), number(4294967296.0)},
       field(&GrassSurface::seed, 4294967295u)},
      {mesh_node,
       "gloam.grass.height",
       "grass",
       KeyType::vec2,
       "m",
       "[0.3, 0.06]",
       list({0.5, 0.1}),
       {number(0.5), list({0.5, -0.1})},
       field(&GrassSurface::height_m, vec2(0.5f, 0.1f))},
      {mesh_node,
       "gloam.grass.width",
       "grass",
       KeyType::number,
       "m",
       "0.006",
       number(0.01),
       {number(0), yes_or_no(true)},
       field(&GrassSurface::width_m, 0.01f)},
      {mesh_node,
       "gloam.grass.max_distance",
       "grass",
       KeyType::number,
       "m",
       "40",
       number(60),
       {number(0), text("far")},
       field(&GrassSurface::max_distance_m, 60.0f)},
      {mesh_node,
       "gloam.grass.types",
       "grass",
       KeyType::text,
       "",
       "",
       text("file.bin"),
       {number(5)},
       string_field(&GrassSurface::types, "/file.bin")},
      {node,
       "gloam.collider",
       "grass",
       KeyType::choice,
       "",
       "",
       text("capsule"),
       {text("none"), text("mesh"), number(1)},
       field(&Collider::shape, ColliderShape::capsule)},
      {node,
       "gloam.collider.radius",
       "grass",
       KeyType::number,
       "m",
       "0.5",
       number(0.25),
       {number(0), number(-1)},
       field(&Collider::radius_m, 0.25f)},
      {node,
       "gloam.collider.height",
       "grass",
       KeyType::number,
       "m",
       "1.8",
       number(2),
       {number(0), text("tall")},
       field(&Collider::height_m, 2.0f)},
      {node,
       "gloam.collider.size",
       "grass",
       KeyType::vec3,
       "m",
       "[1, 1, 1]",
       list({1, 2, 3}),
       {list({1, 2, 0}), number(1)},
       field(&Collider::size_m, vec3(1.0f, 2.0f, 3.0f))},
      {node,
       "gloam.wind.velocity",
       "grass",
       KeyType::vec3,
       "m/s",
       "[0, 0, 0]",
       list({-3, 0, 1}),
       {number(3), list({1e6, 0, 0})},
       field(&Wind::velocity, vec3(-3.0f, 0.0f, 1.0f))},
      {node,
       "gloam.wind.gust",
       "grass",
       KeyType::number,
       "",
       "0.3",
       number(1),
       {number(1.1), number(-0.1)},
       field(&Wind::gust, 1.0f)},
  };
}

std::vector<Line> particle_lines() {
  return {
      {node,
       "gloam.particles",
       "particles",
       KeyType::choice,
       "",
       "",
       text("smoke"),
       {text("none"), text("snow"), yes_or_no(true)},
       field(&ParticleEmitter::kind, EmitterKind::smoke)},
      {node,
       "gloam.particles.rate",
       "particles",
       KeyType::number,
       "1/s",
       "20",
       number(5),
       {number(-1), text("a")},
       field(&ParticleEmitter::rate, 5.0f)},
      {node,
       "gloam.particles.lifetime",
       "particles",
       KeyType::number,
       "s",
       "2",
       number(5),
       {number(0), number(-1)},
       field(&ParticleEmitter::lifetime_s, 5.0f)},
      {node,
       "gloam.particles.size",
       "particles",
       KeyType::number,
       "m",
       "0.3",
       number(0.5),
       {number(0), list({1})},
       field(&ParticleEmitter::size_m, 0.5f)},
      {node,
       "gloam.particles.speed",
       "particles",
       KeyType::number,
       "m/s",
       "0.5",
       number(0),
       {number(-1)},
       field(&ParticleEmitter::speed, 0.0f)},
      {node,
       "gloam.particles.spread",
       "particles",
       KeyType::number,
       "degrees",
       "20",
       number(90),
       {number(-1), number(181)},
       field(&ParticleEmitter::spread, kPi / 2.0f)},
      {node,
       "gloam.particles.box",
       "particles",
       KeyType::vec3,
       "m",
       "[1, 1, 1]",
       list({2, 0, 2}),
       {list({2, 0}), list({2, -1, 2})},
       field(&ParticleEmitter::box_m, vec3(2.0f, 0.0f, 2.0f))},
      {node,
       "gloam.fog.density",
       "fog",
       KeyType::number,
       "1/m",
       "0",
       number(0.02),
       {number(-0.1), text("thick")},
       field(&Fog::density, 0.02f)},
      {node,
       "gloam.fog.color",
       "fog",
       KeyType::vec3,
       "cd/m²",
       "[0, 0, 0]",
       list({1, 2, 3}),
       {list({1, 2}), list({-1, 0, 0})},
       field(&Fog::color, vec3(1.0f, 2.0f, 3.0f))},
  };
}

std::vector<Line> camera_material_and_scene_lines() {
  return {
      {camera_node,
       "gloam.dof.focus",
       "depth_of_field",
       KeyType::number,
       "m",
       "",
       number(4),
       {number(0), number(-1), text("near")},
       field(&DepthOfField::focus_m, 4.0f)},
      {camera_node,
       "gloam.dof.f_number",
       "depth_of_field",
       KeyType::number,
       "",
       "2.8",
       number(1.4),
       {number(0), text("f/2")},
       field(&DepthOfField::f_number, 1.4f)},
      {camera_node,
       "gloam.dof.bokeh",
       "depth_of_field",
       KeyType::choice,
       "",
       "round",
       text("hexagonal"),
       {text("star"), number(6)},
       field(&DepthOfField::bokeh, Bokeh::hexagonal)},
      {material,
       "gloam.reflectivity",
       "engine",
       KeyType::number,
       "",
       "from metallic and roughness",
       number(0.5),
       {number(1.1), number(-0.1)},
       material_field(&Material::reflectivity, 0.5f)},
      {material,
       "gloam.subsurface",
       "engine",
       KeyType::boolean,
       "",
       "false",
       yes_or_no(true),
       {text("true")},
       material_field(&Material::subsurface, true)},
      {scene,
       "gloam.sky.zenith",
       "engine",
       KeyType::vec3,
       "cd/m²",
       "[0, 0, 0]",
       list({1, 2, 3}),
       {list({1, 2}), list({-1, 0, 0})},
       environment(&SceneEnvironment::sky_zenith, vec3(1.0f, 2.0f, 3.0f))},
      {scene,
       "gloam.sky.horizon",
       "engine",
       KeyType::vec3,
       "cd/m²",
       "[0, 0, 0]",
       list({1, 2, 3}),
       {number(1), list({0, 0, -1})},
       environment(&SceneEnvironment::sky_horizon, vec3(1.0f, 2.0f, 3.0f))},
      {scene,
       "gloam.sky.ground",
       "engine",
       KeyType::vec3,
       "cd/m²",
       "[0, 0, 0]",
       list({1, 2, 3}),
       {text("green")},
       environment(&SceneEnvironment::sky_ground, vec3(1.0f, 2.0f, 3.0f))},
      {scene,
       "gloam.exposure",
       "engine",
       KeyType::number,
       "EV100",
       "automatic",
       number(-2),
       {text("auto"), number(1e6)},
       environment(&SceneEnvironment::exposure_ev100, -2.0f)},
  };
}

/// The table of the scene format, line by line.
std::vector<Line> table() {
  std::vector<Line> all;
  for (auto& part : {light_and_closeup_lines(), reflection_lines(), grass_lines(), particle_lines(),
                     camera_material_and_scene_lines()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

struct KeyTable : ::testing::Test {
  ModuleList modules = make_all_modules();
  KeyRegistry registry;
  std::vector<Line> lines = table();

  KeyTable() {
    add_engine_keys(registry);
    for (const auto& module : modules) module->scene_keys(registry);
  }
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
