// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/keys.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/ecs/view.h"
#include "engine/scene/keys/table.h"
#include "engine/scene/units.h"
#include "modules/lights/components.h"

namespace gloam {
namespace {

constexpr double kHalfPi = 1.5707963267948966;

/// Light definitions of the file's root, which its nodes refer to by index; a resource while the file is read.
struct LightDefinitions {
  std::vector<Light> lights;
};

/// The message only: the reader of the file adds the location.
Error fault(std::string message) { return {ErrorKind::input, std::move(message)}; }

/// `range`: [min, max] in words, for the message.
Status read_number(const SceneValue& object, const char* name, double min, double max, const char* range,
                   float& target) {
  const SceneValue* value = object.find(name);
  if (value == nullptr) return {};
  if (value->kind != SceneValue::Kind::number || !(value->number >= min && value->number <= max))
    return fault(std::string(name) + " must be a number " + range);
  target = static_cast<float>(value->number);
  return {};
}

Status read_color(const SceneValue& object, vec3& color) {
  const SceneValue* value = object.find("color");
  if (value == nullptr) return {};
  if (value->kind != SceneValue::Kind::array || value->items.size() != 3) return fault("color must be three numbers");
  for (std::size_t c = 0; c < 3; ++c) {
    const SceneValue& item = value->items[c];
    if (item.kind != SceneValue::Kind::number || !(item.number >= 0.0 && item.number <= 1e6))
      return fault("color must be three numbers in 0…1000000");
    color[static_cast<int>(c)] = static_cast<float>(item.number);
  }
  return {};
}

Status read_spot(const SceneValue& object, Light& light) {
  const SceneValue* spot = object.find("spot");
  light.inner_angle = 0.0f;
  light.outer_angle = static_cast<float>(kHalfPi / 2.0);
  if (spot == nullptr) return {};
  if (spot->kind != SceneValue::Kind::object) return fault("spot must be an object");
  constexpr const char* kAngles = "in 0…π/2 (half of a cone of at most 180°)";
  // A half angle over π/2 is a cone over 180° and is refused. The tolerance accepts files that rounded π/2 up.
  GLOAM_TRY(read_number(*spot, "innerConeAngle", 0.0, kHalfPi + 1e-6, kAngles, light.inner_angle));
  GLOAM_TRY(read_number(*spot, "outerConeAngle", 0.0, kHalfPi + 1e-6, kAngles, light.outer_angle));
  if (light.outer_angle <= 0.0f) return fault("outerConeAngle must be above 0");
  if (light.inner_angle > light.outer_angle) return fault("innerConeAngle must not exceed outerConeAngle");
  light.outer_angle = std::min(light.outer_angle, static_cast<float>(kHalfPi));
  return {};
}

Result<Light> read_light(const SceneValue& object) {
  Light light;
  const SceneValue* type = object.find("type");
  if (type == nullptr || type->kind != SceneValue::Kind::text) return fault("a light needs a type");
  if (type->text == "point")
    light.kind = LightKind::point;
  else if (type->text == "spot")
    light.kind = LightKind::spot;
  else if (type->text == "directional")
    light.kind = LightKind::directional;
  else
    return fault("type \"" + type->text + "\" is none of point, spot, directional");
  constexpr double kLeast = std::numeric_limits<double>::denorm_min(), kMost = std::numeric_limits<float>::max();
  GLOAM_TRY(read_color(object, light.color));
  GLOAM_TRY(read_number(object, "intensity", 0.0, 1e12, "in 0…1e12", light.intensity));
  GLOAM_TRY(read_number(object, "range", kLeast, kMost, "above 0, at most 3.4e38", light.range_m));
  // A positive number may round to 0, which would mean no range.
  if (object.find("range") != nullptr) light.range_m = std::max(light.range_m, std::numeric_limits<float>::min());
  if (light.kind == LightKind::spot) GLOAM_TRY(read_spot(object, light));
  return light;
}

Status begin_file(World& world, const SceneValue* root) {
  LightDefinitions definitions;
  if (root != nullptr) {
    const SceneValue* lights = root->find("lights");
    if (lights == nullptr || lights->kind != SceneValue::Kind::array) return fault("lights must be an array");
    for (std::size_t i = 0; i < lights->items.size(); ++i) {
      auto light = read_light(lights->items[i]);
      if (!light.ok()) return fault("light " + std::to_string(i) + ": " + light.error().message);
      definitions.lights.push_back(*light);
    }
  }
  world.set_resource(std::move(definitions));
  return {};
}

Status read_node(KeyTarget& target, const SceneValue& node) {
  const auto& lights = target.world.resource<LightDefinitions>().lights;
  const SceneValue* index = node.find("light");
  if (index == nullptr || index->kind != SceneValue::Kind::number || !(index->number >= 0.0) ||
      index->number != std::floor(index->number))
    return fault("must name its light by a whole number");
  if (index->number >= static_cast<double>(lights.size()))
    return fault("names a light that does not exist, the file has " + std::to_string(lights.size()));
  target.world.add<Light>(target.entity, lights[static_cast<std::size_t>(index->number)]);
  SceneNames& names = target.world.resource<SceneNames>();
  if (const std::string name(names.name_of(target.entity)); !name.empty()) names.add("light", name, target.entity);
  return {};
}

SceneKey angle_key() {
  SceneKey key = key_line("lights", KeyElement::light_node, "gloam.light.angle", "0.53", "degrees",
                          "apparent diameter of a directional light, which sets the width of penumbrae");
  key.type = KeyType::number;
  key.min = 0.0;
  key.max = 90.0;
  key.set = [](KeyTarget& target, const KeyValue& value) -> Status {
    Light& light = target.world.get<Light>(target.entity);
    if (light.kind != LightKind::directional) return fault("is for directional lights, others have gloam.light.width");
    light.apparent_angle = static_cast<float>(std::get<double>(value) * (kHalfPi / 90.0));
    return {};
  };
  return key;
}

SceneKey cookie_key() {
  SceneKey key =
      key_line("lights", KeyElement::light_node, "gloam.light.cookie", "", "", "image file that a spot light projects");
  key.type = KeyType::text;
  key.set = [](KeyTarget& target, const KeyValue& value) -> Status {
    Light& light = target.world.get<Light>(target.entity);
    if (light.kind != LightKind::spot) return fault("projects an image, which only a spot does");
    const auto file = intern_scene_file(target, std::get<std::string>(value));
    if (!file.ok()) return file.error();
    light.cookie = *file;
    return {};
  };
  return key;
}

}  // namespace

void add_light_keys(KeyRegistry& registry) {
  registry.add_extension({"lights", "KHR_lights_punctual", &begin_file, &read_node});
  registry.set_light_test([](const World& world, Entity entity) { return world.try_get<Light>(entity) != nullptr; });
  registry.add(number_key(key_line("lights", KeyElement::light_node, "gloam.light.width", "0", "m",
                                   "diameter of the emitter of a point or spot light; 0: hard shadows"),
                          0, 1e4, &Light::width_m));
  registry.add(angle_key());
  // Candela are per square metre of distance.
  registry.add_finish("lights", [](World& world) -> Status {
    const double unit_m = metres_per_unit(world);
    world.view<Light>().each([&](Light& light) {
      if (light.kind != LightKind::directional)
        light.intensity = static_cast<float>(light.intensity / (unit_m * unit_m));
    });
    return {};
  });
  registry.add(cookie_key());
}

}  // namespace gloam
