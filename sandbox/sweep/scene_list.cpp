// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/sweep/scene_list.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "engine/core/storage/sealed_file.h"
#include "engine/core/text/plain_text.h"

namespace gloam {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// nullopt: a quote is open at the end of the line.
std::optional<std::vector<std::string>> words_of(std::string_view line) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while (true) {
    while (at < line.size() && is_blank(line[at])) ++at;
    if (at == line.size() || line[at] == '#') return words;
    std::string& word = words.emplace_back();
    while (at < line.size() && !is_blank(line[at])) {
      const char c = line[at++];
      if (c != '\'' && c != '"') {
        word += c;
        continue;
      }
      const std::size_t end = line.find(c, at);
      if (end == std::string_view::npos) return std::nullopt;
      word += line.substr(at, end - at);
      at = end + 1;
    }
  }
}

std::string beside(const std::string& list, const std::string& path) {
  // An absolute path replaces the folder.
  return (std::filesystem::path(list).parent_path() / path).string();
}

std::string folder_name(const std::string& scene, const std::string& text) {
  constexpr std::size_t kMostLetters = 40;
  const std::size_t builtin = scene.starts_with("builtin:") ? std::string_view("builtin:").size() : 0;
  std::string stem = std::filesystem::path(scene.substr(builtin)).stem().string().substr(0, kMostLetters);
  for (char& c : stem) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (!plain) c = '-';
  }
  return stem + "-" + hash_text(text);
}

std::optional<std::string> fault_of(const std::vector<std::string>& words) {
  constexpr std::array kOfTheSweep = {"--out", "--list", "--shard", "--merge"};
  if (words.front().starts_with('-'))
    return "begins with " + one_line(words.front()) + "; a line is a scene, then its options";
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (std::ranges::find(kOfTheSweep, name) != kOfTheSweep.end()) return name + " is no option of one scene";
  }
  return std::nullopt;
}

ListEntry entry_of(std::vector<std::string> words, std::size_t line, const std::string& path) {
  ListEntry entry = {.line = line};
  for (const std::string& word : words) entry.text += (entry.text.empty() ? "" : " ") + word;
  entry.name = folder_name(words.front(), entry.text);
  entry.scene = words.front().starts_with("builtin:") ? words.front() : beside(path, words.front());
  const std::string config = "--config=";
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i - 1] == "--config") words[i] = beside(path, words[i]);
    if (words[i].starts_with(config)) words[i] = config + beside(path, words[i].substr(config.size()));
    entry.arguments.push_back(words[i]);
  }
  return entry;
}

}  // namespace

Result<std::vector<ListEntry>> parse_scene_list(std::string_view text, const std::string& path) {
  std::vector<ListEntry> entries;
  const auto fault = [&](std::size_t line, const std::string& what) {
    return Error{ErrorKind::input, path + ":" + std::to_string(line) + ": " + what};
  };
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    auto words = words_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!words) return fault(line, "a quote is not closed");
    if (words->empty()) continue;
    if (const auto wrong = fault_of(*words)) return fault(line, *wrong);
    ListEntry entry = entry_of(std::move(*words), line, path);
    const auto same = std::ranges::find(entries, entry.name, &ListEntry::name);
    if (same != entries.end()) return fault(line, "repeats line " + std::to_string(same->line));
    entries.push_back(std::move(entry));
  }
  if (entries.empty()) return Error{ErrorKind::input, path + ": no line names a scene"};
  return entries;
}

bool in_shard(const Shard& shard, std::size_t index) { return index % shard.count == shard.number - 1; }

}  // namespace gloam
