// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/render/reference/reference.h"

namespace gloam {

/// The reference of a knob: the mean, in linear light, of pictures whose pixels are sampled at different points.
[[nodiscard]] ReferenceInfo supersampled_reference(std::string knob);

}  // namespace gloam
