// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/module_list/module_list.h"

#include "modules/closeups/module.h"
#include "modules/depth_of_field/module.h"
#include "modules/fog/module.h"
#include "modules/glare/module.h"
#include "modules/grass/module.h"
#include "modules/lighting/module.h"
#include "modules/lights/module.h"
#include "modules/particles/module.h"
#include "modules/reflections/module.h"
#include "modules/shadows/module.h"

namespace gloam {

ModuleList make_all_modules() {
  ModuleList modules;
  modules.push_back(make_lights_module());
  modules.push_back(make_shadows_module());
  modules.push_back(make_closeups_module());
  modules.push_back(make_lighting_module());
  modules.push_back(make_reflections_module());
  modules.push_back(make_grass_module());
  modules.push_back(make_particles_module());
  modules.push_back(make_fog_module());
  modules.push_back(make_depth_of_field_module());
  modules.push_back(make_glare_module());
  return modules;
}

}  // namespace gloam
