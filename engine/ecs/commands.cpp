// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/commands.h"

namespace gloam {

void CommandBuffer::destroy(Entity e) {
  record(checked(e),
         [](World& world, Entity target, const std::byte*, std::vector<Entity>&) { world.destroy(target); });
}

void CommandBuffer::clear() {
  commands_.clear();
  payload_.clear();
  stand_ins_.clear();
  created_ = 0;
}

CommandReport CommandBuffer::apply(World& world) {
  CommandReport report;
  for (const Command& command : commands_) {
    Entity target = command.target;
    if (target != kNoEntity) {
      if (target.generation == 0) target = stand_ins_[target.index];
      if (!world.alive(target)) {
        ++report.skipped;
        continue;
      }
    }
    command.function(world, target, payload_.data() + command.payload, stand_ins_);
    ++report.applied;
  }
  clear();
  return report;
}

void CommandLists::prepare(std::size_t count) {
  for (const List& list : lists_)
    GLOAM_ASSERT(list.buffer.empty(), "command lists are applied before they are used again");
  if (lists_.size() < count) lists_.resize(count);
}

CommandReport CommandLists::apply(World& world) {
  CommandReport total;
  for (List& list : lists_) {
    const CommandReport report = list.buffer.apply(world);
    total.applied += report.applied;
    total.skipped += report.skipped;
  }
  return total;
}

void CommandLists::clear() {
  for (List& list : lists_) list.buffer.clear();
}

}  // namespace gloam
