// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/grass/case.h"

#include <utility>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/render/readback/geometry_picture.h"
#include "modules/grass/components.h"
#include "modules/grass/simulation/steps.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {}  // namespace

Result<std::unique_ptr<GrassCase>> GrassCase::open(BenchContext& context, const std::string& camera,
                                                   std::uint32_t width, std::uint32_t height) {
  auto probe = std::make_unique<GrassProbe>();
  GrassProbe* reader = probe.get();
  ModuleList more;
  more.push_back(std::move(probe));
  auto session = context.open_builtin(kMeadow, std::move(more));
  if (!session) return session.error();
  std::unique_ptr<GrassCase> grass(new GrassCase(std::move(session).value(), reader));
  const auto entity = find_camera(grass->session_->world, grass->session_->info, camera);
  if (!entity) return entity.error();
  grass->session_->camera = *entity;
  grass->set_size(width, height);
  GLOAM_TRY(grass->set("shadows.mode", "off"));
  return grass;
}

Status GrassCase::set(std::string_view knob, std::string_view value) {
  return session_->renderer->knobs().set(knob, value);
}

void GrassCase::set_size(std::uint32_t width, std::uint32_t height) {
  settings_ = session_->view_settings(width, height, "none");
}

void GrassCase::remove_colliders() {
  std::vector<Entity> entities;
  session_->world.view<const Collider>().each([&](Entity entity, const Collider&) { entities.push_back(entity); });
  for (const Entity entity : entities) session_->world.remove<Collider>(entity);
}

void GrassCase::restart() {
  session_->world.resource<StepClock>().restart(0);
  time_s_ = 0.0;
}

Result<FrameSample> GrassCase::draw(double dt_s) {
  time_s_ += dt_s;
  session_->set_clock(time_s_, dt_s);
  return session_->render_frame({settings_, {}});
}

Result<GrassReading> GrassCase::draw_and_read(double dt_s) {
  probe_->want();
  if (const auto sample = draw(dt_s); !sample) return sample.error();
  GrassReading reading = probe_->take();
  if (reading.blades.empty()) return Error{ErrorKind::failed, "no blade of builtin:meadow is live"};
  return reading;
}

Result<LinearPicture> GrassCase::linear() { return session_->renderer->read_linear(settings_.id); }

Result<Picture> GrassCase::picture() { return session_->renderer->read_picture(settings_.id); }

Result<double> GrassCase::coverage() {
  const auto geometry = session_->renderer->read_geometry(session_->world, settings_.id);
  if (!geometry) return geometry.error();
  std::size_t covered = 0;
  // Blades are the only subsurface surfaces of the meadow.
  for (std::size_t i = 0; i < geometry->depth.size(); ++i)
    covered += !geometry->is_sky(i) && geometry->texel(i).subsurface ? 1 : 0;
  return static_cast<double>(covered) / static_cast<double>(geometry->depth.size());
}

GrassTimes grass_times(const FrameSample& sample) {
  GrassTimes times;
  for (const PassTime& pass : sample.report.passes) {
    if (pass.module != "grass") continue;
    const double ns = pass.ms * kNsPerMs;
    if (pass.name.starts_with("grass_sort")) {
      times.sort_ns += ns;
    } else if (pass.name == "grass_keys" || pass.name == "grass_live" || pass.name == "grass_masters") {
      times.lod_ns += ns;
    } else if (pass.name == "grass_simulation") {
      times.simulation_ns += ns;
    } else if (pass.name == "grass_poses" || pass.name == "grass_blades") {
      times.drawing_ns += ns;
    }
  }
  return times;
}

double counter_of(const FrameSample& sample, const std::string& name) {
  const auto found = sample.report.counters.find(name);
  return found != sample.report.counters.end() ? found->second : 0.0;
}

std::uint64_t hash_of_poses(const GrassReading& reading) {
  Hasher hasher;
  for (shaders::GrassPose pose : reading.poses) {
    hasher.items(std::span(reading.knots).subspan(pose.first_knot, GLOAM_GRASS_KNOTS));
    pose.first_knot = 0;
    hasher.bytes_of(pose);
  }
  return hasher.digest();
}

LinearPicture averaged(const LinearPicture& picture, std::uint32_t side) {
  LinearPicture out{.width = picture.width / side, .height = picture.height / side};
  out.rgba.resize(std::size_t{out.width} * out.height * 4);
  const float weight = 1.0f / static_cast<float>(side * side);
  for (std::size_t y = 0; y < std::size_t{out.height} * side; ++y)
    for (std::size_t x = 0; x < std::size_t{out.width} * side; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        out.rgba[(y / side * out.width + x / side) * 4 + c] += weight * picture.rgba[(y * picture.width + x) * 4 + c];
  return out;
}

double distance_of_live(std::span<const std::uint32_t> bins, double range_m, std::uint32_t live) {
  std::uint32_t keys = 0;  // bins[keys] blades have a key below `keys`
  while (keys < 255 && bins[keys + 1] <= live) ++keys;
  return range_m * keys / 255.0;
}

}  // namespace gloam
