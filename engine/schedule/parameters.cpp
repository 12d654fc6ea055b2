// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/schedule/parameters.h"

namespace gloam {

CommandReport Commands::apply(World& world) {
  CommandReport report = CommandBuffer::apply(world);
  const CommandReport of_ranges = ranges_.apply(world);
  report.applied += of_ranges.applied;
  report.skipped += of_ranges.skipped;
  return report;
}

void Commands::clear() {
  CommandBuffer::clear();
  ranges_.clear();
}

}  // namespace gloam
