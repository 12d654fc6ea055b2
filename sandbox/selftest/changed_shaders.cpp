// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/selftest/changed_shaders.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "sandbox/output/file_io.h"
#include "sandbox/play/shader_files.h"
#include "sandbox/play/shader_reload.h"
#include "shaders/every/shaders.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Files below `shaders` that differ from those of the program's own tree, relative to the tree.
Result<std::vector<std::string>> changed_files(const std::string& root) {
  for (const std::string& tree : {root, std::string(GLOAM_SOURCE_ROOT)}) {
    std::error_code fault;
    if (!fs::is_directory(fs::path(tree) / "shaders", fault))
      return Error{ErrorKind::usage, "--shaders: " + tree + " has no folder shaders"};
  }
  std::vector<std::string> changed;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(root) / "shaders")) {
    if (!entry.is_regular_file()) continue;
    const std::string file = fs::relative(entry.path(), root).generic_string();
    const auto text = read_text_file(entry.path().string(), ErrorKind::input);
    if (!text) return text.error();
    const auto own = read_text_file(std::string(GLOAM_SOURCE_ROOT) + "/" + file, ErrorKind::input);
    if (!own || *own != *text) changed.push_back(file);
  }
  std::ranges::sort(changed);
  return changed;
}

}  // namespace

Result<std::vector<ChangedShader>> compile_changed_shaders(const std::string& root) {
  const auto changed = changed_files(root);
  if (!changed) return changed.error();
  std::map<std::string, const gpu::ShaderCode*> embedded;
  std::vector<std::string> names;
  for (const gpu::ShaderCode* shader : every_shader()) {
    names.push_back(file_of(*shader));
    embedded[names.back()] = shader;
  }
  std::vector<ChangedShader> shaders;
  for (const std::string& file : ShaderFiles(root).that_include(names, *changed)) {
    auto words = compile_shader(root, file);
    if (!words) return words.error();
    shaders.push_back({embedded.at(file), std::move(words).value()});
  }
  return shaders;
}

}  // namespace gloam
