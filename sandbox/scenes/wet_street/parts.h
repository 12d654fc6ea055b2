// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sandbox/scenes/street/parts.h"

namespace gloam {

/// The parts of builtin:wet_street. Metres; the street runs along −Z, facades at x = ±kStreetFacadeX.
inline constexpr double kStreetFacadeX = 5.5;
inline constexpr double kStreetKerbX = 3.2;
inline constexpr double kStreetSouthZ = 9.0;
inline constexpr double kStreetNorthZ = -50.0;
inline constexpr double kGateSouthZ = -24.0;
inline constexpr double kGateNorthZ = -29.0;
inline constexpr double kGateHeight = 3.9;  // of the opening
inline constexpr double kAlleySouthZ = -18.0;
inline constexpr double kAlleyNorthZ = -22.0;
inline constexpr double kAlleyEndX = 16.0;
inline constexpr double kPavementY = 0.14;
inline constexpr double kTerraceFloorY = 3.6;
inline constexpr double kTerraceFrontZ = -6.0;  // its end towards +Z; the other one is kAlleySouthZ
inline constexpr double kTerraceBackX = 13.0;

/// Ground, houses and stairs.
void add_street_buildings(Street& street);
/// Objects on the ground: figure, van, crates, bollards, railings.
void add_street_things(Street& street);
/// Street lamps, fire, lamps over doors and on the terrace.
void add_street_lights(Street& street);

}  // namespace gloam
