// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/keys/value.h"

namespace gloam::gltf {

/// `extras` and `extensions` of a node, a material or a scene, exactly as written. Kind null if absent.
struct Attachments {
  SceneValue extras;
  SceneValue extensions;
};

/// Location of a buffer's or an image's bytes.
struct ByteSource {
  std::string uri;  ///< empty: none; a data URI is cut to its first 64 characters
  std::uint64_t byte_length = 0;
  std::uint64_t view = ~std::uint64_t{0};  ///< of an image: its buffer view; all ones: none
  bool data_uri = false;
  bool fallback = false;  ///< buffer of decompressed views (EXT_meshopt_compression), whose content is not needed
};

/// Bytes of a buffer.
struct ViewSource {
  std::uint64_t buffer = 0;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
};

/// A "gloam." key in the extras of an element that takes no keys.
struct StrayKey {
  std::string place;  ///< "mesh 3: "; empty: the root of the file
  std::string key;
};

/// Facts from the JSON text that tinygltf does not give: type errors, and extras as written.
struct JsonScan {
  std::string version;
  std::vector<std::string> extensions_used;
  std::vector<std::string> extensions_required;
  std::vector<Attachments> nodes;      ///< may be shorter than the file's list of nodes: the missing ones have none
  std::vector<Attachments> materials;  ///< same
  std::vector<Attachments> scenes;     ///< same
  SceneValue root_extensions;
  std::vector<ByteSource> buffers;  ///< one per buffer of the file
  std::vector<ByteSource> images;
  std::vector<ViewSource> views;   ///< one per buffer view of the file
  bool compressed_meshes = false;  ///< a primitive has KHR_draco_mesh_compression
  std::vector<StrayKey> stray_keys;
  /// Place and fault of the first member that is missing, of a wrong type, out of range or given twice. It is not an
  /// error of scan_json, so that the caller can first refuse another version or a required extension.
  std::string first_fault;
};

/// Reads the text once. Input error if it is not JSON, its root is not an object, or it is nested too deeply.
[[nodiscard]] Result<JsonScan> scan_json(std::string_view text);

}  // namespace gloam::gltf
