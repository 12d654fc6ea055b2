// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/entities/key_import.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "engine/scene/gltf/parsing/undrawn_materials.h"
#include "engine/scene/gltf/place.h"

namespace gloam::gltf {
namespace {

constexpr std::array<std::string_view, 9> kOwnExtensions = {
    "KHR_texture_transform",      "KHR_mesh_quantization", "KHR_materials_emissive_strength",
    "KHR_materials_transmission", "KHR_materials_unlit",   "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",    "EXT_texture_webp",      "EXT_mesh_gpu_instancing"};
constexpr std::string_view kKeyPrefix = "gloam.";

bool is_supported(const KeyRegistry& registry, std::string_view name) {
  if (std::find(kOwnExtensions.begin(), kOwnExtensions.end(), name) != kOwnExtensions.end()) return true;
  const auto& extensions = registry.extensions();
  return std::any_of(extensions.begin(), extensions.end(),
                     [name](const SceneExtension& extension) { return extension.name == name; });
}

std::string_view element_text(KeyElement element) {
  switch (element) {
    case KeyElement::node:
      return "a node";
    case KeyElement::light_node:
      return "a node with a light";
    case KeyElement::mesh_node:
      return "a node with a mesh";
    case KeyElement::camera_node:
      return "a node with a camera";
    case KeyElement::material:
      return "a material";
    case KeyElement::scene:
      return "a scene";
  }
  return "";
}

std::string unknown_key(const KeyRegistry& registry, const std::string& name) {
  const std::string nearest = registry.nearest(name);
  return one_line(name) + " is not a known key" + (nearest.empty() ? "" : ", did you mean " + nearest + "?");
}

/// An element whose extras may hold scene keys.
struct Element {
  std::string place;
  const SceneValue& extras;
  bool is_node = false;
  bool has_mesh = false;
  bool has_camera = false;
  KeyElement kind = KeyElement::node;  ///< material or scene, if it is not a node
  /// Entities that draw the node's mesh, if it has instances (EXT_mesh_gpu_instancing).
  std::span<const Entity> instances = {};
};

class KeyImporter {
 public:
  KeyImporter(const KeyRegistry& registry, World& world) : registry_(registry), world_(world) {}

  /// Checks every key of the element and, if `set`, sets it. (A node outside the scene has no entity to set it on.)
  Status import(const Element& element, KeyTarget& target, bool set) const {
    if (element.extras.kind != SceneValue::Kind::object) return {};
    for (const auto& [name, value] : element.extras.members) {
      if (!name.starts_with(kKeyPrefix)) continue;
      const SceneKey* key = registry_.find(name);
      if (key == nullptr) return fault_at(element.place, unknown_key(registry_, name));
      if (!stands_on(*key, element, target.entity))
        return fault_at(element.place, name + " belongs on " + std::string(element_text(key->on)));
      const Result<KeyValue> converted = KeyRegistry::convert(*key, value);
      if (!converted) return fault_at(element.place, name + " " + converted.error().message);
      if (!set || !key->set) continue;
      if (const Status status = set_key(*key, element, target, *converted); !status)
        return fault_at(element.place, name + " " + status.error().message);
    }
    return {};
  }

 private:
  /// Sets the key of a mesh on every instance of the mesh.
  static Status set_key(const SceneKey& key, const Element& element, KeyTarget& target, const KeyValue& value) {
    if (key.on != KeyElement::mesh_node || element.instances.empty()) return key.set(target, value);
    for (const Entity instance : element.instances) {
      KeyTarget instance_target = target;
      instance_target.entity = instance;
      GLOAM_TRY(key.set(instance_target, value));
    }
    return {};
  }

  bool stands_on(const SceneKey& key, const Element& element, Entity entity) const {
    switch (key.on) {
      case KeyElement::node:
        return element.is_node;
      case KeyElement::light_node:
        // Without an entity the light test is not possible: the key passes.
        return element.is_node && (entity == kNoEntity || registry_.is_light(world_, entity));
      case KeyElement::mesh_node:
        return element.is_node && element.has_mesh;
      case KeyElement::camera_node:
        return element.is_node && element.has_camera;
      case KeyElement::material:
      case KeyElement::scene:
        return !element.is_node && element.kind == key.on;
    }
    return false;
  }

  const KeyRegistry& registry_;
  World& world_;
};

const SceneValue& member_of(const std::vector<Attachments>& list, std::size_t index, SceneValue Attachments::*member) {
  static const SceneValue kAbsent;
  return index < list.size() ? list[index].*member : kAbsent;
}

Status begin_extensions(const JsonScan& scan, const KeyRegistry& registry, World& world) {
  for (const SceneExtension& extension : registry.extensions()) {
    if (!extension.begin) continue;
    if (const Status status = extension.begin(world, scan.root_extensions.find(extension.name)); !status)
      return fault_at(extension.name, status.error().message);
  }
  return {};
}

Status import_node_extensions(const SceneValue& extensions, const std::string& where, const KeyRegistry& registry,
                              KeyTarget& target) {
  for (const SceneExtension& extension : registry.extensions()) {
    const SceneValue* value = extensions.find(extension.name);
    if (value == nullptr || !extension.on_node) continue;
    if (const Status status = extension.on_node(target, *value); !status)
      return fault_at(where, extension.name + " " + status.error().message);
  }
  return {};
}

}  // namespace

Status check_extensions(const JsonScan& scan, const KeyRegistry& registry, std::vector<std::string>& warnings) {
  for (const std::string& name : scan.extensions_required)
    if (!is_supported(registry, name))
      return Error{ErrorKind::input, "the extension " + in_quotes(name) + " is required, but not supported"};
  std::set<std::string> told;
  for (const std::string& name : scan.extensions_used)
    if (!is_supported(registry, name) && !is_undrawn_extension(name) && told.insert(name).second)
      warnings.push_back("the extension " + in_quotes(name) + " is not known, it is ignored");
  std::string undrawn;
  for (const std::string_view name : undrawn_extensions(scan))
    undrawn += (undrawn.empty() ? "drawn without " : ", ") + std::string(name);
  if (!undrawn.empty()) warnings.push_back(undrawn);
  return {};
}

Status check_stray_keys(const JsonScan& scan, const KeyRegistry& registry) {
  if (scan.stray_keys.empty()) return {};
  const StrayKey& stray = scan.stray_keys.front();
  const SceneKey* key = registry.find(stray.key);
  if (key == nullptr) return Error{ErrorKind::input, stray.place + unknown_key(registry, stray.key)};
  return Error{ErrorKind::input, stray.place + stray.key + " belongs on " + std::string(element_text(key->on))};
}

Status import_keys(const JsonScan& scan, const Document& document, std::uint32_t scene,
                   std::span<const Entity> entities, const std::string& directory, const KeyRegistry& registry,
                   World& world) {
  GLOAM_TRY(begin_extensions(scan, registry, world));
  const KeyImporter importer(registry, world);
  for (std::size_t i = 0; i < document.nodes.size(); ++i) {
    const NodeSource& node = document.nodes[i];
    KeyTarget target{world, entities[i], kNone, directory};
    const std::string where = place("node", i, node.name);
    if (entities[i] != kNoEntity)
      GLOAM_TRY(import_node_extensions(member_of(scan.nodes, i, &Attachments::extensions), where, registry, target));
    const Element element{where,
                          member_of(scan.nodes, i, &Attachments::extras),
                          true,
                          node.mesh != kNone || node.instanced_mesh != kNone,
                          node.camera != kNone,
                          KeyElement::node,
                          entities.subspan(node.first_instance, node.instance_count)};
    GLOAM_TRY(importer.import(element, target, entities[i] != kNoEntity));
  }
  for (std::size_t i = 0; i < document.materials.size(); ++i) {
    KeyTarget target{world, kNoEntity, static_cast<std::uint32_t>(i), directory};
    const Element element{place("material", i, document.materials[i].name),
                          member_of(scan.materials, i, &Attachments::extras),
                          false,
                          false,
                          false,
                          KeyElement::material};
    GLOAM_TRY(importer.import(element, target, true));
  }
  for (std::size_t i = 0; i < document.scenes.size(); ++i) {
    KeyTarget target{world, kNoEntity, kNone, directory};
    const Element element{place("scene", i, document.scenes[i].name),
                          member_of(scan.scenes, i, &Attachments::extras),
                          false,
                          false,
                          false,
                          KeyElement::scene};
    GLOAM_TRY(importer.import(element, target, i == scene));
  }
  return {};
}

}  // namespace gloam::gltf
