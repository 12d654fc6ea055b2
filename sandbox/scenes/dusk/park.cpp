// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/dusk/parts.h"

namespace gloam {
namespace {

constexpr vec3 kRailIron(0.028f, 0.032f, 0.034f), kPaint(0.36f, 0.35f, 0.32f), kBark(0.075f, 0.056f, 0.042f);
constexpr vec3 kBenchWood(0.14f, 0.075f, 0.036f);

void add_bandstand(Dusk& dusk) {
  constexpr auto kRadius = static_cast<float>(kDuskBandstandRadius);
  const dvec3 foot(kDuskBandstand.x, lawn_height(kDuskBandstand.x, kDuskBandstand.z) - 0.1, kDuskBandstand.z);
  Model stand;
  const vec2 base[] = {{kRadius, 0.0f},          {kRadius, 0.62f},        {kRadius + 0.08f, 0.64f},
                       {kRadius + 0.08f, 0.74f}, {kRadius - 0.1f, 0.74f}, {0.0f, 0.74f}};
  stand.add(turned_shape(base, 8), vec3(0.24f, 0.21f, 0.19f));
  const vec2 column[] = {{0.09f, 0.0f}, {0.09f, 0.2f}, {0.05f, 0.26f}, {0.045f, 2.2f}, {0.09f, 2.36f}, {0.09f, 2.5f}};
  const Primitive post = turned_shape(column, 8);
  for (int i = 0; i < 8; ++i) {
    const float turn = 2.0f * kPi * static_cast<float>(i) / 8.0f, next = turn + 2.0f * kPi / 8.0f;
    const vec3 at(std::cos(turn) * (kRadius - 0.2f), 0.74f, -std::sin(turn) * (kRadius - 0.2f));
    const vec3 to(std::cos(next) * (kRadius - 0.2f), 0.74f, -std::sin(next) * (kRadius - 0.2f));
    stand.add(post, kPaint, at);
    if (i == 3) continue;  // the steps are here, towards the path
    for (const float y : {0.14f, 0.78f}) {
      const vec3 rail[] = {at + vec3(0, y, 0), to + vec3(0, y, 0)};
      const float radii[] = {0.024f, 0.024f};
      stand.tube(kPaint, rail, radii, 5);
    }
    for (int bar = 1; bar < 9; ++bar) {
      const vec3 foot_of_bar = glm::mix(at, to, static_cast<float>(bar) / 9.0f) + vec3(0, 0.14f, 0);
      stand.box(kPaint, foot_of_bar - vec3(0.011f, 0, 0.011f), foot_of_bar + vec3(0.011f, 0.64f, 0.011f));
    }
  }
  const vec2 roof[] = {{0.0f, 3.3f},
                       {kRadius - 0.1f, 3.18f},
                       {kRadius + 0.42f, 3.12f},
                       {kRadius + 0.44f, 3.28f},
                       {kRadius - 0.2f, 3.56f},
                       {1.15f, 4.3f},
                       {0.5f, 4.85f},
                       {0.42f, 4.95f},
                       {0.42f, 5.4f},
                       {0.55f, 5.45f},
                       {0.16f, 5.85f},
                       {0.03f, 6.5f},
                       {0.0f, 6.5f}};
  stand.add(turned_shape(roof, 8), vec3(0.060f, 0.105f, 0.088f));
  for (int i = 0; i < 3; ++i)
    stand.box(vec3(0.22f, 0.19f, 0.17f), {-kRadius - 0.75f + 0.25f * static_cast<float>(i), 0.0f, -0.75f},
              {-kRadius + 0.3f, 0.25f * static_cast<float>(i + 1), 0.75f});
  add_dusk_model(dusk, "bandstand", stand, dusk.materials.matt, foot);
}

/// Trunk and branches, with the ends of the branches as places for leaves.
struct Branches {
  Model wood;
  std::vector<vec3> ends;
};

Branches tree_branches() {
  Branches tree;
  const vec3 trunk[] = {{0, -0.1f, 0},        {0.03f, 0.25f, 0.0f}, {0.06f, 1.3f, 0.03f},
                        {0.0f, 2.3f, -0.05f}, {0.1f, 3.4f, 0.0f},   {0.05f, 4.4f, 0.1f}};
  const float radii[] = {0.26f, 0.17f, 0.13f, 0.115f, 0.08f, 0.03f};
  tree.wood.tube(kBark, trunk, radii, 9);
  for (std::uint32_t i = 0; i < 13; ++i) {
    const float turn = 2.4f * static_cast<float>(i), share = static_cast<float>(i) / 12.0f;
    const float y = 2.05f + 2.1f * share, reach = (1.9f - 1.0f * share) * (0.8f + 0.35f * dusk_scatter(i, 1u));
    const vec3 out(std::cos(turn), 0.0f, std::sin(turn));
    const vec3 root(0.05f, y, 0.0f), bend = root + reach * 0.5f * out + vec3(0, 0.42f, 0),
                                     end = root + reach * out + vec3(0, 0.75f, 0);
    const vec3 branch[] = {root, bend, end};
    const float width[] = {0.05f, 0.032f, 0.012f};
    tree.wood.tube(kBark, branch, width, 5);
    for (const float side : {-0.7f, 0.6f}) {
      const vec3 across(-out.z, 0.35f, out.x);
      const vec3 twig_end = bend + side * 0.75f * across + 0.35f * out;
      const vec3 twig[] = {bend, twig_end};
      const float twig_width[] = {0.022f, 0.008f};
      tree.wood.tube(kBark, twig, twig_width, 4);
      tree.ends.push_back(twig_end);
    }
    tree.ends.push_back(end);
    tree.ends.push_back(glm::mix(bend, end, 0.55f));
  }
  tree.ends.emplace_back(0.05f, 4.6f, 0.1f);
  return tree;
}

/// A tree that is seen from afar has fewer, larger leaves.
Model tree_leaves(const std::vector<vec3>& ends, bool is_far) {
  const int leaves_at_end = is_far ? 15 : 34;
  constexpr std::array<vec3, 5> kColors = {{{0.30f, 0.40f, 0.06f},
                                            {0.42f, 0.36f, 0.05f},
                                            {0.58f, 0.34f, 0.05f},
                                            {0.52f, 0.20f, 0.04f},
                                            {0.22f, 0.34f, 0.06f}}};
  Model leaves;
  std::uint32_t count = 0;
  for (const vec3& end : ends) {
    for (int i = 0; i < leaves_at_end; ++i, ++count) {
      const auto random = [&](std::uint32_t n) { return 2.0f * dusk_scatter(count, n) - 1.0f; };
      const vec3 at = end + vec3(0.38f * random(1), 0.28f * random(2), 0.38f * random(3));
      const float turn = kPi * random(4), size = (is_far ? 0.11f : 0.072f) + 0.022f * random(6);
      const vec3 u = size * glm::normalize(vec3(std::cos(turn), -0.5f + 0.4f * random(5), std::sin(turn)));
      const vec3 v = 0.62f * size * glm::normalize(vec3(-std::sin(turn), 0.6f * random(7), std::cos(turn)));
      leaves.quad(kColors[count % kColors.size()], at - u, at - v, at + u, at + v);
    }
  }
  return leaves;
}

void add_trees(Dusk& dusk) {
  SceneBuilder& builder = dusk.builder();
  const Branches tree = tree_branches();
  const std::uint32_t wood = builder.add_mesh("tree", tree.wood.shape(), dusk.materials.matt);
  const std::uint32_t leaves =
      builder.add_mesh("tree leaves", tree_leaves(tree.ends, false).shape(), dusk.materials.leaf);
  const std::uint32_t far_leaves =
      builder.add_mesh("far tree leaves", tree_leaves(tree.ends, true).shape(), dusk.materials.leaf);
  struct Place {
    double x, z, heading, size;
    bool is_far;
  };
  constexpr Place kPlaces[] = {{4.55, 0.8, 0.6, 1.0, false},   {10.9, 1.9, 2.1, 1.1, false},
                               {15.6, -2.8, 3.7, 1.2, true},   {7.0, -14.6, 5.0, 1.1, true},
                               {14.8, -14.4, 1.2, 1.25, true}, {16.3, 4.8, 0.2, 1.15, true}};
  for (const Place& place : kPlaces) {
    const double y = place.x < kDuskLawnX ? kDuskPavementY : lawn_height(place.x, place.z);
    builder.add_instance("tree", wood, {place.x, y, place.z}, place.heading, dvec3(place.size));
    const Entity crown = builder.add_instance("tree leaves", place.is_far ? far_leaves : leaves, {place.x, y, place.z},
                                              place.heading, dvec3(place.size));
    dusk.world().get<MeshInstance>(crown).casts_shadows = false;
  }
}

/// A hedge along x or z: a box whose sides bulge.
void add_hedge(Model& model, glm::dvec2 from, glm::dvec2 to, float height_m) {
  const glm::dvec2 along = glm::normalize(to - from);
  const int count = static_cast<int>(glm::length(to - from) / 0.55);
  for (int i = 0; i < count; ++i) {
    const auto number = static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(100.0 + from.x * 7.0);
    const glm::dvec2 at =
        from + along * (0.55 * i + 0.27) + glm::dvec2(along.y, -along.x) * (0.1 * dusk_scatter(number, 3u));
    const float top = height_m * (0.92f + 0.16f * dusk_scatter(number, 1u));
    const vec3 color = glm::mix(vec3(0.030f, 0.050f, 0.020f), vec3(0.045f, 0.066f, 0.022f), dusk_scatter(number, 2u));
    model.ball(color, {at.x, 0.5f * top, at.y}, {0.60f, 0.58f * top, 0.50f}, 8);
  }
}

/// Iron railing between the footway and the lawn, with gaps for the path.
void add_fence(Dusk& dusk) {
  Model fence;
  const auto x = static_cast<float>(kDuskLawnX + 0.1);
  const auto add_piece = [&](float z0, float z1) {
    for (const float y : {0.18f, 0.82f}) fence.box(kRailIron, {x - 0.015f, y, z1}, {x + 0.015f, y + 0.035f, z0});
    const int count = static_cast<int>((z0 - z1) / 0.17f);
    for (int i = 0; i <= count; ++i) {
      const float z = z0 + (z1 - z0) * static_cast<float>(i) / static_cast<float>(count);
      const bool is_post = i % 12 == 0 || i == count;
      const float half = is_post ? 0.03f : 0.009f;
      fence.box(kRailIron, {x - half, -0.02f, z - half}, {x + half, is_post ? 1.02f : 0.93f, z + half});
      if (is_post) fence.ball(kRailIron, {x, 1.05f, z}, vec3(0.05f), 8);
    }
  };
  add_piece(14.0f, 4.2f);
  add_piece(1.5f, -10.6f);
  add_piece(-13.4f, -29.6f);
  const Entity entity = add_dusk_model(dusk, "railing", fence, dusk.materials.matt, {0.0, kDuskPavementY, 0.0});
  dusk.world().get<MeshInstance>(entity).casts_shadows = false;
}

void add_benches(Dusk& dusk) {
  Model bench;
  for (int i = 0; i < 3; ++i)
    bench.box(kBenchWood, {-0.8f, 0.42f, -0.2f + 0.15f * static_cast<float>(i)},
              {0.8f, 0.455f, -0.08f + 0.15f * static_cast<float>(i)});
  for (int i = 0; i < 2; ++i)
    bench.box(kBenchWood, {-0.8f, 0.6f + 0.17f * static_cast<float>(i), -0.29f},
              {0.8f, 0.72f + 0.17f * static_cast<float>(i), -0.26f});
  for (const float side : {-0.66f, 0.66f}) {
    bench.box(kRailIron, {side - 0.03f, 0.0f, 0.12f}, {side + 0.03f, 0.42f, 0.17f});
    bench.box(kRailIron, {side - 0.03f, 0.0f, -0.26f}, {side + 0.03f, 0.9f, -0.21f});
    bench.box(kRailIron, {side - 0.03f, 0.38f, -0.22f}, {side + 0.03f, 0.42f, 0.15f});
  }
  const std::uint32_t mesh = dusk.builder().add_mesh("bench", bench.shape(), dusk.materials.matt);
  struct Place {
    double x, z, heading;
  };
  for (const Place& place : {Place{9.9, -2.4, -0.5 * kPi}, Place{7.2, -6.4, 0.5 * kPi}, Place{10.6, 5.9, 3.6}})
    dusk.builder().add_instance("bench", mesh, {place.x, lawn_height(place.x, place.z), place.z}, place.heading);
}

/// A bicycle on its stand, along x.
void add_bicycle(Dusk& dusk, dvec3 at, double heading) {
  constexpr vec3 kFrame(0.05f, 0.16f, 0.13f), kRubber(0.015f), kSteel(0.20f, 0.21f, 0.22f),
      kLeather(0.10f, 0.045f, 0.02f);
  Model bicycle;
  const auto rod = [&](vec3 color, vec3 from, vec3 to, float radius) {
    const vec3 line[] = {from, to};
    const float radii[] = {radius, radius};
    bicycle.tube(color, line, radii, 6);
  };
  for (const float x : {-0.52f, 0.52f}) {
    std::array<vec3, 19> ring;
    std::array<float, 19> radii;
    radii.fill(0.018f);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const float turn = 2.0f * kPi * static_cast<float>(i) / static_cast<float>(ring.size() - 1);
      ring[i] = {x + 0.32f * std::cos(turn), 0.34f + 0.32f * std::sin(turn), 0.0f};
      rod(kSteel, {x, 0.34f, 0.0f}, ring[i], 0.0025f);
    }
    bicycle.tube(kRubber, ring, radii, 6);
  }
  const vec3 saddle(-0.2f, 0.84f, 0.0f), crank(-0.08f, 0.32f, 0.0f), head(0.36f, 0.80f, 0.0f),
      rear(-0.52f, 0.34f, 0.0f);
  rod(kFrame, crank, saddle, 0.016f);
  rod(kFrame, crank, head - vec3(0.0f, 0.12f, 0.0f), 0.017f);
  rod(kFrame, saddle - vec3(0.0f, 0.1f, 0.0f), head, 0.015f);
  rod(kFrame, rear, crank, 0.011f);
  rod(kFrame, rear, saddle - vec3(0.0f, 0.12f, 0.0f), 0.010f);
  rod(kFrame, head + vec3(-0.03f, 0.12f, 0.0f), {0.52f, 0.34f, 0.0f}, 0.014f);
  for (const float side : {-1.0f, 1.0f}) {
    rod(kSteel, head + vec3(-0.03f, 0.14f, 0.0f), head + vec3(-0.03f, 0.18f, side * 0.24f), 0.010f);
    rod(kRubber, head + vec3(-0.03f, 0.18f, side * 0.24f), head + vec3(-0.16f, 0.17f, side * 0.26f), 0.015f);
  }
  rod(kSteel, crank, {-0.2f, 0.0f, 0.16f}, 0.009f);
  bicycle.ball(kLeather, saddle + vec3(0.0f, 0.04f, 0.0f), {0.14f, 0.035f, 0.075f}, 8);
  const vec2 basket[] = {{0.0f, 0.0f}, {0.13f, 0.0f}, {0.16f, 0.2f}, {0.145f, 0.2f}, {0.11f, 0.03f}};
  bicycle.add(turned_shape(basket, 10), vec3(0.26f, 0.15f, 0.07f), head + vec3(0.17f, -0.02f, 0.0f));
  add_dusk_model(dusk, "bicycle", bicycle, dusk.materials.matt, at, heading);
}

/// Half barrels with bushes, along the kerbs.
void add_planters(Dusk& dusk) {
  const vec2 tub[] = {{0.0f, 0.0f},   {0.27f, 0.0f}, {0.34f, 0.28f}, {0.33f, 0.46f},
                      {0.29f, 0.46f}, {0.28f, 0.4f}, {0.0f, 0.4f}};
  Model planter;
  planter.add(turned_shape(tub, 14), kBenchWood);
  for (const float y : {0.08f, 0.34f}) {
    const vec2 hoop[] = {{0.285f + 0.15f * y, y},
                         {0.30f + 0.15f * y, y},
                         {0.305f + 0.15f * y, y + 0.05f},
                         {0.29f + 0.15f * y, y + 0.05f}};
    planter.add(turned_shape(hoop, 14), kRailIron);
  }
  for (std::uint32_t i = 0; i < 70; ++i) {
    const auto random = [&](std::uint32_t n) { return 2.0f * dusk_scatter(i, 60u + n) - 1.0f; };
    const float turn = kPi * random(1), out = 0.26f * random(2), rise = 0.42f + 0.5f * std::abs(random(3));
    const vec3 root(0.12f * random(4), 0.42f, 0.12f * random(5)), tip(out * std::cos(turn), rise, out * std::sin(turn));
    const vec3 side = 0.045f * glm::normalize(vec3(-std::sin(turn), 0.1f, std::cos(turn)));
    const vec3 color = i % 6 == 0
                           ? vec3(0.45f, 0.10f, 0.09f)
                           : glm::mix(vec3(0.05f, 0.10f, 0.03f), vec3(0.11f, 0.16f, 0.04f), dusk_scatter(i, 70u));
    const vec3 middle = glm::mix(root, tip, 0.6f);
    planter.quad(color, root, middle - side, tip, middle + side);
    planter.quad(color, root, middle + side, tip, middle - side);
  }
  const std::uint32_t mesh = dusk.builder().add_mesh("planter", planter.shape(), dusk.materials.matt);
  for (const glm::dvec2& at :
       {glm::dvec2(3.95, 5.1), {3.95, 5.95}, {-4.0, -1.0}, {-4.0, -11.4}, {4.0, -15.6}, {-4.0, -18.4}})
    dusk.builder().add_instance("planter", mesh, {at.x, kDuskPavementY, at.y}, 1.7 * at.y);
}

}  // namespace

void add_dusk_park(Dusk& dusk) {
  add_bandstand(dusk);
  add_trees(dusk);
  add_fence(dusk);
  add_benches(dusk);
  add_bicycle(dusk, {4.15, kDuskPavementY, 1.75}, 1.95);
  add_planters(dusk);
  Model hedge;
  add_hedge(hedge, {kDuskLawnX + 0.6, kDuskLawnSouthZ + 0.1}, {kDuskLawnEastX, kDuskLawnSouthZ + 0.1}, 1.3f);
  add_hedge(hedge, {kDuskLawnEastX + 0.1, kDuskLawnSouthZ}, {kDuskLawnEastX + 0.1, kDuskLawnNorthZ}, 1.6f);
  add_hedge(hedge, {kDuskLawnX + 0.9, kDuskLawnNorthZ - 0.1}, {kDuskLawnEastX, kDuskLawnNorthZ - 0.1}, 1.3f);
  add_dusk_model(dusk, "hedges", hedge, dusk.materials.matt, {0.0, 0.0, 0.0});
}

}  // namespace gloam
