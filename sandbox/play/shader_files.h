// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gloam {

/// The files below the folder `shaders` of a source tree. Paths are relative to the tree and have slashes:
/// "shaders/fog/blur.frag.glsl".
class ShaderFiles {
 public:
  explicit ShaderFiles(std::filesystem::path root) : root_(std::move(root)) { (void)changed(); }

  /// The files that were changed or added since the last call. A file that cannot be read counts as unchanged.
  [[nodiscard]] std::vector<std::string> changed();

  /// Of these shaders, those that are one of the files or include one, also through other files.
  [[nodiscard]] std::vector<std::string> that_include(const std::vector<std::string>& shaders,
                                                      const std::vector<std::string>& files) const;

 private:
  [[nodiscard]] bool reaches(const std::string& file, const std::set<std::string>& wanted,
                             std::set<std::string>& visited) const;

  std::filesystem::path root_;
  std::map<std::string, std::filesystem::file_time_type> times_;
};

/// Paths in the #include lines of a shader's text.
[[nodiscard]] std::vector<std::string> included_files(std::string_view text);

}  // namespace gloam
