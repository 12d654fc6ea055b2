// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "sandbox/options.h"

namespace gloam {

/// One measurement of a sweep: a line of a list of scenes.
struct ListEntry {
  std::size_t line = 0;                ///< of the file, from 1
  std::string text;                    ///< the words of the line, with one blank between them
  std::string name;                    ///< of the measurement's folder: depends on `text` alone, unique in the list
  std::string scene;                   ///< a relative path is joined to the list's folder
  std::vector<std::string> arguments;  ///< options of this scene; --config as `scene`
};

/// Reads a list of scenes: on each line a scene and then its options, separated by blanks. '…' and "…" keep blanks in a
/// word. Empty lines and text from a word that begins with # are skipped. path: of the list's file, for relative paths
/// and for errors, which are of ErrorKind::input and name the line: no entry at all, an open quote, an option in the
/// scene's place, an option that belongs to the whole sweep, two equal lines.
[[nodiscard]] Result<std::vector<ListEntry>> parse_scene_list(std::string_view text, const std::string& path);

/// Whether the entry of this index, from 0, is in the shard.
[[nodiscard]] bool in_shard(const Shard& shard, std::size_t index);

}  // namespace gloam
