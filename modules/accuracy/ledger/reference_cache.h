// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/render/reference/reference.h"

namespace gloam {

/// A reference with its own error: its change from half to all of its samples, as LedgerRow::reference_noise; 0 where
/// it is exact.
struct JudgedReference {
  FramePictures pictures;
  double noise = 0.0;
};

/// References that took long to compute, in a folder, by what they were computed from: `identity`, one line.
class ReferenceCache {
 public:
  explicit ReferenceCache(std::string folder) : folder_(std::move(folder)) {}

  /// Files that are absent, damaged or of something else are nothing.
  [[nodiscard]] std::optional<JudgedReference> load(const std::string& identity) const;
  [[nodiscard]] Status save(const std::string& identity, const JudgedReference& reference) const;
  [[nodiscard]] std::string path_of(const std::string& identity) const;

 private:
  std::string folder_;
};

}  // namespace gloam
