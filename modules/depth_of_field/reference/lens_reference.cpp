// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/reference/lens_reference.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "modules/depth_of_field/lens/lens.h"
#include "modules/depth_of_field/reference/lens_picture.h"
#include "modules/depth_of_field/reference/lens_points.h"

namespace gloam {
namespace {

Error cannot_draw_again() { return {ErrorKind::usage, "a lens reference needs a frame that can be drawn again"}; }

/// Everything that the light was computed from: the frame, the lens and the number of samples.
std::string identity_of(const ReferenceInput& input, const Lens& lens, Bokeh bokeh) {
  Hasher hasher;
  hasher.bytes(std::as_bytes(std::span(input.frame.linear.rgba)));
  hasher.bytes_of(input.view.position).bytes_of(input.view.view_from_relative).bytes_of(input.view.clip_from_view);
  hasher.bytes_of(lens.focus_m).bytes_of(lens.aperture_radius_m).value(bokeh);
  return "light through a lens 1, frame " + std::to_string(hasher.digest()) + ", " + std::to_string(input.view.width) +
         "x" + std::to_string(input.view.height) + ", samples " + std::to_string(std::max(input.samples, 1u));
}

std::string to_bytes(const LinearPicture& picture) {
  return {reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size() * sizeof(float)};
}

std::optional<LinearPicture> kept_picture(const ReferenceInput& input, const std::string& identity) {
  if (input.store == nullptr) return std::nullopt;
  const std::optional<std::string> bytes = input.store->load(identity);
  LinearPicture picture{input.view.width, input.view.height, {}};
  picture.rgba.resize(std::size_t{4} * picture.width * picture.height);
  if (!bytes || bytes->size() != picture.rgba.size() * sizeof(float)) return std::nullopt;
  std::memcpy(picture.rgba.data(), bytes->data(), bytes->size());
  return picture;
}

/// Adds the light of a frame. Light that is not finite counts as none, as in the effect.
void add_light(std::span<const float> light, std::span<double> sums) {
  for (std::size_t i = 0; i < light.size(); i += 4) {
    const bool finite = std::isfinite(light[i]) && std::isfinite(light[i + 1]) && std::isfinite(light[i + 2]);
    for (std::size_t c = 0; c < 3; ++c) sums[i + c] += finite ? static_cast<double>(light[i + c]) : 0.0;
  }
}

Result<LinearPicture> accumulate(const ReferenceInput& input, const Lens& lens, Bokeh bokeh) {
  const std::uint32_t samples = std::max(input.samples, 1u);
  const Entity camera = input.view.camera_entity;
  LinearPicture picture{input.view.width, input.view.height, {}};
  std::vector<double> sums(std::size_t{4} * picture.width * picture.height, 0.0);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const LensPoint point{camera, lens_point(bokeh, i) * lens.aperture_radius_m, lens.focus_m};
    const auto frame = input.redraw([&](World& world) { world.set_resource(point); },
                                    [](World& world) { world.remove_resource<LensPoint>(); });
    if (!frame) return frame.error();
    if (frame->linear.rgba.size() != sums.size()) return Error{ErrorKind::usage, "a frame was drawn in another size"};
    add_light(frame->linear.rgba, sums);
    if (input.progress) input.progress(i + 1, samples);
  }
  picture.rgba.resize(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
    picture.rgba[i] = i % 4 == 3 ? 1.0f : static_cast<float>(sums[i] / samples);
  return picture;
}

}  // namespace

Result<LinearPicture> light_through_lens(const ReferenceInput& input) {
  if (!input.redraw) return cannot_draw_again();
  const DepthOfField* values = find_depth_of_field(input.world, input.view);
  const std::optional<Lens> lens = values != nullptr ? lens_of(*values, input.view) : std::nullopt;
  if (!lens) return input.frame.linear;
  const std::string identity = identity_of(input, *lens, values->bokeh);
  if (std::optional<LinearPicture> kept = kept_picture(input, identity)) return std::move(*kept);
  auto light = accumulate(input, *lens, values->bokeh);
  if (light && input.store != nullptr) GLOAM_TRY(input.store->save(identity, to_bytes(*light)));
  return light;
}

Result<FramePictures> draw_through_lens(const ReferenceInput& input) {
  auto light = light_through_lens(input);
  if (!light) return light.error();
  auto shown = input.redraw(
      [&](World& world) { world.set_resource(LensPicture{to_light_picture(*light, input.view.light_scale)}); },
      [](World& world) { world.remove_resource<LensPicture>(); });
  if (!shown) return shown.error();
  return FramePictures{std::move(light).value(), std::move(shown->picture)};
}

Status put_lens_picture(World& world, const ReferenceInput& input) {
  const auto light = light_through_lens(input);
  if (!light) return light.error();
  world.set_resource(LensPicture{to_light_picture(*light, input.view.light_scale)});
  return {};
}

ReferenceInfo lens_reference(std::string knob) {
  return {.knob = std::move(knob),
          .kind = "accumulated",
          .name = "pinhole frames over the lens",
          .samples = true,
          .draw = &draw_through_lens};
}

}  // namespace gloam
