// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/components.h"

namespace gloam {

void add_default_glare(World& world) { world.ensure_resource<DefaultGlare>(); }

}  // namespace gloam
