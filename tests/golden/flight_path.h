// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sandbox/bench/harness/camera_path.h"

namespace gloam::test {

/// A flight through the garden of builtin:many_lights: over the whole garden, down among the lanterns, through a
/// standing stone, along the ground, up until only sky is visible, straight down, and through glass back to the start.
inline constexpr PathKey kManyLightsFlight[] = {
    {{-32.0, 9.8, -17.0}, {4.0, 0.4, 2.0}},   {{-20.0, 4.0, -11.0}, {-6.0, 1.0, -4.0}},
    {{-11.0, 2.0, -6.0}, {2.0, 1.4, 1.0}},    {{-4.0, 0.9, -1.0}, {6.0, 1.0, 6.0}},
    {{3.0, 0.7, 4.0}, {14.0, 1.0, 8.0}},      {{11.0, 1.4, 7.0}, {16.0, 3.0, -4.0}},
    {{14.0, 2.2, -2.0}, {14.5, 30.0, -3.0}},  {{9.0, 3.4, -9.0}, {0.0, 1.2, -12.0}},
    {{2.0, 8.0, -13.0}, {0.5, 0.0, -12.0}},   {{-5.0, 3.0, -14.0}, {-9.0, 0.4, -6.0}},
    {{-12.0, 1.6, -4.0}, {-12.0, 1.5, 12.0}}, {{-14.0, 2.4, 8.0}, {8.0, 1.0, 6.0}},
    {{-26.0, 6.5, 4.0}, {2.0, 0.4, -2.0}}};

}  // namespace gloam::test
