// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/reference/glare_reference.h"

#include <string>
#include <utility>
#include <vector>

#include "modules/glare/knobs.h"
#include "modules/glare/reference/spread_light.h"
#include "modules/glare/view_glare.h"

namespace gloam {
namespace {

Result<FramePictures> draw_glare_reference(const ReferenceInput& input) {
  if (!input.redraw) return Error{ErrorKind::usage, "the reference of glare needs a frame that can be drawn again"};
  const LinearPicture& frame = input.frame.linear;
  std::vector<vec4> light(frame.rgba.size() / 4);
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = {frame.rgba[4 * i], frame.rgba[4 * i + 1], frame.rgba[4 * i + 2], 1.0f};
  const std::vector<dvec3> spread = spread_light(light, {frame.width, frame.height}, input.executor,
                                                 65504.0 / static_cast<double>(input.view.light_scale));
  const auto share = static_cast<double>(glare_share(input.world, input.view));
  LinearPicture right = frame;
  for (std::size_t i = 0; i < light.size(); ++i)
    for (int c = 0; c < 3; ++c)
      right.rgba[4 * i + static_cast<std::size_t>(c)] =
          static_cast<float>((1.0 - share) * static_cast<double>(light[i][c]) + share * spread[i][c]);
  auto shown = input.redraw(
      [&](World& world) { world.set_resource(GlarePicture{to_light_picture(right, input.view.light_scale)}); },
      [](World& world) { world.remove_resource<GlarePicture>(); });
  if (!shown) return shown.error();
  // The linear light of frames is that before the glare: there is nothing to compare with.
  return FramePictures{.linear = {}, .picture = std::move(shown->picture)};
}

}  // namespace

ReferenceInfo glare_reference() {
  return {.knob = std::string(kGlareLines.name),
          .kind = "double precision",
          .name = "convolution of the whole picture",
          .draw = &draw_glare_reference};
}

}  // namespace gloam
