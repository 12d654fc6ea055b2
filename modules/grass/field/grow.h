// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/jobs/executor.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "engine/schedule/parameters.h"
#include "modules/grass/components.h"
#include "modules/grass/growth/blade_types.h"
#include "shaders/grass/grass_shared.h"

namespace gloam {

/// Most blades of a field, for all settings.
inline constexpr std::uint32_t kMostGrassBlades = 1u << 24;

/// Settings of the growth; a world resource.
struct GrassGrowthSettings {
  std::uint32_t slaves_per_master = 4;  ///< 0: every blade is a master
  float density_scale = 1.0f;           ///< factor on GrassSurface::density
  std::uint32_t max_blades = 1u << 23;  ///< at most kMostGrassBlades; the default fits WorldLimits' default
};

/// Counts of one growth.
struct GrassStatistics {
  std::uint32_t surfaces = 0;   ///< with a density above 0
  std::uint32_t triangles = 0;  ///< upward-facing
  double area_m2 = 0.0;
  std::uint32_t blades = 0;
  std::uint32_t masters = 0;
  double wanted_blades = 0.0;          ///< density times area; above `blades` if max_blades was reached
  std::uint32_t refused_faces = 0;     ///< non-manifold
  std::uint32_t degenerate_faces = 0;  ///< no area
  std::uint32_t non_finite_faces = 0;
  std::uint32_t dropped_types = 0;  ///< beyond 16
};

/// The grown blades; a world resource.
struct GrassField {
  std::vector<GrassPatch> patches;           ///< patches[i].index is i
  std::vector<GrassBlade> blades;            ///< 256 slots a patch; empty slots have length 0
  std::vector<shaders::GrassTypeRow> types;  ///< of all surfaces, at most 16
  GrassStatistics statistics;
  std::vector<std::string> notes;  ///< one sentence per input that was not taken as it is: a bad file, a limit
  std::uint64_t key = 0;           ///< hash of the inputs
  std::uint64_t version = 0;       ///< changes when the field is regrown
};

/// One surface to grow. Surfaces are grown in their order.
struct GrassSource {
  Entity entity;
  GrassSurface surface;
  const Mesh* mesh = nullptr;
  dmat4 world_from_mesh = dmat4(1.0);
  std::string types_file;  ///< path; empty: the built-in types
};

/// Regrows the field from these sources and increments its version. The field's key stays.
void grow_grass(std::span<const GrassSource> sources, const GrassGrowthSettings& settings, JobExecutor& jobs,
                GrassField& field);

/// Regrows the field if a surface, its mesh or transform, SceneAssets::version or a setting changed. A changed file
/// of types is read when the field is regrown for another reason.
void grass_growth_system(View<const GrassSurface, const MeshInstance, const WorldTransform> surfaces,
                         Resource<const SceneAssets> assets, Resource<const SceneStrings> strings,
                         Resource<const GrassGrowthSettings> settings, Resource<GrassField> field, JobExecutor& jobs);

}  // namespace gloam
