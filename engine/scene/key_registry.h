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
#include "engine/scene/value.h"

namespace gloam {

/// What a scene key may stand on. `light_node`: a node with a light; `mesh_node`, `camera_node` alike; `node`: any
/// node.
enum class KeyElement { node, light_node, mesh_node, camera_node, material, scene };

// GCC takes scoped enumerators that are spelled like a type for shadowing.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
enum class KeyType { boolean, number, integer, text, choice, vec2, vec3 };
#pragma GCC diagnostic pop

/// A checked value: boolean → bool, number → double, integer → long long, text and choice → string.
using KeyValue = std::variant<bool, double, long long, std::string, vec2, vec3>;

/// What a setter changes: the node's entity, or the material's index into SceneAssets, or the scene (world resources).
struct KeyTarget {
  World& world;
  Entity entity;
  std::uint32_t material = ~0u;
  std::string directory;  ///< folder of the scene file, for keys that name files
};

/// One line of a key table. Numbers (and each component of vectors) lie in [min, max].
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
  std::function<Status(KeyTarget&, const KeyValue&)> set;  ///< an error's message is the fault alone; place is added
};

/// Reads one glTF extension that is not the importer's own.
struct SceneExtension {
  std::string module;
  std::string name;  ///< "KHR_lights_punctual"
  /// Once a file: the extension object at the root of the file (null when absent there).
  std::function<Status(World&, const SceneValue* root)> begin;
  /// Once a node that carries the extension, before its keys are set.
  std::function<Status(KeyTarget&, const SceneValue& node)> on_node;
};

/// Everything modules want to read from scene files. Filled by the modules; the importer knows only this.
class KeyRegistry {
 public:
  void add(SceneKey key);
  void add_extension(SceneExtension extension);
  /// Runs once after every node, key and transform is in the world: resolves names, checks what needs the whole scene.
  void add_finish(std::string module, std::function<Status(World&)> finish);
  /// Says whether an entity counts as the element (the importer asks for light_node; mesh and camera nodes it knows
  /// itself).
  void set_light_test(std::function<bool(const World&, Entity)> is_light);

  [[nodiscard]] const std::vector<SceneKey>& keys() const { return keys_; }
  [[nodiscard]] const SceneKey* find(std::string_view name) const;
  [[nodiscard]] const std::vector<SceneExtension>& extensions() const { return extensions_; }
  [[nodiscard]] bool is_light(const World& world, Entity entity) const { return is_light_ && is_light_(world, entity); }
  [[nodiscard]] Status finish(World& world) const;

  /// Checks type and range of a file's value for a key (booleans may be 0 or 1) and converts it. The error is the fault
  /// alone, e.g. "must be a number in 0…1, is \"wide\"".
  [[nodiscard]] static Result<KeyValue> convert(const SceneKey& key, const SceneValue& value);
  /// The known key closest in spelling, for "did you mean"; empty when none is near.
  [[nodiscard]] std::string nearest(std::string_view name) const;

 private:
  std::vector<SceneKey> keys_;
  std::vector<SceneExtension> extensions_;
  std::vector<std::pair<std::string, std::function<Status(World&)>>> finishers_;
  std::function<bool(const World&, Entity)> is_light_;
};

/// Keys the engine itself reads: gloam.sky.*, gloam.exposure, gloam.reflectivity, gloam.subsurface.
void add_engine_keys(KeyRegistry& registry);

}  // namespace gloam
