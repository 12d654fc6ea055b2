// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <vector>

namespace gloam::bench {

struct Position {
  float x = 0.0f;
  float y = 0.0f;
  float z = 0.0f;
};
struct Velocity {
  float x = 1.0f;
  float y = 0.5f;
  float z = 0.25f;
};
struct Mass {
  float kg = 2.0f;
};

/// Storage as a program without an ECS would write it: plain columns, a record with the row of each thing, and removal
/// by moving the last row. Things with a mass are in a second set of columns, as in an archetype. A handle holds index
/// and generation, which only `position` checks.
struct BareTable {
  struct Handle {
    std::uint32_t index = 0;
    std::uint32_t generation = 1;
  };
  struct Columns {
    std::vector<std::uint32_t> things;
    std::vector<Position> positions;
    std::vector<Velocity> velocities;
    std::vector<Mass> masses;  ///< empty in `plain`

    void clear() {
      things.clear();
      positions.clear();
      velocities.clear();
      masses.clear();
    }
    void push(std::uint32_t thing, const Position& position, const Velocity& velocity) {
      things.push_back(thing);
      positions.push_back(position);
      velocities.push_back(velocity);
    }
  };
  struct Record {
    Columns* columns = nullptr;
    std::uint32_t row = 0;
    std::uint32_t generation = 1;
  };
  Columns plain;
  Columns heavy;
  std::vector<Record> records;

  /// Removes all things and keeps the memory.
  void clear() {
    plain.clear();
    heavy.clear();
    records.clear();
  }
  void create(const Position& position, const Velocity& velocity) {
    records.push_back({&plain, static_cast<std::uint32_t>(plain.things.size())});
    plain.push(static_cast<std::uint32_t>(records.size() - 1), position, velocity);
  }
  void create_heavy(const Position& position, const Velocity& velocity, const Mass& mass) {
    records.push_back({&heavy, static_cast<std::uint32_t>(heavy.things.size())});
    heavy.push(static_cast<std::uint32_t>(records.size() - 1), position, velocity);
    heavy.masses.push_back(mass);
  }
  void create_heavy_bulk(std::size_t count, const Position& position, const Velocity& velocity, const Mass& mass) {
    const std::size_t first = heavy.things.size();
    const std::size_t first_thing = records.size();
    heavy.positions.resize(first + count, position);
    heavy.velocities.resize(first + count, velocity);
    heavy.masses.resize(first + count, mass);
    heavy.things.resize(first + count);
    records.resize(first_thing + count);
    for (std::size_t i = 0; i < count; ++i) {
      heavy.things[first + i] = static_cast<std::uint32_t>(first_thing + i);
      records[first_thing + i] = {&heavy, static_cast<std::uint32_t>(first + i)};
    }
  }
  void destroy(std::uint32_t thing) {
    take_row(records[thing]);
    records[thing].columns = nullptr;
  }
  void add_mass(std::uint32_t thing, const Mass& mass) {
    const Record from = records[thing];
    records[thing] = {&heavy, static_cast<std::uint32_t>(heavy.things.size())};
    heavy.push(thing, plain.positions[from.row], plain.velocities[from.row]);
    heavy.masses.push_back(mass);
    take_row(from);
  }
  void remove_mass(std::uint32_t thing) {
    const Record from = records[thing];
    records[thing] = {&plain, static_cast<std::uint32_t>(plain.things.size())};
    plain.push(thing, heavy.positions[from.row], heavy.velocities[from.row]);
    take_row(from);
  }
  /// With the checks of World::get: the index exists, the generation matches, the thing is alive, and its columns have
  /// positions.
  [[nodiscard]] Position& position(Handle handle) {
    if (handle.index >= records.size()) std::terminate();
    const Record& record = records[handle.index];
    if (record.generation != handle.generation || record.columns == nullptr) std::terminate();
    Position* column = record.columns->positions.data();
    if (column == nullptr) std::terminate();
    return column[record.row];
  }
  /// Without any check: the thing must exist, be alive and have a position.
  [[nodiscard]] Position& unchecked_position(Handle handle) {
    const Record& record = records[handle.index];
    return record.columns->positions.data()[record.row];
  }

 private:
  /// Removes a row by moving the last row into it.
  void take_row(Record record) {
    Columns& c = *record.columns;
    const std::uint32_t moved = c.things.back();
    if (record.row + 1 < c.things.size()) {
      c.things[record.row] = moved;
      c.positions[record.row] = c.positions.back();
      c.velocities[record.row] = c.velocities.back();
      if (!c.masses.empty()) c.masses[record.row] = c.masses.back();
      records[moved].row = record.row;
    }
    c.things.pop_back();
    c.positions.pop_back();
    c.velocities.pop_back();
    if (!c.masses.empty()) c.masses.pop_back();
  }
};

}  // namespace gloam::bench
