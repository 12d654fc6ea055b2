// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/module_list/kernel_checks.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "modules/depth_of_field/reference/kernel_checks.h"
#include "modules/glare/reference/kernel_checks.h"
#include "modules/grass/reference/kernel_checks.h"
#include "modules/lighting/reference/kernel_checks.h"
#include "modules/particles/reference/kernel_checks.h"
#include "modules/reflections/reference/kernel_checks.h"
#include "modules/shadows/reference/kernel_checks.h"

namespace gloam {

std::vector<KernelCheck> all_kernel_checks() {
  std::vector<KernelCheck> all = engine_kernel_checks();
  for (auto* const of_module :
       {&shadow_kernel_checks, &lighting_kernel_checks, &reflection_kernel_checks, &grass_kernel_checks,
        &particle_kernel_checks, &dof_kernel_checks, &glare_kernel_checks}) {
    std::vector<KernelCheck> own = of_module();
    std::ranges::move(own, std::back_inserter(all));
  }
  return all;
}

}  // namespace gloam
