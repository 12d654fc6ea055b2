// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/camera/camera_cuts.h"

namespace gloam {

void CameraCuts::begin_frame() {
  for (auto& [key, item] : items_) item.declared.reset();
}

std::uint64_t CameraCuts::declare(std::uint64_t world, const ViewSettings& settings, std::uint64_t frame) {
  Item& item = items_[{world, settings.id.value}];
  if (item.last && item.last->frame == frame) return item.last->cut_frame;
  item.cut_stated = item.cut_stated || settings.camera_cut;
  Seen seen{settings.camera_entity, settings.camera.orthographic, frame, frame};
  const bool cut =
      !item.last || item.cut_stated || item.last->camera != seen.camera || item.last->orthographic != seen.orthographic;
  if (!cut) seen.cut_frame = item.last->cut_frame;
  item.declared = seen;
  return seen.cut_frame;
}

void CameraCuts::commit() {
  for (auto& [key, item] : items_) {
    if (!item.declared) continue;
    item.last = item.declared;
    item.declared.reset();
    item.cut_stated = false;
  }
}

void CameraCuts::forget_world(std::uint64_t world) {
  std::erase_if(items_, [&](const auto& entry) { return entry.first.world == world; });
}

void CameraCuts::forget_view(ViewId view) {
  std::erase_if(items_, [&](const auto& entry) { return entry.first.view == view.value; });
}

}  // namespace gloam
