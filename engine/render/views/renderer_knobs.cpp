// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/views/renderer_knobs.h"

#include "engine/render/draws/culling.h"
#include "engine/render/draws/levels.h"
#include "engine/render/kept_frames/kept_frames.h"

namespace gloam {

void add_renderer_knobs(KnobRegistry& knobs) {
  add_knobs(knobs, "scene", kCulling, kFrameReuse, kLodPixels);
  add_knobs(knobs, "views", kViewScale);
}

}  // namespace gloam
