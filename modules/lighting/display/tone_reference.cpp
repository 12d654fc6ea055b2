// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/display/tone_reference.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/math/srgb.h"
#include "engine/render/camera/light_scale.h"
#include "engine/scene/resources.h"
#include "modules/lighting/outputs.h"

namespace gloam {
namespace {

double mean_of(const dvec3& x) { return (x.x + x.y + x.z) / 3.0; }

/// The half of the sigmoid that begins at middle grey with slope 2.4 and ends at (width, height).
double agx_half(double x, double width, double height) {
  const double scale = 2.4 * width / std::cbrt(std::pow(2.4 * width / height, 3.0) - 1.0);
  const double t = 2.4 * x / scale;
  return scale * t / std::cbrt(1.0 + t * t * t);
}

double agx_sigmoid(double x) {
  const double middle = 10.0 / 16.5, shown = std::pow(0.267, 1.0 / 2.2);
  const double from_middle = std::clamp((std::log2(std::max(x, 1e-9) / 0.18) + 10.0) / 16.5, 0.0, 1.0) - middle;
  const double value = from_middle < 0.0 ? shown - agx_half(-from_middle, middle, shown)
                                         : shown + agx_half(from_middle, 1.0 - middle, 1.0 - shown);
  return std::pow(std::clamp(value, 0.0, 1.0), 2.2);
}

/// The curve of one channel.
double tone_curve(ToneCurve curve, double x) {
  if (curve == ToneCurve::filmic) return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
  if (curve == ToneCurve::reinhard) return std::clamp(x / (1.0 + x), 0.0, 1.0);
  if (curve == ToneCurve::agx) return agx_sigmoid(x);
  return std::clamp(x, 0.0, 1.0);
}

/// What metering counts on a grid of side × side pixels, as meter.comp.glsl defines it.
struct Histogram {
  static constexpr double kBinsPerStop = 4.0;
  static constexpr std::size_t kBins = 454;

  std::vector<double> counts = std::vector<double>(kBins, 0.0);  ///< of pixels
  std::uint32_t lit = 0;

  static double first_stop() { return std::log2(1e-4); }

  Histogram(const LinearPicture& picture, std::uint32_t side) {
    for (std::uint32_t row = 0; row < side; ++row)
      for (std::uint32_t column = 0; column < side; ++column) {
        const std::size_t x = (column * 2 + 1) * picture.width / (2 * side);
        const std::size_t y = (row * 2 + 1) * picture.height / (2 * side);
        const float* light = &picture.rgba[4 * (y * picture.width + x)];
        count(0.2126 * static_cast<double>(light[0]) + 0.7152 * static_cast<double>(light[1]) +
              0.0722 * static_cast<double>(light[2]));
      }
  }
  void count(double luminance) {
    if (!(luminance > 0.0)) return;
    const double at = (std::log2(std::clamp(luminance, 1e-4, 1e30)) - first_stop()) * kBinsPerStop;
    const double bin = std::min(std::floor(at), static_cast<double>(kBins - 2));
    counts[static_cast<std::size_t>(bin)] += 1.0 - (at - bin);
    counts[static_cast<std::size_t>(bin) + 1] += at - bin;
    ++lit;
  }
  /// Mean of log2 luminance without the darkest tenth and the brightest twentieth.
  [[nodiscard]] double trimmed_mean() const {
    const double from = 0.1 * lit, to = 0.95 * lit;
    double below = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < kBins; ++i) {
      const double first = std::max(from - below, 0.0), last = std::min(to - below, counts[i]);
      if (last > first) sum += (last - first) * (static_cast<double>(i) - 0.5 + 0.5 * (first + last) / counts[i]);
      below += counts[i];
    }
    return first_stop() + sum / (to - from) / kBinsPerStop;
  }
};

/// The light that the frame's picture shows: with ScatteredLight, if the frame can be drawn again.
Result<LinearPicture> light_of_frame(const ReferenceInput& input) {
  if (!input.redraw) return input.frame.linear;
  auto shown = input.redraw([](World& world) { world.set_resource(ShownLight{}); },
                            [](World& world) { world.remove_resource<ShownLight>(); });
  if (!shown) return shown.error();
  return std::move(shown->linear);
}

}  // namespace

dvec3 tone_mapped(ToneCurve curve, const dvec3& light) {
  const dvec3 x = curve == ToneCurve::agx ? glm::mix(light, dvec3(mean_of(light)), 0.2) : light;
  const dvec3 shown(tone_curve(curve, x.x), tone_curve(curve, x.y), tone_curve(curve, x.z));
  if (curve != ToneCurve::agx) return shown;
  return glm::clamp((shown - 0.15 * mean_of(shown)) / 0.85, dvec3(0.0), dvec3(1.0));
}

double metered_exposure(const LinearPicture& lit) {
  constexpr std::uint32_t kFewest = 32;
  Histogram metered(lit, 32);
  if (metered.lit < kFewest) metered = Histogram(lit, 256);
  const double mean = metered.lit != 0 ? std::exp2(metered.trimmed_mean()) : 1e-4;
  return (1.03 - 2.0 / (2.0 + std::log10(mean + 1.0))) / mean;
}

std::uint8_t dithered_step(double encoded, uvec2 pixel, std::uint32_t channel) {
  const std::uint32_t number = pixel.x * 3242174889u + pixel.y * 2447445414u + channel * 1431655765u;
  const double even = (number >> 8) / 16777216.0;
  const double triangle = even < 0.5 ? std::sqrt(2.0 * even) - 0.5 : 1.5 - std::sqrt(2.0 - 2.0 * even);
  const double steps = 255.0 * encoded;
  const double noise = std::abs(steps - 127.5) > 127.0 ? even : triangle;
  return static_cast<std::uint8_t>(std::min(std::floor(steps + noise), 255.0));
}

Result<FramePictures> draw_tone_reference(const ReferenceInput& input) {
  const auto shown_light = light_of_frame(input);
  if (!shown_light) return shown_light.error();
  const LinearPicture& lit = *shown_light;
  const auto& environment = input.world.resource<SceneEnvironment>();
  const double exposure = has_stated_exposure(input.world)
                              ? 1.0 / (1.2 * std::exp2(static_cast<double>(environment.exposure_ev100)))
                              : metered_exposure(input.frame.linear);
  const ToneCurve curve = input.knobs.value(kToneMap);
  const bool dithers = input.knobs.value(kDither);
  FramePictures right;
  right.picture = {lit.width, lit.height, std::vector<std::uint8_t>(lit.rgba.size(), 255)};
  constexpr std::size_t kGrain = 16384;
  input.executor.parallel_for(lit.rgba.size() / 4, kGrain, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const uvec2 pixel(i % lit.width, i / lit.width);
      const float* light = &lit.rgba[4 * i];
      const dvec3 exposed = glm::clamp(dvec3(light[0], light[1], light[2]) * exposure, 0.0, 1e6);
      const dvec3 shown = tone_mapped(curve, exposed);
      for (std::uint32_t c = 0; c < 3; ++c) {
        const double encoded = linear_to_srgb(shown[static_cast<int>(c)]);
        right.picture.rgba[4 * i + c] =
            dithers ? dithered_step(encoded, pixel, c) : static_cast<std::uint8_t>(std::lround(encoded * 255.0));
      }
    }
  });
  return right;
}

}  // namespace gloam
