// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/value.h"

namespace gloam::gltf {

/// What stands in `extras` and `extensions` of a node, a material or a scene, exactly as written. Kind null when
/// absent.
struct Attachments {
  SceneValue extras;
  SceneValue extensions;
};

/// Where a buffer's or an image's bytes are.
struct ByteSource {
  std::string uri;  ///< empty: none; a data URI is cut to its first 64 characters
  std::uint64_t byte_length = 0;
  bool data_uri = false;
};

/// A "gloam." member of the extras of something that takes no keys.
struct StrayKey {
  std::string place;  ///< "mesh 3: "; empty: the file itself
  std::string key;
};

/// What a look over the text gives that the glTF library leaves out: strict types, and extras as they were written.
struct JsonScan {
  std::string version;
  std::vector<std::string> extensions_used;
  std::vector<std::string> extensions_required;
  std::vector<Attachments> nodes;      ///< may be shorter than the file's nodes: the rest have none
  std::vector<Attachments> materials;  ///< same
  std::vector<Attachments> scenes;     ///< same
  SceneValue root_extensions;
  std::vector<ByteSource> buffers;  ///< one each
  std::vector<ByteSource> images;
  std::vector<StrayKey> stray_keys;
  /// First member that is missing, of a wrong type or given twice: place and fault. Told apart from the result so that
  /// a file of another version, or that needs an extension, is refused for that.
  std::string first_fault;
};

/// Reads the text once. Fails when it is not JSON or nested too deeply.
[[nodiscard]] Result<JsonScan> scan_json(std::string_view text);

}  // namespace gloam::gltf
