// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/lights/components.h"
#include "sandbox/scenes/dusk/model.h"
#include "sandbox/scenes/street/parts.h"

namespace gloam {

/// The parts of builtin:dusk. Metres; the street runs along −Z between the facades on its left and the lawn on its
/// right.
inline constexpr double kDuskFacadeX = -6.0;
inline constexpr double kDuskKerbX = -3.4;    // of the left pavement
inline constexpr double kDuskFootwayX = 3.4;  // of the footway before the lawn
inline constexpr double kDuskLawnX = 5.2;     // where the lawn begins
inline constexpr double kDuskLawnEastX = 18.0;
inline constexpr double kDuskLawnNorthZ = -19.0;
inline constexpr double kDuskLawnSouthZ = 8.0;
inline constexpr double kDuskNorthZ = -30.0;  // ends of the street
inline constexpr double kDuskSouthZ = 15.0;
inline constexpr double kDuskPavementY = 0.14;
inline constexpr dvec3 kDuskBandstand = dvec3(12.6, 0.0, -8.6);
inline constexpr double kDuskBandstandRadius = 2.5;
inline constexpr dvec3 kDuskFire = dvec3(0.35, 0.0, -5.0);

struct DuskMaterials {
  std::uint32_t setts, slabs, paving, soil, gravel;
  std::uint32_t matt;                 ///< white: the vertices give the colour
  std::uint32_t leaf, canvas, paper;  ///< light passes through; white
  std::uint32_t glass;                ///< blended
  std::uint32_t water;
  std::uint32_t bulb, small_bulb, ember;
};

struct Dusk {
  Street street;
  DuskMaterials materials;

  [[nodiscard]] World& world() const { return street.world; }
  [[nodiscard]] SceneBuilder& builder() const { return street.builder; }
};

inline constexpr vec3 kDuskAmber = vec3(1.0f, 0.60f, 0.25f);  ///< street lamps
inline constexpr vec3 kDuskWarm = vec3(1.0f, 0.72f, 0.40f);   ///< bulbs

/// Adds the model as a mesh with one instance.
Entity add_dusk_model(Dusk& dusk, const std::string& name, const Model& model, std::uint32_t material, dvec3 position,
                      double heading = 0.0);

/// Height of the lawn, and of the pavement beside it.
[[nodiscard]] double lawn_height(double x, double z);
/// The middle of the path over the lawn, from its south end to its north end.
[[nodiscard]] const std::vector<glm::dvec2>& lawn_path();

void add_dusk_ground(Dusk& dusk);
void add_dusk_puddles(Dusk& dusk);
void add_dusk_houses(Dusk& dusk);
/// Bandstand, trees, hedges, fence and benches.
void add_dusk_park(Dusk& dusk);
void add_dusk_stalls(Dusk& dusk);
/// People who stand, and people who walk.
void add_dusk_figures(Dusk& dusk);
/// Street lamps, strings of bulbs and lanterns.
void add_dusk_lights(Dusk& dusk);
/// The fire, steam and fog.
void add_dusk_particles(Dusk& dusk);
void add_dusk_cameras(Dusk& dusk);

}  // namespace gloam
