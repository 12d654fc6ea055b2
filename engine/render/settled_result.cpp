// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/settled_result.h"

#include <string>

#include "engine/render/worlds/world_id.h"

namespace gloam {

const FrameResult* settled_result(const FrameBuilder& frame, std::string_view module, std::string_view name) {
  return frame.services().results.settled(
      {std::string(module), std::string(name), world_id(frame.world()), frame.view().id.value});
}

}  // namespace gloam
