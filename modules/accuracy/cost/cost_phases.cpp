// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/module.h"

namespace gloam {

std::string_view name_of(CostPhase phase) {
  switch (phase) {
    case CostPhase::start:
      return "until memory had settled";
    case CostPhase::pictures:
      return "pictures";
    case CostPhase::exact:
      return "exact pictures";
    case CostPhase::references:
      return "references";
    case CostPhase::comparison:
      return "comparisons";
    case CostPhase::timing:
      return "timing";
    case CostPhase::memory:
      return "memory";
    case CostPhase::other:
      return "other work";
  }
  return {};
}

}  // namespace gloam
