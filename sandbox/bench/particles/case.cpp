// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/particles/case.h"

#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "modules/particles/components.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

constexpr std::uint32_t kParticleWidth = 640;
constexpr std::uint32_t kParticleHeight = 360;
constexpr double kParticleFrame_s = 1.0 / 60.0;

}  // namespace

Result<std::unique_ptr<ParticleCase>> ParticleCase::open(BenchContext& context, const std::string& camera) {
  auto session = context.open_builtin(kSmokeScene);
  if (!session) return session.error();
  std::unique_ptr<ParticleCase> found(new ParticleCase(std::move(session).value()));
  const auto entity = find_camera(found->session_->world, found->session_->info, camera);
  if (!entity) return entity.error();
  found->session_->camera = *entity;
  found->settings_ = found->session_->view_settings(kParticleWidth, kParticleHeight, "none");
  GLOAM_TRY(found->set("shadows.mode", "off"));
  return found;
}

void ParticleCase::use_dust(double particles) {
  World& world = session_->world;
  std::vector<Entity> emitters;
  world.view<const ParticleEmitter>().each([&](Entity entity, const ParticleEmitter&) { emitters.push_back(entity); });
  for (const Entity entity : emitters) world.remove<ParticleEmitter>(entity);
  ParticleEmitter dust;
  dust.kind = EmitterKind::dust;
  dust.lifetime_s = 4.0f;
  dust.rate = static_cast<float>(particles) / dust.lifetime_s;
  dust.size_m = 0.1f;
  dust.speed = 0.1f;
  dust.spread = kPi;
  dust.box_m = vec3(4.0f, 2.4f, 3.0f);
  const LocalTransform place{.translation = dvec3(0.0, 1.3, 0.0)};
  world.create(dust, place, WorldTransform{});
}

Status ParticleCase::set(std::string_view knob, std::string_view value) {
  return session_->renderer->knobs().set(knob, value);
}

Result<FrameSample> ParticleCase::draw() {
  time_s_ += kParticleFrame_s;
  session_->set_clock(time_s_, kParticleFrame_s);
  return session_->render_frame({settings_, {}});
}

Result<std::uint64_t> ParticleCase::hash() {
  const auto linear = session_->renderer->read_linear(settings_.id);
  if (!linear) return linear.error();
  return Hasher().items(linear->rgba).digest();
}

ParticleTimes particle_times(const FrameSample& sample) {
  ParticleTimes times;
  for (const PassTime& pass : sample.report.passes) {
    if (pass.module != "particles") continue;
    const double ns = pass.ms * kNsPerMs;
    if (pass.name == "particle_simulation") {
      times.simulation_ns += ns;
    } else if (pass.name == "particle_light") {
      times.light_ns += ns;
    } else if (pass.name == "particle_sprites") {
      times.drawing_ns += ns;
    } else {
      times.sort_ns += ns;
    }
  }
  return times;
}

}  // namespace gloam
