// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/import.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <utility>

#include "engine/core/text/plain_text.h"
#include "engine/scene/assets.h"
#include "engine/scene/gltf/assets/animation_import.h"
#include "engine/scene/gltf/assets/image_import.h"
#include "engine/scene/gltf/assets/mesh_import.h"
#include "engine/scene/gltf/buffers/compressed_meshes.h"
#include "engine/scene/gltf/buffers/compressed_views.h"
#include "engine/scene/gltf/entities/instancing.h"
#include "engine/scene/gltf/entities/key_import.h"
#include "engine/scene/gltf/entities/node_import.h"
#include "engine/scene/gltf/entities/poses.h"
#include "engine/scene/gltf/entities/scene_totals.h"
#include "engine/scene/gltf/parsing/container.h"
#include "engine/scene/gltf/parsing/json_scan.h"
#include "engine/scene/gltf/parsing/tinygltf_reader.h"
#include "engine/scene/gltf/place.h"
#include "engine/scene/gltf/validation/document_check.h"
#include "engine/scene/scene_path.h"

namespace gloam {
namespace {

using namespace gltf;

/// A checked document and the scan of its text.
struct OpenScene {
  JsonScan scan;
  Document document;
};

Result<OpenScene> open_scene(const std::string& path, const std::string& directory, const std::string& name,
                             const KeyRegistry& registry) {
  Result<std::vector<std::uint8_t>> bytes = read_scene_file(path);
  if (!bytes) return fault_at(name, bytes.error().message);
  Result<Container> file = open_container(std::move(*bytes));
  if (!file) return Error{ErrorKind::input, name + " " + file.error().message};
  Result<JsonScan> scan = scan_json(file->json());
  if (!scan) return Error{ErrorKind::input, name + " " + scan.error().message};
  if (!scan->version.empty() && !scan->version.starts_with("2."))
    return Error{ErrorKind::input, name + " is glTF " + one_line(scan->version) + ", only 2.x is read"};
  std::vector<std::string> warnings;
  if (Status status = check_extensions(*scan, registry, warnings); !status)
    return fault_at(name, status.error().message);
  if (!scan->first_fault.empty()) return fault_at(name, scan->first_fault);
  if (Status status = check_stray_keys(*scan, registry); !status) return fault_at(name, status.error().message);
  Result<Document> document = read_document(*file, *scan, directory);
  if (!document) return fault_at(name, document.error().message);
  document->warnings.insert(document->warnings.begin(), warnings.begin(), warnings.end());
  const auto check = [&]() -> Status {
    GLOAM_TRY(decompress_views(*document, file->bytes.size()));
    GLOAM_TRY(decompress_meshes(*document, file->bytes.size()));
    GLOAM_TRY(check_document(*document, file->bytes.size()));
    GLOAM_TRY(check_node_tree(*document));
    GLOAM_TRY(expand_instances(*document));
    return resolve_poses(*document);
  };
  if (Status status = check(); !status) return fault_at(name, status.error().message);
  return OpenScene{std::move(*scan), std::move(*document)};
}

/// Results of the import jobs, one slot per job.
struct Decoded {
  std::vector<std::optional<Result<ImportedMesh>>> meshes;
  std::vector<std::optional<Result<Image>>> images;
};

/// Decodes images and converts meshes in jobs. The largest image comes first, so that the last job to end is a short
/// one.
Decoded decode(const Document& document, std::vector<EncodedImage> encoded, JobExecutor& executor) {
  Decoded decoded;
  decoded.meshes.resize(document.meshes.size());
  decoded.images.resize(encoded.size());
  std::vector<std::size_t> order(encoded.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return encoded[a].pixels > encoded[b].pixels; });
  std::vector<std::function<void()>> jobs;
  for (const std::size_t i : order)
    jobs.emplace_back([&, i] {
      decoded.images[i] = import_image(document, encoded[i]);
      encoded[i] = {};
    });
  for (std::size_t i = 0; i < document.meshes.size(); ++i)
    jobs.emplace_back([&, i] { decoded.meshes[i] = import_mesh(document, i); });
  executor.run(jobs);
  return decoded;
}

/// Moves the results of the jobs into the assets and returns the joint count of each mesh. The first fault in file
/// order is returned.
Result<std::vector<std::uint32_t>> collect(Decoded decoded, Document& document, SceneAssets& assets, SceneInfo& info) {
  std::vector<std::uint32_t> joint_counts;
  for (std::optional<Result<ImportedMesh>>& slot : decoded.meshes) {
    if (!slot->ok()) return slot->error();
    ImportedMesh& mesh = slot->value();
    joint_counts.push_back(mesh.joint_count);
    info.replaced_normals += mesh.replaced_normals;
    document.warnings.insert(document.warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
    assets.meshes.push_back(std::move(mesh.mesh));
  }
  for (std::optional<Result<Image>>& slot : decoded.images) {
    if (!slot->ok()) return slot->error();
    assets.images.push_back(std::move(slot->value()));
  }
  return joint_counts;
}

std::uint64_t triangle_count(const Mesh& mesh) {
  std::uint64_t count = 0;
  for (const Primitive& primitive : mesh.primitives) count += primitive.indices.size() / 3;
  return count;
}

Status build_world(OpenScene& scene, const std::string& directory, const ImportOptions& options,
                   const KeyRegistry& registry, World& world, JobExecutor& executor, SceneInfo& info) {
  Document& document = scene.document;
  const Result<SceneNodeOrder> nodes = select_scene(document, options.scene);
  if (!nodes) return nodes.error();
  if (std::ranges::find(nodes->used, true) == nodes->used.end())
    document.warnings.push_back(
        (nodes->scene == kNone ? "the file" : place("scene", nodes->scene, document.scenes[nodes->scene].name)) +
        " has no nodes, so there is nothing to draw");
  SceneAssets assets;
  Result<std::vector<Texture>> textures = import_textures(document);
  if (!textures) return textures.error();
  Result<std::vector<AnimationClip>> clips = import_animations(document, options.animation, nodes->used);
  if (!clips) return clips.error();
  Result<std::vector<Skin>> skins = import_skins(document);
  if (!skins) return skins.error();
  Result<OpenedImages> opened = open_images(document, directory);
  if (!opened) return opened.error();
  for (Texture& texture : *textures)
    if (texture.image != kNone) texture.image = opened->by_index[texture.image];
  const Result<std::vector<std::uint32_t>> joint_counts =
      collect(decode(document, std::move(opened->images), executor), document, assets, info);
  if (!joint_counts) return joint_counts.error();
  if (Status status = check_scene_totals(document, *nodes, *joint_counts, assets.meshes); !status)
    return status.error();
  assets.materials = document.materials;
  assets.textures = std::move(*textures);
  assets.clips = std::move(*clips);
  assets.skins = std::move(*skins);
  world.resource<SceneAssets>() = std::move(assets);

  Result<std::vector<Entity>> entities = import_nodes(document, *nodes, *joint_counts, world);
  if (!entities) return entities.error();
  if (nodes->scene != kNone) info.name = document.scenes[nodes->scene].name;
  for (std::size_t i = 0; i < entities->size(); ++i) {
    if (!nodes->used[i]) continue;
    const NodeSource& node = document.nodes[i];
    if (node.camera != kNone) info.cameras.push_back((*entities)[i]);
    if (node.mesh != kNone) info.triangles += triangle_count(world.resource<SceneAssets>().meshes[node.mesh]);
  }
  info.node_entities = std::move(*entities);
  // Always an input error, also if a module fails to resolve a name: the file is at fault, not the caller.
  Status keys = import_keys(scene.scan, document, nodes->scene, info.node_entities, directory, registry, world);
  if (keys.ok()) keys = registry.finish(world);
  if (!keys) return Error{ErrorKind::input, keys.error().message};
  return {};
}

}  // namespace

Result<SceneInfo> import_gltf(const std::string& path, const ImportOptions& options, const KeyRegistry& registry,
                              World& world, JobExecutor& executor, LogSink& log) {
  const std::filesystem::path file(path);
  const std::string name = file.filename().string();
  const std::string directory = file.has_parent_path() ? file.parent_path().string() : ".";
  SceneInfo info;
  info.path = path;
  try {
    prepare_scene_world(world);
    Result<OpenScene> scene = open_scene(path, directory, name, registry);
    if (!scene) return scene.error();
    if (Status status = build_world(*scene, directory, options, registry, world, executor, info); !status)
      return Error{status.error().kind, name + ": " + status.error().message};
    for (const std::string& warning : scene->document.warnings) info.warnings.push_back(name + ": " + warning);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::input, name + ": it needs more memory than there is"};
  }
  for (const std::string& warning : info.warnings) log.write_from("scene", LogLevel::warning, warning);
  return info;
}

}  // namespace gloam
