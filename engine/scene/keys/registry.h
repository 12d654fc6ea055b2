// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "engine/scene/keys/value.h"

namespace gloam {

/// The element of a scene file that a scene key may stand on. `light_node`, `mesh_node`, `camera_node`: a node with a
/// light, mesh or camera. `node`: any node.
enum class KeyElement { node, light_node, mesh_node, camera_node, material, scene };

// GCC's -Wshadow warns about scoped enumerators with the name of a type.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
enum class KeyType { boolean, number, integer, text, choice, vec2, vec3 };
#pragma GCC diagnostic pop

/// A checked value: boolean → bool, number → double, integer → long long, text and choice → string.
using KeyValue = std::variant<bool, double, long long, std::string, vec2, vec3>;

/// The target of a setter: the entity of a node, or the material with this index in SceneAssets, or the scene (world
/// resources).
struct KeyTarget {
  World& world;
  Entity entity;
  std::uint32_t material = ~0u;
  std::string directory;  ///< folder of the scene file, for keys that name files
};

/// A scene key. Numbers, and each component of vectors, must lie in [min, max].
struct SceneKey {
  std::string module;
  KeyElement on = KeyElement::node;
  std::string name;  ///< "gloam.light.width"
  KeyType type = KeyType::number;
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
  std::vector<std::string> choices;
  std::string unit;
  std::string default_text;
  std::string meaning;
  /// Stores a checked value. An error's message holds only the fault; the importer adds the place.
  std::function<Status(KeyTarget&, const KeyValue&)> set;
};

/// Reader of one glTF extension that the importer does not read itself.
struct SceneExtension {
  std::string module;
  std::string name;  ///< "KHR_lights_punctual"
  /// Called once per file with the extension object at the root of the file (null if absent).
  std::function<Status(World&, const SceneValue* root)> begin;
  /// Called for each node that carries the extension, before the node's keys are set.
  std::function<Status(KeyTarget&, const SceneValue& node)> on_node;
};

/// All scene keys and extensions of the engine and the modules. The modules fill it; the importer knows only this
/// registry.
class KeyRegistry {
 public:
  void add(SceneKey key);
  void add_extension(SceneExtension extension);
  /// `finish` is called once, after every node, key and transform is in the world. It resolves names and makes checks
  /// that need the whole scene.
  void add_finish(std::string module, std::function<Status(World&)> finish);
  /// Sets the test for KeyElement::light_node. The importer tests for meshes and cameras itself.
  void set_light_test(std::function<bool(const World&, Entity)> is_light);

  [[nodiscard]] const std::vector<SceneKey>& keys() const { return keys_; }
  [[nodiscard]] const SceneKey* find(std::string_view name) const;
  [[nodiscard]] const std::vector<SceneExtension>& extensions() const { return extensions_; }
  [[nodiscard]] bool is_light(const World& world, Entity entity) const { return is_light_ && is_light_(world, entity); }
  [[nodiscard]] Status finish(World& world) const;

  /// Checks type and range of a file's value for a key and converts it (booleans may be 0 or 1). The error holds only
  /// the fault, e.g. "must be a number in 0…1, is \"wide\"".
  [[nodiscard]] static Result<KeyValue> convert(const SceneKey& key, const SceneValue& value);
  /// The known key with the closest spelling, for "did you mean"; empty if none is near.
  [[nodiscard]] std::string nearest(std::string_view name) const;

 private:
  std::vector<SceneKey> keys_;
  std::vector<SceneExtension> extensions_;
  std::vector<std::pair<std::string, std::function<Status(World&)>>> finishers_;
  std::function<bool(const World&, Entity)> is_light_;
};

/// Adds the keys that the engine itself reads: gloam.sky.*, gloam.exposure, gloam.reflectivity, gloam.subsurface.*.
void add_engine_keys(KeyRegistry& registry);

}  // namespace gloam
