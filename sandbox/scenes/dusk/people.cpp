// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "engine/scene/resources.h"
#include "modules/closeups/components.h"
#include "modules/grass/components.h"
#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/dusk/figure.h"
#include "sandbox/scenes/dusk/parts.h"

namespace gloam {
namespace {

constexpr double kFullTurn = 2.0 * kPi;

Entity add_person(Dusk& dusk, const std::string& name, const FigureLook& look, dvec3 at, double heading,
                  const char* subject_lights, double size = 1.0) {
  Model model = figure_body(look);
  add_figure_legs(model, look);
  const Entity entity = add_dusk_model(dusk, name, model, dusk.materials.matt, at, heading);
  dusk.world().get<LocalTransform>(entity).scale = dvec3(size);
  if (subject_lights != nullptr) {
    const std::uint32_t lights = dusk.world().resource<SceneStrings>().intern(subject_lights);
    dusk.world().add(entity, CloseupSubject{.enabled = true, .priority = 1.0f, .lights = lights});
  }
  return entity;
}

/// A paper lantern on a stick in the hand of a child or a walker: its paper, its light and its bulb.
void add_hand_lantern(Dusk& dusk, const std::string& name, Entity parent, dvec3 at, float candela) {
  const vec2 outline[] = {{0.05f, -0.19f}, {0.12f, -0.14f}, {0.165f, 0.0f}, {0.12f, 0.14f}, {0.05f, 0.19f}};
  Model paper;
  paper.add(rounded_shape(outline, 14), vec3(0.080f, 0.033f, 0.010f));
  const Entity lantern = add_dusk_model(dusk, name + " lantern", paper, dusk.materials.paper, at);
  dusk.world().get<MeshInstance>(lantern).casts_shadows = false;
  dusk.world().add(lantern, Parent{parent, 1});
  Light light;
  light.color = vec3(1.0f, 0.55f, 0.2f);
  light.intensity = candela;
  light.range_m = 3.8f;
  light.width_m = 0.16f;
  dusk.world().add(dusk.builder().add_light(name + " light", light, at, {0.0, -1.0, 0.0}, false), Parent{parent, 1});
}

/// A parent with an umbrella and a child with a lantern, who look down the street.
void add_family(Dusk& dusk) {
  FigureLook adult{.coat = vec3(0.30f, 0.035f, 0.03f), .trousers = vec3(0.03f, 0.03f, 0.035f)};
  adult.hem_m = 0.42f;
  adult.scarf = vec3(0.34f, 0.28f, 0.18f);
  adult.hair = vec3(0.10f, 0.05f, 0.025f);
  adult.has_umbrella = true;
  adult.umbrella = vec3(0.09f, 0.20f, 0.27f);
  adult.elbows = {vec3(0.30f, 1.10f, 0.0f), vec3(-0.27f, 1.13f, 0.05f)};
  adult.hands = {vec3(0.40f, 0.86f, 0.03f), vec3(-0.15f, 1.18f, 0.27f)};
  add_person(dusk, "parent", adult, {-0.95, 0.0, 2.35}, kPi - 0.12, "lamp 1");
  FigureLook child{.coat = vec3(0.36f, 0.24f, 0.05f), .trousers = vec3(0.03f, 0.04f, 0.08f)};
  child.headwear = Headwear::cap;
  child.head_color = vec3(0.36f, 0.06f, 0.05f);
  child.hem_m = 0.62f;
  // Both face −Z: the child gives its left hand to the parent and holds the stick with its right one.
  child.elbows = {vec3(0.30f, 1.25f, 0.0f), vec3(-0.27f, 1.13f, 0.10f)};
  child.hands = {vec3(0.36f, 1.34f, 0.02f), vec3(-0.36f, 1.12f, 0.34f)};
  const Entity standing = add_person(dusk, "child", child, {-0.22, 0.0, 2.22}, kPi + 0.1, nullptr, 0.63);
  Model stick;
  const vec3 line[] = {{-0.33f, 1.06f, 0.30f}, {-0.75f, 1.36f, 0.62f}, {-0.755f, 1.22f, 0.625f}};
  const float radii[] = {0.012f, 0.01f, 0.006f};
  stick.tube(vec3(0.10f, 0.06f, 0.03f), line, radii, 5);
  dusk.world().add(add_dusk_model(dusk, "stick", stick, dusk.materials.matt, dvec3(0.0)), Parent{standing, 1});
  add_hand_lantern(dusk, "child", standing, {-0.755, 1.03, 0.625}, 4.0f);
}

/// A fiddler in the bandstand.
void add_fiddler(Dusk& dusk) {
  FigureLook look{.detail = 0.6f, .coat = vec3(0.05f, 0.05f, 0.07f), .trousers = vec3(0.02f)};
  look.hem_m = 0.62f;
  look.scarf = vec3(0.45f, 0.06f, 0.05f);
  look.elbows = {vec3(0.32f, 1.18f, 0.16f), vec3(-0.36f, 1.20f, 0.06f)};
  look.hands = {vec3(0.30f, 1.42f, 0.42f), vec3(-0.10f, 1.33f, 0.34f)};
  Model model = figure_body(look);
  add_figure_legs(model, look);
  constexpr vec3 kVarnish(0.26f, 0.09f, 0.03f);
  model.ball(kVarnish, {0.12f, 1.47f, 0.19f}, {0.10f, 0.03f, 0.10f}, 10);
  const vec3 neck[] = {{0.15f, 1.47f, 0.22f}, {0.32f, 1.46f, 0.47f}},
             bow[] = {{-0.14f, 1.33f, 0.36f}, {0.30f, 1.53f, 0.28f}};
  const float neck_radii[] = {0.018f, 0.012f}, bow_radii[] = {0.007f, 0.006f};
  model.tube(kVarnish, neck, neck_radii, 5);
  model.tube(vec3(0.4f, 0.3f, 0.2f), bow, bow_radii, 4);
  const double floor = lawn_height(kDuskBandstand.x, kDuskBandstand.z) - 0.1 + 0.74;
  add_dusk_model(dusk, "fiddler", model, dusk.materials.matt, {kDuskBandstand.x - 0.3, floor, kDuskBandstand.z + 0.4},
                 -0.6);
}

void add_stall_people(Dusk& dusk) {
  FigureLook keeper{.coat = vec3(0.16f, 0.20f, 0.22f), .trousers = vec3(0.05f)};
  keeper.headwear = Headwear::cap;
  keeper.head_color = vec3(0.28f, 0.22f, 0.15f);
  keeper.apron = vec3(0.36f, 0.32f, 0.25f);
  keeper.elbows = {vec3(0.30f, 1.13f, 0.05f), vec3(-0.30f, 1.13f, 0.05f)};
  keeper.hands = {vec3(0.20f, 1.05f, 0.33f), vec3(-0.16f, 1.10f, 0.34f)};
  add_person(dusk, "baker", keeper, {3.85, 0.0, -1.7}, -0.5 * kPi - 0.3, nullptr);
  FigureLook customer{.coat = vec3(0.05f, 0.075f, 0.15f), .trousers = vec3(0.025f)};
  customer.headwear = Headwear::cap;
  customer.head_color = vec3(0.40f, 0.17f, 0.04f);
  customer.scarf = vec3(0.42f, 0.06f, 0.05f);
  customer.elbows = {vec3(0.29f, 1.12f, 0.02f), vec3(-0.28f, 1.12f, 0.06f)};
  customer.hands = {vec3(0.27f, 0.88f, 0.10f), vec3(-0.12f, 1.14f, 0.32f)};
  const Entity buyer = add_person(dusk, "customer", customer, {2.1, 0.0, -2.55}, 0.5 * kPi - 0.42, "stall lamp baker");
  Model cup;
  const vec2 outline[] = {{0.0f, 0.0f}, {0.032f, 0.0f}, {0.04f, 0.1f}, {0.0f, 0.095f}};
  cup.add(turned_shape(outline, 12), vec3(0.6f, 0.55f, 0.46f));
  dusk.world().add(add_dusk_model(dusk, "cup", cup, dusk.materials.matt, {-0.12, 1.13, 0.37}), Parent{buyer, 1});
  FigureLook seller{.detail = 0.6f, .coat = vec3(0.07f, 0.13f, 0.08f), .trousers = vec3(0.04f)};
  seller.headwear = Headwear::hat;
  seller.head_color = vec3(0.11f, 0.075f, 0.05f);
  add_person(dusk, "fruit seller", seller, {3.9, 0.0, -5.0}, -0.5 * kPi - 0.2, nullptr);
  FigureLook old{.detail = 0.6f, .coat = vec3(0.17f, 0.12f, 0.075f), .trousers = vec3(0.03f)};
  old.headwear = Headwear::hat;
  old.head_color = vec3(0.045f);
  old.hem_m = 0.46f;
  add_person(dusk, "buyer", old, {2.1, 0.0, -7.9}, 0.5 * kPi - 0.25, nullptr);
}

/// Two people who warm their hands at the fire.
void add_fire_people(Dusk& dusk) {
  FigureLook look{.detail = 0.6f, .coat = vec3(0.035f, 0.05f, 0.06f), .trousers = vec3(0.03f)};
  look.headwear = Headwear::hat;
  look.head_color = vec3(0.07f, 0.05f, 0.04f);
  look.elbows = {vec3(0.28f, 1.12f, 0.06f), vec3(-0.28f, 1.12f, 0.06f)};
  look.hands = {vec3(0.15f, 1.08f, 0.37f), vec3(-0.15f, 1.05f, 0.38f)};
  add_person(dusk, "left one at the fire", look, kDuskFire + dvec3(-0.88, 0.0, -0.35), 1.19, nullptr);
  look.coat = vec3(0.10f, 0.035f, 0.05f);
  look.headwear = Headwear::hood;
  look.head_color = vec3(0.10f, 0.035f, 0.05f);
  look.hem_m = 0.40f;
  add_person(dusk, "right one at the fire", look, kDuskFire + dvec3(0.62, 0.0, -0.72), -0.71, nullptr);
}

/// A closed way of walking: a stadium whose straight parts are along z, of half length `half_m`.
struct Round {
  glm::dvec2 middle;
  double half_m, radius_m, duration_s, start;
};

glm::dvec2 round_point(const Round& round, double share) {
  const double arc = kPi * round.radius_m, side = 2.0 * round.half_m, length = 2.0 * (arc + side);
  double s = (share - std::floor(share)) * length;
  if (s < side) return round.middle + glm::dvec2(round.radius_m, round.half_m - s);
  s -= side;
  if (s < arc) {
    const double turn = s / round.radius_m;
    return round.middle + glm::dvec2(round.radius_m * std::cos(turn), -round.half_m - round.radius_m * std::sin(turn));
  }
  s -= arc;
  if (s < side) return round.middle + glm::dvec2(-round.radius_m, -round.half_m + s);
  const double turn = (s - side) / round.radius_m;
  return round.middle + glm::dvec2(-round.radius_m * std::cos(turn), round.half_m + round.radius_m * std::sin(turn));
}

std::vector<PoseKey> round_keys(const Round& round, double (*height)(double x, double z)) {
  std::vector<PoseKey> keys;
  const int count = static_cast<int>(std::lround(round.duration_s * 5.0));
  for (int i = 0; i <= count; ++i) {
    const double share = round.start + static_cast<double>(i) / count;
    const glm::dvec2 at = round_point(round, share), ahead = round_point(round, share + 0.004) - at;
    keys.push_back({round.duration_s * i / count,
                    {at.x, height(at.x, at.y), at.y},
                    glm::angleAxis(std::atan2(ahead.x, ahead.y), dvec3(0.0, 1.0, 0.0))});
  }
  return keys;
}

void add_dusk_walker(Dusk& dusk, const std::string& name, const FigureLook& look, const Round& round,
                     double (*height)(double x, double z), bool has_lantern) {
  const std::vector<PoseKey> keys = round_keys(round, height);
  const Entity root = dusk.builder().add_group(name, keys.front().translation);
  dusk.builder().add_clip(name, root, keys);
  // Walkers cast no shadows: the maps of all lamps that they pass stay as they are.
  const Entity body = add_dusk_model(dusk, name + " body", figure_body(look), dusk.materials.matt, dvec3(0.0));
  dusk.world().get<MeshInstance>(body).casts_shadows = false;
  dusk.world().add(body, Parent{root, 1});
  if (has_lantern) {
    add_hand_lantern(dusk, name, root, {look.hands[1] + vec3(0.0f, -0.24f, 0.05f)}, 2.4f);
    dusk.world().add<Collider>(root, {.shape = ColliderShape::capsule, .radius_m = 0.25f, .height_m = 1.7f});
  }
  const std::uint32_t leg = dusk.builder().add_mesh(name + " leg", figure_leg(look).shape(), dusk.materials.matt);
  for (const double side : {-1.0, 1.0}) {
    const dvec3 hip(side * 0.095, kFigureHip_m, 0.0);
    const Entity limb = dusk.builder().add_instance(name + " leg", leg, hip);
    dusk.world().get<MeshInstance>(limb).casts_shadows = false;
    dusk.world().add(limb, Parent{root, 1});
    constexpr double kStride_s = 1.1;
    std::vector<PoseKey> swing;
    for (int i = 0; i <= 12; ++i)
      swing.push_back({kStride_s * i / 12.0, hip,
                       glm::angleAxis(side * 0.42 * std::sin(kFullTurn * i / 12.0), dvec3(1.0, 0.0, 0.0))});
    dusk.builder().add_clip(name + (side < 0.0 ? " right leg" : " left leg"), limb, swing);
  }
}

double pavement_height(double, double) { return kDuskPavementY; }

}  // namespace

void add_dusk_figures(Dusk& dusk) {
  add_family(dusk);
  add_stall_people(dusk);
  add_fire_people(dusk);
  add_fiddler(dusk);
  FigureLook stroller{.detail = 0.6f, .coat = vec3(0.045f, 0.05f, 0.06f), .trousers = vec3(0.02f)};
  stroller.headwear = Headwear::hat;
  stroller.head_color = vec3(0.03f);
  stroller.hem_m = 0.48f;
  stroller.has_umbrella = true;
  stroller.umbrella = vec3(0.20f, 0.03f, 0.03f);
  stroller.hands[1] = vec3(-0.15f, 1.18f, 0.27f);
  stroller.elbows[1] = vec3(-0.27f, 1.13f, 0.05f);
  add_dusk_walker(dusk, "stroller", stroller, {{-5.0, -8.5}, 8.5, 0.27, 34.0, 0.12}, &pavement_height, false);
  FigureLook lamplighter{.detail = 0.6f, .coat = vec3(0.10f, 0.085f, 0.05f), .trousers = vec3(0.03f)};
  lamplighter.headwear = Headwear::cap;
  lamplighter.head_color = vec3(0.07f, 0.09f, 0.16f);
  lamplighter.scarf = vec3(0.10f, 0.14f, 0.26f);
  lamplighter.hands[1] = vec3(-0.30f, 1.02f, 0.34f);
  lamplighter.elbows[1] = vec3(-0.30f, 1.12f, 0.04f);
  add_dusk_walker(dusk, "lantern bearer", lamplighter, {{12.6, -1.5}, 1.5, 1.5, 17.0, 0.51}, &lawn_height, true);
}

}  // namespace gloam
