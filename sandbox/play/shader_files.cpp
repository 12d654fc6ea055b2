// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/shader_files.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "sandbox/output/file_io.h"

namespace gloam {
namespace fs = std::filesystem;

std::vector<std::string> ShaderFiles::changed() {
  std::vector<std::string> files;
  std::error_code fault;
  for (auto at = fs::recursive_directory_iterator(root_ / "shaders", fault); !fault && at != fs::end(at);
       at.increment(fault)) {
    std::error_code unreadable;
    if (!at->is_regular_file(unreadable)) continue;
    const fs::file_time_type time = at->last_write_time(unreadable);
    if (unreadable) continue;
    std::string path = at->path().lexically_relative(root_).generic_string();
    const auto [known, fresh] = times_.try_emplace(path, time);
    if (!fresh && std::exchange(known->second, time) == time) continue;
    files.push_back(std::move(path));
  }
  return files;
}

std::vector<std::string> ShaderFiles::that_include(const std::vector<std::string>& shaders,
                                                   const std::vector<std::string>& files) const {
  const std::set<std::string> wanted(files.begin(), files.end());
  std::vector<std::string> found;
  for (const std::string& shader : shaders) {
    std::set<std::string> visited;
    if (reaches(shader, wanted, visited)) found.push_back(shader);
  }
  return found;
}

bool ShaderFiles::reaches(const std::string& file, const std::set<std::string>& wanted,
                          std::set<std::string>& visited) const {
  if (wanted.contains(file)) return true;
  if (!visited.insert(file).second) return false;
  const auto text = read_text_file((root_ / file).string(), ErrorKind::input);
  if (!text.ok()) return false;
  const std::vector<std::string> included = included_files(*text);
  return std::ranges::any_of(included, [&](const std::string& path) { return reaches(path, wanted, visited); });
}

std::vector<std::string> included_files(std::string_view text) {
  constexpr std::string_view kDirective = "#include \"";
  std::vector<std::string> files;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (!line.starts_with(kDirective)) continue;
    const std::string_view path = line.substr(kDirective.size());
    files.emplace_back(path.substr(0, path.find('"')));
  }
  return files;
}

}  // namespace gloam
