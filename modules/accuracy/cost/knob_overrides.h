// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/knobs/knobs.h"

namespace gloam {

/// Knobs that are set for a while: they get their values back when this ends.
class KnobOverrides {
 public:
  explicit KnobOverrides(KnobRegistry& knobs) : knobs_(knobs) {}
  ~KnobOverrides();
  KnobOverrides(const KnobOverrides&) = delete;
  KnobOverrides& operator=(const KnobOverrides&) = delete;

  /// "KNOB=VALUE", in order. Those of knobs that have the value already change nothing.
  [[nodiscard]] Status set(std::span<const std::string> assignments);

 private:
  KnobRegistry& knobs_;
  std::vector<std::pair<std::string, std::string>> before_;  ///< name and value
};

}  // namespace gloam
