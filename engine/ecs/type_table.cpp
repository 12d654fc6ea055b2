// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/type_table.h"

#include <bit>

#include "engine/core/assert.h"

namespace gloam {

TypeTable::TypeTable() : slots_(32), shift_(64 - 5) {}

std::uint32_t TypeTable::find_further(TypeKey key) const {
  std::size_t i = home(key);
  while (slots_[i].key != key && slots_[i].key != TypeKey::none) i = (i + 1) & (slots_.size() - 1);
  return slots_[i].value;  // kAbsent in a free slot
}

void TypeTable::insert(TypeKey key, std::uint32_t value) {
  GLOAM_ASSERT(find(key) == kAbsent, "a type is entered into a table once");
  if ((used_ + 1) * 2 > slots_.size()) {
    std::vector<Slot> old(slots_.size() * 2);
    old.swap(slots_);
    shift_ = 64 - std::countr_zero(slots_.size());
    used_ = 0;
    for (const Slot& slot : old) {
      if (slot.key != TypeKey::none) insert(slot.key, slot.value);
    }
  }
  std::size_t i = home(key);
  while (slots_[i].key != TypeKey::none) i = (i + 1) & (slots_.size() - 1);
  slots_[i] = {key, value};
  ++used_;
}

void TypeCache::insert(TypeKey key, std::uint32_t name_hash, std::uint32_t value) {
  Slot& slot = entries_[name_hash % kPlaces];
  if (slot.key == TypeKey::none) slot = {key, value};
  set_on(on_);
}

void TypeCache::set_on(bool on) {
  on_ = on;
  slots_ = on ? entries_ : std::array<Slot, kPlaces>{};
}

}  // namespace gloam
