// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/kernel_check/kernel_check.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/render/kernel_check/engine_checks.h"

namespace gloam {

std::vector<KernelCheck> engine_kernel_checks() {
  std::vector<KernelCheck> checks = {sort_check()};
  std::vector<KernelCheck> deform = deform_checks();
  std::ranges::move(deform, std::back_inserter(checks));
  checks.push_back(srgb_check());
  return checks;
}

}  // namespace gloam
