// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/entity.h"
#include "engine/math/types.h"

namespace gloam {

/// Simulated time of the frame. Simulations rest while it stands, and start again when it goes back.
struct SceneClock {
  double time_s = 0.0;
  double dt_s = 1.0 / 60.0;  ///< since the frame before
};

/// Joint matrices of all skinned instances, for the GPU. Each maps rest positions of the mesh to the world's axes,
/// relative to its range's `origin`, so that floats stay small far from the world's origin.
struct JointMatrices {
  struct Range {
    Entity instance;          ///< entity with the MeshInstance
    std::uint32_t first = 0;  ///< index into matrices
    std::uint32_t count = 0;
    dvec3 origin = dvec3(0.0);  ///< world position that skinned positions are relative to
    bool mirrored = false;      ///< skinning mirrors the surface, which swaps front and back faces
  };
  std::vector<Range> ranges;  ///< ordered by instance.index
  std::vector<mat4> matrices;
};

/// Morph weights of all instances with morph targets. MorphInstance holds their ranges.
struct MorphWeights {
  std::vector<float> values;
};

/// Meshes of SceneAssets that the GPU holds although no MeshInstance draws them, e.g. because it soon will. A resource
/// that the host may set. Meshes with neither are not uploaded, and are freed after 120 frames without.
struct PreloadedMeshes {
  std::vector<std::uint32_t> meshes;
};

/// Entities that the host has put elsewhere since the last frame. They and their descendants (Parent) have the motion
/// of objects at rest in the next frame. The renderer clears the list when a frame was drawn.
struct Teleports {
  std::vector<Entity> entities;
};

/// Entities by kind ("light", "camera", "mesh", "node", …) and name.
class SceneNames {
 public:
  void add(std::string_view kind, std::string_view name, Entity entity);
  /// The entity with this name. Usage error if there is none (listing the valid names), input error if several entities
  /// share the name.
  [[nodiscard]] Result<Entity> find(std::string_view kind, std::string_view name) const;
  [[nodiscard]] std::vector<std::string> names(std::string_view kind) const;  ///< in order of adding
  [[nodiscard]] std::string_view name_of(Entity entity) const;                ///< empty if it has none

 private:
  struct Named {
    Entity first = kNoEntity;
    std::uint32_t count = 0;
  };
  struct Kind {
    std::vector<std::string> order;
    std::unordered_map<std::string, Named> by_name;
  };

  std::map<std::string, Kind, std::less<>> kinds_;
  /// A node's name wins over the name of a light, mesh or camera on it.
  std::unordered_map<Entity, std::string> names_;
};

/// Strings that components refer to by number; number 0 is the empty string.
class SceneStrings {
 public:
  [[nodiscard]] std::uint32_t intern(std::string_view text);
  [[nodiscard]] const std::string& text(std::uint32_t id) const;

 private:
  std::vector<std::string> texts_ = {std::string()};
  std::unordered_map<std::string, std::uint32_t> ids_ = {{std::string(), 0u}};
};

/// Sky and exposure of a whole scene; set by `gloam.sky.*` and `gloam.exposure`.
struct SceneEnvironment {
  vec3 sky_zenith = vec3(0.0f);  ///< cd/m²
  vec3 sky_horizon = vec3(0.0f);
  vec3 sky_ground = vec3(0.0f);
  bool has_sky = false;  ///< a key has set the sky, to black perhaps
  bool has_exposure = false;
  float exposure_ev100 = 0.0f;
};

/// World resource: exposures are metered in every frame, even if the scene states one (SceneEnvironment). Kept by the
/// module that meters.
struct MeteredInEveryFrame {};

}  // namespace gloam
