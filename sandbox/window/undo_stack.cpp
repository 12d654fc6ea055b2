// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/undo_stack.h"

#include <utility>

namespace gloam {

void UndoStack::note(const Settings& before, const Settings& after, bool held) {
  Change change;
  for (const auto& [name, value] : after) {
    const auto old = before.find(name);
    if (old == before.end() || old->second == value) continue;
    change.before.insert(*old);
    change.after.emplace(name, value);
  }
  if (!change.after.empty()) {
    undone_.clear();
    if (open_) {
      Change& last = done_.back();
      last.before.merge(change.before);  // the oldest values stay
      for (const auto& [name, value] : change.after) last.after[name] = value;
    } else {
      done_.push_back(std::move(change));
      if (done_.size() > kMost) done_.erase(done_.begin());
    }
    open_ = true;
  }
  open_ = open_ && held;
}

std::optional<Settings> UndoStack::undo() {
  if (done_.empty()) return std::nullopt;
  open_ = false;
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
  return undone_.back().before;
}

std::optional<Settings> UndoStack::redo() {
  if (undone_.empty()) return std::nullopt;
  open_ = false;
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
  return done_.back().after;
}

}  // namespace gloam
