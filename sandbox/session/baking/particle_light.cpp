// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/baking/particle_light.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "engine/core/storage/sealed_file.h"
#include "modules/accuracy/module.h"
#include "modules/particles/bake.h"

namespace gloam {
namespace {

bool wants_particle_light(const Session& session) {
  return std::ranges::any_of(session.renderer->modules(), [&](const auto& module) {
    return module->name() == "particles" && module->demand(session.world, nullptr).needed;
  });
}

}  // namespace

Status ensure_particle_light(Session& session, const Options& options, LogSink& log,
                             const std::function<void(std::size_t done, std::size_t total)>& progress) {
  if (!wants_particle_light(session)) return {};
  const auto tracer = make_scene_tracer(session.world, *session.executor, {}, TracedInstances::at_rest);
  if (!tracer) return tracer.error();
  char content[17];
  std::snprintf(content, sizeof(content), "%016llx",
                static_cast<unsigned long long>(particle_light_content(session.world, **tracer)));
  const std::string identity = std::string("particle light 1 ") + content;
  const std::string path =
      options.cache_dir.empty() ? std::string() : options.cache_dir + "/particles/" + content + ".light";
  auto& current = session.world.resource<ParticleLightMaps>();
  const std::uint64_t version = current.version + 1;
  if (!path.empty()) {
    SealedFault fault = SealedFault::none;
    if (const auto bytes = read_sealed(path, identity, &fault)) {
      if (auto maps = decode_particle_light(session.world, *bytes)) {
        current = std::move(*maps);
        current.version = version;
        return {};
      }
      fault = SealedFault::damaged;
    }
    // Of what is no file, save says that it cannot be replaced.
    if (fault == SealedFault::unreadable || fault == SealedFault::damaged)
      log.warning(path + ": " + std::string(text_of(fault)) + "; the particle light is made again");
  }
  current = bake_particle_light(
      {.world = session.world, .tracer = **tracer, .executor = *session.executor, .progress = progress});
  current.version = version;
  if (path.empty()) return {};
  const Status saved = write_sealed(path, identity, encode_particle_light(session.world, current));
  if (!saved.ok()) log.warning(saved.error().message);
  return {};
}

}  // namespace gloam
