// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "engine/core/assert.h"
#include "engine/ecs/entity.h"
#include "engine/ecs/world.h"

namespace gloam {

/// Number of commands that apply() ran and skipped.
struct CommandReport {
  std::size_t applied = 0;
  std::size_t skipped = 0;  ///< commands whose entity was dead by then
};

/// Records structural changes for later, from one thread at a time. They are applied in the order of recording.
class CommandBuffer {
 public:
  /// Returns a stand-in for the entity: usable in this buffer's destroy, add and remove until the buffer is applied,
  /// and nowhere else. It is not alive, and a copy of it in a component does not become the real entity.
  template <class... Ts>
  Entity create(const Ts&... values) {
    record(
        kNoEntity,
        [](World& world, Entity, const std::byte* payload, std::vector<Entity>& created) {
          // Braces guarantee that the values are read in order.
          const std::tuple<Ts...> copies{take<Ts>(payload)...};
          created.push_back(std::apply([&](const Ts&... each) { return world.create(each...); }, copies));
          static_cast<void>(payload);
        },
        values...);
    return {created_++, 0};
  }
  void destroy(Entity e);
  template <class T>
  void add(Entity e, const T& value = T{}) {
    record(
        checked(e),
        [](World& world, Entity target, const std::byte* payload, std::vector<Entity>&) {
          world.add<T>(target, take<T>(payload));
        },
        value);
  }
  template <class T>
  void remove(Entity e) {
    require_component<T>();
    record(checked(e),
           [](World& world, Entity target, const std::byte*, std::vector<Entity>&) { world.remove<T>(target); });
  }

  [[nodiscard]] bool empty() const { return commands_.empty(); }
  [[nodiscard]] std::size_t size() const { return commands_.size(); }
  void clear();

  /// Runs the commands and empties the buffer. A command whose entity is dead by then is skipped.
  CommandReport apply(World& world);

 private:
  using Function = void (*)(World&, Entity target, const std::byte* payload, std::vector<Entity>& created);
  struct Command {
    Function function;
    Entity target;  ///< kNoEntity: no target; otherwise generation 0: a stand-in
    std::size_t payload;
  };

  [[nodiscard]] Entity checked(Entity e) const {
    GLOAM_ASSERT(e.generation != 0 || e.index < created_, "a stand-in entity belongs to the buffer that created it");
    return e;
  }

  template <class T>
  static T take(const std::byte*& payload) {
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), payload, sizeof(T));
    payload += sizeof(T);
    return std::bit_cast<T>(bytes);
  }
  template <class... Ts>
  void record(Entity target, Function function, const Ts&... values) {
    (require_component<Ts>(), ...);
    commands_.push_back({function, target, payload_.size()});
    (append(std::as_bytes(std::span(std::addressof(values), 1))), ...);
  }
  void append(std::span<const std::byte> bytes) { payload_.insert(payload_.end(), bytes.begin(), bytes.end()); }

  std::vector<Command> commands_;
  std::vector<std::byte> payload_;
  std::vector<Entity> stand_ins_;  ///< during apply(): the real entity of each stand-in created so far
  std::uint32_t created_ = 0;
};

/// One buffer per range of a parallel loop. Buffers are applied in the order of the ranges, so that the outcome does
/// not depend on threads.
class CommandLists {
 public:
  /// Provides at least `count` empty buffers. Call it before the loop; the buffers of an earlier loop must have been
  /// applied or cleared.
  void prepare(std::size_t count);
  [[nodiscard]] std::size_t size() const { return lists_.size(); }

  /// The buffer of the range with this ordinal. Each buffer is for one thread at a time.
  [[nodiscard]] CommandBuffer& operator[](std::size_t ordinal) {
    GLOAM_ASSERT(ordinal < lists_.size(), "command lists are prepared for every range of the loop");
    return lists_[ordinal].buffer;
  }

  CommandReport apply(World& world);
  void clear();

 private:
  /// One cache line each, because threads record into neighbouring buffers at the same time.
  struct alignas(64) List {
    CommandBuffer buffer;
  };
  std::vector<List> lists_;
};

}  // namespace gloam
