// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "engine/scene/assets.h"

namespace gloam {

/// Images of streets, computed: sRGB colours that materials multiply with their emissive colour.

/// A lit shop seen through its window: goods on shelves under a lamp strip.
[[nodiscard]] Image shelves_image();

/// A lit room behind a shop window: hanging lamps and the silhouettes of guests.
[[nodiscard]] Image guests_image();

/// A lit window with curtains.
[[nodiscard]] Image curtains_image();

/// Bright letters on a dark board, four times as wide as high. word: up to 7 capitals of "ABCDEFHIKLMNOPRSTWY";
/// other characters stay blank.
[[nodiscard]] Image sign_image(std::string_view word);

}  // namespace gloam
