// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/reference/glare_reference.h"

#include <string>
#include <utility>
#include <vector>

#include "engine/render/camera/light_scale.h"
#include "modules/glare/knobs.h"
#include "modules/glare/reference/spread_light.h"

namespace gloam {
namespace {

/// The light of the input's frame before the glare, convolved.
GlarePicture convolve(const ReferenceInput& input, const LinearPicture& frame) {
  std::vector<vec4> light(frame.rgba.size() / 4);
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = {frame.rgba[4 * i], frame.rgba[4 * i + 1], frame.rgba[4 * i + 2], 1.0f};
  const std::vector<dvec3> spread = spread_light(light, {frame.width, frame.height}, input.executor,
                                                 kMostHalf / static_cast<double>(input.view.light_scale));
  LinearPicture right{frame.width, frame.height, {}};
  right.rgba.reserve(frame.rgba.size());
  for (const dvec3& at : spread) {
    for (int c = 0; c < 3; ++c) right.rgba.push_back(static_cast<float>(at[c]));
    right.rgba.push_back(1.0f);
  }
  return {to_light_picture(right, input.view.light_scale)};
}

Result<FramePictures> draw_glare_reference(const ReferenceInput& input) {
  if (!input.redraw) return Error{ErrorKind::usage, "the reference of glare needs a frame that can be drawn again"};
  auto shown = input.redraw([&](World& world) { world.set_resource(convolve(input, input.frame.linear)); },
                            [](World& world) { world.remove_resource<GlarePicture>(); });
  if (!shown) return shown.error();
  // The linear light of frames is that before the glare: there is nothing to compare with.
  return FramePictures{.linear = {}, .picture = std::move(shown->picture)};
}

}  // namespace

Status put_glare_picture(World& world, const ReferenceInput& input) {
  if (!input.redraw) return Error{ErrorKind::usage, "the reference of glare needs a frame that can be drawn again"};
  const auto frame = input.redraw([](World&) {}, [](World&) {});
  if (!frame) return frame.error();
  world.set_resource(convolve(input, frame->linear));
  return {};
}

ReferenceInfo glare_reference() {
  return {.knob = std::string(kGlareLines.name),
          .kind = "double precision",
          .name = "convolution of the whole picture",
          .draw = &draw_glare_reference};
}

}  // namespace gloam
