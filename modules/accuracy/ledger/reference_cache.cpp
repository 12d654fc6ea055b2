// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/ledger/reference_cache.h"

#include <cstring>
#include <span>

#include "engine/core/storage/sealed_file.h"

namespace gloam {
namespace {

template <class T>
void append_value(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <class P>
void append_picture(std::string& bytes, const P& picture) {
  append_value(bytes, picture.width);
  append_value(bytes, picture.height);
  const auto data = std::as_bytes(std::span(picture.rgba));
  bytes.append(reinterpret_cast<const char*>(data.data()), data.size());
}

/// Removes a value from the front of `bytes`; false if too few bytes are left.
template <class T>
bool take_value(std::string_view& bytes, T& value) {
  if (bytes.size() < sizeof(T)) return false;
  std::memcpy(&value, bytes.data(), sizeof(T));
  bytes.remove_prefix(sizeof(T));
  return true;
}

template <class P>
bool take_picture(std::string_view& bytes, P& picture) {
  if (!take_value(bytes, picture.width) || !take_value(bytes, picture.height)) return false;
  constexpr std::size_t kTexel = 4 * sizeof(picture.rgba[0]);
  const std::size_t pixels = std::size_t{picture.width} * picture.height;
  if (bytes.size() / kTexel < pixels) return false;
  picture.rgba.resize(pixels * 4);
  if (pixels > 0) std::memcpy(picture.rgba.data(), bytes.data(), pixels * kTexel);
  bytes.remove_prefix(pixels * kTexel);
  return true;
}

}  // namespace

std::string ReferenceCache::path_of(const std::string& identity) const {
  return folder_ + "/" + hash_text(identity) + ".reference";
}

std::optional<JudgedReference> ReferenceCache::load(const std::string& identity) const {
  const std::optional<std::string> payload = read_sealed(path_of(identity), identity);
  if (!payload) return std::nullopt;
  std::string_view bytes = *payload;
  JudgedReference reference;
  const bool whole = take_value(bytes, reference.noise) && take_picture(bytes, reference.pictures.linear) &&
                     take_picture(bytes, reference.pictures.picture) && bytes.empty();
  if (!whole) return std::nullopt;
  return reference;
}

Status ReferenceCache::save(const std::string& identity, const JudgedReference& reference) const {
  std::string bytes;
  append_value(bytes, reference.noise);
  append_picture(bytes, reference.pictures.linear);
  append_picture(bytes, reference.pictures.picture);
  return write_sealed(path_of(identity), identity, bytes);
}

}  // namespace gloam
