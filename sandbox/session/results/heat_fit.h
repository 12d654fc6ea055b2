// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "engine/core/result.h"
#include "engine/render/view.h"
#include "sandbox/session/session.h"

namespace gloam {

/// The smallest of these factors on `most`, the end of a colour scale, that all but one in a thousand of the numbers
/// fit in; the largest factor if none does. 1 if no number is above 0. factors: ascending, not empty.
[[nodiscard]] float fitting_factor(std::span<const float> numbers, double most, std::span<const float> factors);

/// The same for counts, without a choice of factors: the end is a multiple of 5, so that a legend has whole numbers at
/// all stops of the colours: 5, or 10, 15, 20, 25, 30, 40, 50, 60, 80, or one of these times a power of ten.
[[nodiscard]] float fitting_factor_of_counts(std::span<const float> numbers, double most);

/// Whether a visualizer, NAME or NAME:ARGUMENT, shows numbers by the colours of a scale.
[[nodiscard]] bool shows_heat(const Renderer& renderer, std::string_view visualizer);

/// The value of ViewSettings::heat_range that fits the numbers of the view's last frame: of the factors of views.range,
/// or that of fitting_factor_of_counts. It waits for the frame. view: its visualizer shows heat, and the frame was
/// drawn with it.
[[nodiscard]] Result<float> fitting_heat_range(Session& session, const ViewSettings& view);

}  // namespace gloam
