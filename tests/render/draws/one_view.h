// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/draws/draw_lists.h"

namespace gloam::test {

/// The draws of a frame with one view.
[[nodiscard]] inline FrameDraws frame_draws(const World& world, const RenderView& view, const GpuScene& scene,
                                            JobExecutor& executor, bool with_casters = false) {
  const RenderView* const views[] = {&view};
  return build_frame_draws(world, views, scene, executor, {.casters = with_casters});
}

}  // namespace gloam::test
