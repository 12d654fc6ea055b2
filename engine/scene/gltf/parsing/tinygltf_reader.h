// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"
#include "engine/scene/gltf/parsing/container.h"
#include "engine/scene/gltf/parsing/json_scan.h"

namespace gloam::gltf {

/// Reads the text with tinygltf and translates its model. The scan of the same text must have found no fault, because
/// tinygltf skips members of wrong types. Buffers are loaded, only from the scene's folder. Images are not loaded, and
/// files that image URIs name are not opened.
[[nodiscard]] Result<Document> read_document(const Container& file, const JsonScan& scan, const std::string& directory);

}  // namespace gloam::gltf
