// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/resources/graveyard.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace gloam::gpu::vulkan {

void Graveyard::bury(std::function<void()> destroy) {
  {
    const std::lock_guard lock(mutex_);
    if (begun_ > completed_) {
      graves_.push_back({begun_, std::move(destroy)});
      return;
    }
  }
  destroy();
}

void Graveyard::set_begun(std::uint64_t begun) {
  const std::lock_guard lock(mutex_);
  begun_ = begun;
}

void Graveyard::collect(std::uint64_t completed) {
  std::vector<Grave> due;
  {
    const std::lock_guard lock(mutex_);
    completed_ = std::max(completed_, completed);
    const auto first_due = std::stable_partition(graves_.begin(), graves_.end(),
                                                 [&](const Grave& grave) { return grave.frames > completed; });
    std::move(first_due, graves_.end(), std::back_inserter(due));
    graves_.erase(first_due, graves_.end());
  }
  for (const Grave& grave : due) grave.destroy();
}

void Graveyard::collect_all() { collect(std::numeric_limits<std::uint64_t>::max()); }

}  // namespace gloam::gpu::vulkan
