// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <utility>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "sandbox/bench/ecs/case.h"

namespace gloam::bench {
namespace {

void add_number(Hasher& hasher, float number) { hasher.value(std::bit_cast<std::uint32_t>(number)); }

void append(std::vector<Content>& contents, const BareTable::Columns& columns) {
  for (std::size_t i = 0; i < columns.things.size(); ++i) {
    const bool has_mass = !columns.masses.empty();
    contents.push_back({columns.things[i], columns.positions[i], columns.velocities[i], has_mass,
                        has_mass ? columns.masses[i] : Mass{}});
  }
}

}  // namespace

std::uint64_t hash_of_contents(std::vector<Content> contents) {
  std::ranges::sort(contents, {}, &Content::index);
  Hasher hasher;
  hasher.value(contents.size());
  for (const Content& c : contents) {
    hasher.value(c.index).value(c.has_mass);
    for (const float number : {c.position.x, c.position.y, c.position.z}) add_number(hasher, number);
    for (const float number : {c.velocity.x, c.velocity.y, c.velocity.z}) add_number(hasher, number);
    if (c.has_mass) add_number(hasher, c.mass.kg);
  }
  return hasher.digest();
}

std::uint64_t content_hash(World& world) {
  std::vector<Content> contents;
  world.view<const Position, const Velocity, Maybe<const Mass>>().each(
      [&](Entity entity, const Position& position, const Velocity& velocity, const Mass* mass) {
        contents.push_back({entity.index, position, velocity, mass != nullptr, mass != nullptr ? *mass : Mass{}});
      });
  return hash_of_contents(std::move(contents));
}

std::uint64_t content_hash(const BareTable& table) {
  std::vector<Content> contents;
  append(contents, table.plain);
  append(contents, table.heavy);
  return hash_of_contents(std::move(contents));
}

std::uint64_t content_hash(std::span<const BareTable::Columns> chunks) {
  std::vector<Content> contents;
  for (const BareTable::Columns& chunk : chunks) append(contents, chunk);
  return hash_of_contents(std::move(contents));
}

}  // namespace gloam::bench
