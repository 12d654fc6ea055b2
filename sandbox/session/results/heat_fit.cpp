// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/results/heat_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "sandbox/session/program_knobs.h"
#include "sandbox/session/results/view_values.h"

namespace gloam {
namespace {

constexpr double kFitting = 0.999;  // share of the numbers

/// The number that all but one in a thousand are not above; 0 without a number.
double largest_shown(std::span<const float> numbers) {
  std::vector<float> finite;
  finite.reserve(numbers.size());
  for (const float number : numbers)
    if (std::isfinite(number)) finite.push_back(number);
  if (finite.empty()) return 0.0;
  const auto rank = static_cast<std::size_t>(kFitting * static_cast<double>(finite.size() - 1));
  std::nth_element(finite.begin(), finite.begin() + static_cast<std::ptrdiff_t>(rank), finite.end());
  return static_cast<double>(finite[rank]);
}

/// The visualizer if it shows heat.
std::optional<VisualizerInfo> heat_visualizer(const Renderer& renderer, std::string_view visualizer) {
  const std::string_view stem = visualizer.substr(0, visualizer.find(':'));
  for (VisualizerInfo& info : renderer.visualizers())
    if (info.name == stem && info.heat.most > 0.0) return std::move(info);
  return std::nullopt;
}

}  // namespace

float fitting_factor(std::span<const float> numbers, double most, std::span<const float> factors) {
  GLOAM_ASSERT(!factors.empty() && most > 0.0, "a colour scale has an end above 0 and a choice of factors");
  const double end = largest_shown(numbers);
  if (!(end > 0.0)) return 1.0f;
  for (const float factor : factors)
    if (static_cast<double>(factor) * most >= end) return factor;
  return factors.back();
}

float fitting_factor_of_counts(std::span<const float> numbers, double most) {
  GLOAM_ASSERT(most > 0.0, "a colour scale has an end above 0");
  constexpr double kLeastEnd = 5.0;
  constexpr std::array kEnds = {10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 80.0};
  const double largest = largest_shown(numbers);
  if (!(largest > 0.0)) return 1.0f;
  if (largest <= kLeastEnd) return static_cast<float>(kLeastEnd / most);
  double unit = 1.0;
  while (kEnds.back() * unit < largest) unit *= 10.0;
  for (const double end : kEnds)
    if (end * unit >= largest) return static_cast<float>(end * unit / most);
  return 1.0f;
}

bool shows_heat(const Renderer& renderer, std::string_view visualizer) {
  return heat_visualizer(renderer, visualizer).has_value();
}

Result<float> fitting_heat_range(Session& session, const ViewSettings& view) {
  const auto shown = heat_visualizer(*session.renderer, view.visualizer);
  GLOAM_ASSERT(shown, "only a visualizer with a colour scale has a range");
  const std::string& name = shown->image.empty() ? shown->name : shown->image;
  const auto image = session.renderer->read_image(session.world, view.id, name);
  // A view without its data, such as lists of a scene without lights, shows the picture as it is.
  if (!image && image.error().kind == ErrorKind::usage) return 1.0f;
  if (!image) return image.error();
  const auto texels = texels_as_floats(*image);
  if (!texels) return texels.error();
  std::vector<float> numbers;
  numbers.reserve(texels->size() / 4);
  for (std::size_t at = 0; at < texels->size(); at += 4) numbers.push_back((*texels)[at]);
  if (shown->heat.counts) return fitting_factor_of_counts(numbers, shown->heat.most);
  return fitting_factor(numbers, shown->heat.most, heat_ranges(session.renderer->knobs()));
}

}  // namespace gloam
