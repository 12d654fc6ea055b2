// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/antialiasing/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/math/low_discrepancy.h"
#include "engine/math/srgb.h"
#include "modules/lighting/outputs.h"

namespace gloam {
namespace {

constexpr std::uint32_t kMostSamples = 64;
constexpr std::uint32_t kRaysPerFrame = 4;

/// The point of a pixel that the sample shows, from the pixel's centre; pixels.
glm::dvec2 sample_point(std::uint32_t index) {
  constexpr double kStep = 1.0 / 4294967296.0;
  return {kStep * reversed_bits(index) - 0.5, kStep * second_sobol(index) - 0.5};
}

/// Shifts the picture of the frame's camera by part of a pixel, to the right and up. A perspective camera looks from a
/// point so near to the centre of its lens that only the shear of the projection shows; an orthographic one moves.
LensPoint shifted(const RenderView& view, const glm::dvec2& pixels) {
  const glm::dvec2 scale(view.clip_from_view[0][0], view.clip_from_view[1][1]);
  const glm::dvec2 offset = -2.0 * pixels / (scale * glm::dvec2(view.width, view.height));
  if (view.camera.orthographic) return {view.camera_entity, offset, std::numeric_limits<double>::infinity()};
  constexpr double kFocus = 1e-6;
  return {view.camera_entity, -kFocus * offset, kFocus};
}

/// Each sample is a frame, so there are fewer than of rays.
std::uint32_t samples_of(const ReferenceInput& input) {
  return std::clamp(input.samples / kRaysPerFrame, 1u, kMostSamples);
}

/// Everything that the picture is computed from: the frame, its view, all knobs and the number of samples.
std::string identity_of(const ReferenceInput& input, std::uint32_t samples) {
  Hasher hasher;
  hasher.bytes(std::as_bytes(std::span(input.frame.picture.rgba)));
  hasher.bytes(std::as_bytes(std::span(input.frame.linear.rgba)));
  hasher.bytes_of(input.view.position).bytes_of(input.view.view_from_relative).bytes_of(input.view.clip_from_view);
  std::string identity = "supersampled 1, frame " + std::to_string(hasher.digest()) + ", " +
                         std::to_string(input.view.width) + "x" + std::to_string(input.view.height) + ", samples " +
                         std::to_string(samples);
  for (const Knob& knob : input.knobs.knobs()) identity += " " + knob.name + "=" + input.knobs.text(knob);
  return identity;
}

Status keep(const ReferenceInput& input, std::uint32_t samples, const Picture& mean) {
  if (input.store == nullptr) return {};
  return input.store->save(identity_of(input, samples), std::string(mean.rgba.begin(), mean.rgba.end()));
}

/// sums: linear light, 0…1, of `samples` pictures.
void set_mean(const std::vector<double>& sums, std::uint32_t samples, Picture& mean) {
  for (std::size_t at = 0; at < sums.size(); ++at)
    mean.rgba[at] =
        at % 4 == 3 ? 255 : static_cast<std::uint8_t>(std::lround(255.0 * linear_to_srgb(sums[at] / samples)));
}

/// Sets the picture to the mean of the samples. Keeps it, and that of half of the samples, which is asked for next.
Status accumulate(const ReferenceInput& input, Picture& mean) {
  const std::uint32_t samples = samples_of(input);
  std::vector<double> linear(256);
  for (std::size_t value = 0; value < linear.size(); ++value)
    linear[value] = srgb_to_linear(static_cast<double>(value) / 255.0);
  std::vector<double> sums(mean.rgba.size(), 0.0);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const auto frame = input.redraw(
        [&](World& world) {
          world.set_resource(shifted(input.view, sample_point(i)));
          world.set_resource(PointSampledFrame{});
        },
        [](World& world) {
          world.remove_resource<LensPoint>();
          world.remove_resource<PointSampledFrame>();
        });
    if (!frame) return frame.error();
    if (frame->picture.rgba.size() != sums.size()) return Error{ErrorKind::usage, "a frame was drawn in another size"};
    for (std::size_t at = 0; at < sums.size(); ++at) sums[at] += linear[frame->picture.rgba[at]];
    if (input.progress) input.progress(i + 1, samples);
    if (i + 1 != samples && 2 * (i + 1) != samples) continue;
    set_mean(sums, i + 1, mean);
    GLOAM_TRY(keep(input, i + 1, mean));
  }
  return {};
}

}  // namespace

Result<FramePictures> draw_supersampled(const ReferenceInput& input) {
  if (!input.redraw) return Error{ErrorKind::usage, "a supersampled picture needs a frame that can be drawn again"};
  const std::string identity = identity_of(input, samples_of(input));
  FramePictures mean;
  mean.picture = {input.view.width, input.view.height, {}};  // the frame's picture may be larger than its view
  mean.picture.rgba.resize(std::size_t{4} * input.view.width * input.view.height);
  if (const auto kept = input.store == nullptr ? std::nullopt : input.store->load(identity);
      kept && kept->size() == mean.picture.rgba.size()) {
    mean.picture.rgba.assign(kept->begin(), kept->end());
    return mean;
  }
  GLOAM_TRY(accumulate(input, mean.picture));
  return mean;
}

ReferenceInfo supersampled_reference(std::string knob) {
  return {.knob = std::move(knob),
          .kind = "accumulated",
          .name = "pictures sampled at points of each pixel",
          .samples = true,
          .draw = &draw_supersampled};
}

}  // namespace gloam
