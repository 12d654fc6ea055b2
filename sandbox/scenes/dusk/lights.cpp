// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/dusk/parts.h"

namespace gloam {
namespace {

constexpr vec3 kLampIron(0.026f, 0.030f, 0.032f);
constexpr double kLanternY = 3.35;  // of the light of a street lamp

/// A post with a lantern of four panes and a roof.
Model lamp_post() {
  Model post;
  const vec2 shaft[] = {{0.15f, 0.0f},  {0.15f, 0.12f}, {0.1f, 0.2f},   {0.095f, 0.75f}, {0.11f, 0.8f},  {0.06f, 0.9f},
                        {0.04f, 2.95f}, {0.08f, 3.0f},  {0.05f, 3.06f}, {0.11f, 3.12f},  {0.11f, 3.15f}, {0.0f, 3.15f}};
  post.add(turned_shape(shaft, 8), kLampIron);
  const vec2 roof[] = {{0.0f, 3.56f},  {0.26f, 3.56f}, {0.27f, 3.59f}, {0.1f, 3.76f},
                       {0.04f, 3.79f}, {0.03f, 3.88f}, {0.0f, 3.92f}};
  post.add(turned_shape(roof, 8), kLampIron);
  for (const float x : {-1.0f, 1.0f})
    for (const float z : {-1.0f, 1.0f}) {
      const vec3 bar[] = {{0.075f * x, 3.14f, 0.075f * z}, {0.145f * x, 3.57f, 0.145f * z}};
      const float radii[] = {0.011f, 0.011f};
      post.tube(kLampIron, bar, radii, 4);
    }
  return post;
}

void add_lamp_posts(Dusk& dusk) {
  SceneBuilder& builder = dusk.builder();
  const std::uint32_t post = builder.add_mesh("lamp post", lamp_post().shape(), dusk.materials.matt);
  const std::uint32_t bulb = builder.add_mesh("lamp bulb", sphere_shape(0.075f, 12), dusk.materials.bulb);
  const vec2 panes[] = {{0.105f, 3.15f}, {0.205f, 3.56f}};
  Model glass;
  glass.add(turned_shape(panes, 4), vec3(1.0f, 0.86f, 0.62f),
            mat4(glm::mat4_cast(glm::angleAxis(0.25f * kPi, vec3(0, 1, 0)))));
  const std::uint32_t pane = builder.add_mesh("lamp glass", glass.shape(), dusk.materials.glass);
  struct Place {
    double x, z;
    bool casts;
    float candela;
  };
  constexpr Place kPlaces[] = {{-3.75, 11.4, false, 50.0f},  {-3.75, 2.2, true, 36.0f},    {-3.75, -7.2, true, 34.0f},
                               {-3.75, -14.6, false, 34.0f}, {-3.75, -22.6, false, 34.0f}, {4.3, 7.6, true, 46.0f},
                               {4.3, -13.2, false, 34.0f},   {4.3, -21.4, false, 34.0f},   {9.7, 4.5, false, 30.0f},
                               {6.6, -1.8, false, 40.0f},    {7.45, -5.0, false, 40.0f},   {6.5, -9.2, false, 40.0f},
                               {14.6, 1.4, false, 20.0f},    {12.0, -15.0, false, 20.0f}};
  int count = 0;
  for (const Place& place : kPlaces) {
    const double y = place.x < kDuskLawnX ? kDuskPavementY : lawn_height(place.x, place.z);
    const dvec3 foot(place.x, y, place.z), light = foot + dvec3(0.0, kLanternY, 0.0);
    std::vector<Entity> parts = {builder.add_instance("lamp post", post, foot),
                                 builder.add_instance("lamp bulb", bulb, light)};
    if (place.casts) parts.push_back(builder.add_instance("lamp glass", pane, foot));  // seen from near by
    for (const Entity part : parts) dusk.world().get<MeshInstance>(part).casts_shadows = false;
    // A wide cone downwards: the roof of the lantern keeps the light from the sky.
    add_street_lamp(
        dusk.street, "lamp " + std::to_string(count++),
        {.color = kDuskAmber, .candela = place.candela, .range_m = 7.5f, .width_m = 0.08f, .outer_angle = 1.45f}, light,
        {0.0, -1.0, 0.0}, place.casts);
  }
}

/// Bulbs on a cord from a to b that hangs through by sag_m. One bulb of `every` has a light.
void add_bulb_string(Dusk& dusk, const std::string& name, dvec3 a, dvec3 b, double sag_m, int bulbs, StreetLamp lamp,
                     int every = 1) {
  SceneBuilder& builder = dusk.builder();
  const auto at = [&](double t) { return glm::mix(a, b, t) - dvec3(0.0, 4.0 * sag_m * t * (1.0 - t), 0.0); };
  constexpr int kPieces = 10;
  std::vector<vec3> line;
  const std::vector<float> radii(kPieces + 1, 0.009f);
  for (int i = 0; i <= kPieces; ++i) line.emplace_back(at(static_cast<double>(i) / kPieces));
  Model model;
  model.tube(vec3(0.02f), line, radii, 3);
  for (int i = 0; i < bulbs; ++i)
    model.ball(vec3(0.03f), vec3(at((i + 0.5) / bulbs) - dvec3(0.0, 0.045, 0.0)), {0.02f, 0.04f, 0.02f}, 4);
  const Entity cord = add_dusk_model(dusk, name + " cord", model, dusk.materials.matt, dvec3(0.0));
  dusk.world().get<MeshInstance>(cord).casts_shadows = false;
  static constexpr float kBulb_m = 0.042f;
  const std::uint32_t mesh = builder.add_mesh(name + " bulb", sphere_shape(kBulb_m, 6), dusk.materials.small_bulb);
  for (int i = 0; i < bulbs; ++i) {
    const dvec3 place = at((i + 0.5) / bulbs) - dvec3(0.0, 0.11, 0.0);
    const Entity bulb = builder.add_instance(name + " bulb", mesh, place);
    dusk.world().get<MeshInstance>(bulb).casts_shadows = false;
    if (i % every == 0)
      add_street_lamp(dusk.street, name + " " + std::to_string(i), lamp, place, {0.0, -1.0, 0.0}, false);
  }
}

void add_strings(Dusk& dusk) {
  const StreetLamp street{.color = kDuskWarm, .candela = 4.2f, .range_m = 4.4f, .width_m = 0.08f};
  const StreetLamp small{.color = kDuskWarm, .candela = 0.9f, .range_m = 2.3f, .width_m = 0.08f};
  const StreetLamp awning{.color = kDuskWarm, .candela = 0.35f, .range_m = 2.0f, .width_m = 0.08f};
  // Over the street, from the houses to masts behind the stalls.
  struct Span {
    double z0, z1;
  };
  constexpr Span kSpans[] = {{2.6, -0.1}, {-3.6, -3.6}, {-8.0, -6.9}, {-12.6, -10.3}, {-17.6, -15.0}};
  Model mast;
  const vec2 pole[] = {{0.05f, 0.0f}, {0.035f, 4.6f}, {0.06f, 4.62f}, {0.0f, 4.72f}};
  mast.add(turned_shape(pole, 8), vec3(0.16f, 0.15f, 0.13f));
  const std::uint32_t mesh = dusk.builder().add_mesh("mast", mast.shape(), dusk.materials.matt);
  int count = 0;
  for (const Span& span : kSpans) {
    dusk.builder().add_instance("mast", mesh, {4.75, kDuskPavementY, span.z1});
    add_bulb_string(dusk, "string " + std::to_string(count++), {kDuskFacadeX + 0.02, 4.9, span.z0},
                    {4.75, 4.7, span.z1}, 0.75, 8, street, 2);
  }
  // From mast to mast behind the stalls, and under the awnings.
  for (int i = 0; i + 1 < 4; ++i)
    add_bulb_string(dusk, "market string " + std::to_string(i), {4.75, 4.65, kSpans[i].z1},
                    {4.75, 4.65, kSpans[i + 1].z1}, 0.5, 4, small);
  for (const double z : {-1.9, -5.2, -8.5})
    add_bulb_string(dusk, "awning string " + std::to_string(count++), {2.2, 2.27, z + 1.4}, {2.2, 2.27, z - 1.4}, 0.08,
                    6, awning);
  // Around the roof of the bandstand.
  const double foot = lawn_height(kDuskBandstand.x, kDuskBandstand.z) - 0.1;
  for (int i = 0; i < 8; ++i) {
    const double a = 0.25 * double{kPi} * i, b = a + 0.25 * double{kPi}, r = kDuskBandstandRadius + 0.36;
    const dvec3 middle(kDuskBandstand.x, foot + 3.16, kDuskBandstand.z);
    add_bulb_string(dusk, "bandstand string " + std::to_string(i),
                    middle + dvec3(r * std::cos(a), 0.0, -r * std::sin(a)),
                    middle + dvec3(r * std::cos(b), 0.0, -r * std::sin(b)), 0.14, 3, small);
  }
  add_street_lamp(dusk.street, "bandstand lamp",
                  {.color = kDuskWarm, .candela = 17.0f, .range_m = 6.5f, .width_m = 0.15f},
                  {kDuskBandstand.x, foot + 2.9, kDuskBandstand.z}, {0.0, -1.0, 0.0}, true);
}

/// Lamps in the grass that shine up into trees.
void add_tree_lamps(Dusk& dusk) {
  struct Place {
    double x, z;
    vec3 color;
    bool casts;
  };
  constexpr Place kPlaces[] = {{11.6, 2.7, vec3(1.0f, 0.62f, 0.26f), false},
                               {15.1, -3.7, vec3(1.0f, 0.55f, 0.22f), false},
                               {7.6, -15.2, vec3(1.0f, 0.62f, 0.26f), false},
                               {14.3, -13.4, vec3(1.0f, 0.50f, 0.20f), false}};
  int count = 0;
  for (const Place& place : kPlaces) {
    const dvec3 at(place.x, lawn_height(place.x, place.z) + 0.25, place.z);
    add_street_lamp(dusk.street, "tree lamp " + std::to_string(count++),
                    {.color = place.color, .candela = 75.0f, .range_m = 6.5f, .width_m = 0.1f, .outer_angle = 0.75f},
                    at, {-0.12, 1.0, -0.12}, place.casts);
  }
}

/// Lanterns of paper: over the counter of the last stall, and in the branches of the tree at the street.
void add_paper_lanterns(Dusk& dusk) {
  SceneBuilder& builder = dusk.builder();
  const vec2 outline[] = {{0.05f, -0.17f}, {0.12f, -0.13f}, {0.165f, 0.0f}, {0.12f, 0.13f}, {0.05f, 0.17f}};
  struct Place {
    dvec3 at;
    vec3 color;
    double period_s;
    float size;
  };
  constexpr Place kPlaces[] = {{{2.55, 2.28, -7.6}, vec3(0.78f, 0.20f, 0.12f), 3.1, 0.9f},
                               {{2.55, 2.28, -8.2}, vec3(0.78f, 0.48f, 0.14f), 2.7, 0.8f},
                               {{2.55, 2.28, -8.8}, vec3(0.30f, 0.50f, 0.60f), 3.4, 0.9f},
                               {{2.55, 2.28, -9.4}, vec3(0.70f, 0.26f, 0.34f), 2.9, 0.8f},
                               {{3.85, 3.0, 1.75}, vec3(0.80f, 0.32f, 0.12f), 3.3, 1.25f},
                               {{4.75, 2.75, 1.95}, vec3(0.74f, 0.38f, 0.10f), 2.8, 1.1f},
                               {{10.2, 2.7, 1.1}, vec3(0.80f, 0.32f, 0.12f), 3.6, 1.3f},
                               {{11.7, 2.5, 1.2}, vec3(0.74f, 0.38f, 0.10f), 3.0, 1.2f}};
  int count = 0;
  for (const Place& place : kPlaces) {
    const std::string name = "paper lantern " + std::to_string(count++);
    const Entity joint = builder.add_group(name, place.at);
    Model paper, cap;
    paper.add(rounded_shape(outline, 12), place.color * 0.10f, vec3(0.0f, -0.4f, 0.0f));
    cap.box(vec3(0.02f), {-0.004f, -0.24f, -0.004f}, {0.004f, 0.0f, 0.004f});
    for (const float y : {-0.24f, -0.58f}) cap.box(vec3(0.03f), {-0.05f, y, -0.05f}, {0.05f, y + 0.02f, 0.05f});
    const Entity parts[] = {add_dusk_model(dusk, name + " paper", paper, dusk.materials.paper, dvec3(0.0)),
                            add_dusk_model(dusk, name + " frame", cap, dusk.materials.matt, dvec3(0.0))};
    dusk.world().get<LocalTransform>(joint).scale = dvec3(place.size);
    for (const Entity part : parts) {
      dusk.world().get<MeshInstance>(part).casts_shadows = false;
      dusk.world().add(part, Parent{joint, 1});
    }
    Light light;
    light.color = glm::normalize(place.color + vec3(0.12f, 0.06f, 0.02f));
    light.intensity = 3.2f;
    light.range_m = 4.0f;
    light.width_m = 0.16f;
    dusk.world().add(builder.add_light(name + " light", light, {0.0, -0.4, 0.0}, {0.0, -1.0, 0.0}, false),
                     Parent{joint, 1});
    std::vector<PoseKey> swing;
    for (int i = 0; i <= 12; ++i)
      swing.push_back(
          {place.period_s * i / 12.0, place.at,
           glm::angleAxis(0.10 * std::sin(2.0 * double{kPi} * i / 12.0), glm::normalize(dvec3(1.0, 0.0, 0.6)))});
    builder.add_clip(name, joint, swing);
  }
}

}  // namespace

void add_dusk_lights(Dusk& dusk) {
  add_lamp_posts(dusk);
  add_strings(dusk);
  add_tree_lamps(dusk);
  add_paper_lanterns(dusk);
}

}  // namespace gloam
