// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/selftest/context.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <utility>

#include "engine/render/reference/reference.h"
#include "sandbox/output/file_io.h"
#include "sandbox/output/pictures/image_io.h"
#include "sandbox/session/baking/captures.h"
#include "sandbox/session/drawing/frame_run.h"
#include "sandbox/session/drawing/session_costs.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/session.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

std::string scratch_folder() {
  std::error_code fault;
  std::string name = (fs::temp_directory_path(fault) / "gloam-selftest-XXXXXX").string();
  return mkdtemp(name.data()) != nullptr ? name : std::string();
}

/// Mean difference of the light over the mean light of `right`.
double relative_difference(const LinearPicture& picture, const LinearPicture& right) {
  if (picture.rgba.size() != right.rgba.size()) return std::numeric_limits<double>::infinity();
  double sum = 0.0, light = 0.0;
  for (std::size_t i = 0; i < right.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    sum += std::abs(double{picture.rgba[i]} - double{right.rgba[i]});
    light += std::abs(double{right.rgba[i]});
  }
  return light > 0.0 ? sum / light : sum;
}

TestPicture shown(const Picture& picture) { return {picture.width, picture.height, picture.rgba, {}}; }

Result<TestPicture> read_back(Session& session, ViewId view) {
  auto picture = session.renderer->read_picture(view);
  if (!picture) return picture.error();
  auto light = session.renderer->read_linear(view);
  if (!light) return light.error();
  return TestPicture{.width = picture->width,
                     .height = picture->height,
                     .rgba = std::move(picture->rgba),
                     .light = std::move(light->rgba)};
}

}  // namespace

double TestPicture::mean_light() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < light.size(); i += 4)
    sum += double{light[i]} + double{light[i + 1]} + double{light[i + 2]};
  return sum / (0.75 * static_cast<double>(light.size()));
}

TestPicture TestPicture::flipped() const {
  TestPicture other = *this;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t to = 4 * (y * width + x), from = 4 * (y * width + width - 1 - x);
      std::copy_n(rgba.begin() + static_cast<std::ptrdiff_t>(from), 4,
                  other.rgba.begin() + static_cast<std::ptrdiff_t>(to));
      std::copy_n(light.begin() + static_cast<std::ptrdiff_t>(from), 4,
                  other.light.begin() + static_cast<std::ptrdiff_t>(to));
    }
  return other;
}

double mean_difference(const TestPicture& a, const TestPicture& b) {
  if (a.width != b.width || a.height != b.height || a.rgba.empty()) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    if (i % 4 != 3) sum += std::abs(static_cast<double>(a.rgba[i]) - static_cast<double>(b.rgba[i]));
  return sum / (0.75 * static_cast<double>(a.rgba.size()));
}

TestView view_of(const EffectScene& scene) {
  return {.knobs = scene.knobs, .frames = scene.frames, .time_s = scene.time_s};
}

SelfTestContext::SelfTestContext(const Options& options, LogSink& log, std::shared_ptr<gpu::Device> device,
                                 std::vector<ChangedShader> shaders)
    : options_(options),
      log_(log),
      device_(std::move(device)),
      shaders_(std::move(shaders)),
      lab_(*device_, log_),
      folder_(scratch_folder()) {
  for (const ChangedShader& changed : shaders_) lab_.replace_shader(changed.shader->name, changed.words);
}

SelfTestContext::~SelfTestContext() {
  std::error_code fault;
  if (!folder_.empty()) fs::remove_all(folder_, fault);
}

Options SelfTestContext::options_for(const std::string& path, const TestView& view) const {
  Options options = options_;
  options.scene = path;
  options.width = view.width;
  options.height = view.height;
  options.frames = view.frames;
  options.time_s = view.time_s;
  options.dt_s = view.dt_s;
  options.threads = view.threads;
  options.out.clear();
  if (!is_builtin(path)) options.cache_dir.clear();  // nobody asks for baked data of test scenes again
  for (const KnobOverride& knob : view.knobs) options.assignments.push_back(knob.name + "=" + knob.value);
  return options;
}

Result<std::unique_ptr<Session>> SelfTestContext::open(const Options& options) {
  auto opened = open_session_on(device_, options, log_);
  if (!opened) return opened;
  GLOAM_TRY(ensure_baked(**opened, options, log_));
  for (const ChangedShader& changed : shaders_)
    GLOAM_TRY((*opened)->renderer->replace_shader(*changed.shader, changed.words));
  return opened;
}

Result<TestPicture> SelfTestContext::draw_file(const std::string& path, const TestView& view) {
  const Options options = options_for(path, view);
  auto opened = open(options);
  if (!opened) return opened.error();
  Session& session = **opened;
  const ViewRequest request{session.view_settings(view.width, view.height, "none"), {}};
  FrameRun run(session, view.in_flight);
  for (std::uint32_t frame = 0; frame < view.frames; ++frame) {
    session.set_clock(view.time_s + frame * view.dt_s + (frame > 0 ? view.pause_s : 0.0),
                      view.dt_s + (frame == 1 ? view.pause_s : 0.0));
    GLOAM_TRY(run.draw(request));
  }
  const auto drawn = run.finish();
  if (!drawn) return drawn.error();
  counters_ = drawn->back().report.counters;
  GLOAM_TRY(session.check_validation());
  auto picture = read_back(session, request.settings.id);
  if (!picture) return picture;
  ++pictures_;
  const auto bad = static_cast<std::size_t>(
      std::ranges::count_if(picture->light, [](float value) { return !std::isfinite(value); }));
  if (bad > 0 && non_finite_ == 0) first_non_finite_ = path;
  non_finite_ += bad;
  return picture;
}

Result<std::string> SelfTestContext::write_scene(const TestScene& scene, const Placement& placement) const {
  if (folder_.empty()) return Error{ErrorKind::failed, "no folder for temporary files can be made"};
  const TestSceneFiles files = scene.gltf(placement);
  std::string path = folder_ + "/scene.gltf";
  GLOAM_TRY(write_file(folder_ + "/" + kTestSceneBuffer, files.buffer));
  GLOAM_TRY(write_file(path, files.json));
  return path;
}

Result<TestPicture> SelfTestContext::draw(const TestScene& scene, const Placement& placement, const TestView& view) {
  const auto path = write_scene(scene, placement);
  return path ? draw_file(*path, view) : path.error();
}

Result<TestPicture> SelfTestContext::draw(const EffectScene& scene) {
  auto& kept = usual_[std::string(scene.name)];
  if (kept) return *kept;
  auto drawn = draw(scene, Placement());
  if (!drawn) return drawn;
  kept = *drawn;
  if (options_.out.empty()) return drawn;
  const std::string path = options_.out + "/pictures/" + std::string(scene.name) + ".png";
  GLOAM_TRY(make_folder_of(path));
  GLOAM_TRY(write_png(path, drawn->width, drawn->height, drawn->rgba));
  return drawn;
}

Result<TestPicture> SelfTestContext::draw(const EffectScene& scene, const Placement& placement) {
  return draw(scene.make(), placement, view_of(scene));
}

Result<TestPicture> SelfTestContext::draw_builtin(const std::string& name, const TestView& view) {
  return draw_file(name, view);
}

Result<double> SelfTestContext::reference_error(const TestScene& scene, const TestView& view, const std::string& knob,
                                                std::uint32_t samples) {
  const auto path = write_scene(scene, {});
  if (!path) return path.error();
  const Options options = options_for(*path, view);
  auto opened = open(options);
  if (!opened) return opened.error();
  SessionCosts costs(**opened, options);
  const std::vector<ReferenceInfo> references = costs.references();
  const auto reference = std::ranges::find(references, knob, &ReferenceInfo::knob);
  if (reference == references.end()) return Error{ErrorKind::failed, "no module states a reference for " + knob};
  for (std::uint32_t frame = 0; frame < view.frames; ++frame)
    if (const auto drawn = costs.draw(static_cast<std::int32_t>(frame)); !drawn) return drawn.error();
  if (reference->distance) {
    const auto distance = costs.measure_distance(*reference, samples);
    if (!distance) return distance.error();
    if (!*distance) return Error{ErrorKind::failed, "the frame has nothing to measure for " + knob};
    return (*distance)->mean;
  }
  const auto picture = costs.read();
  if (!picture) return picture.error();
  const auto right = costs.draw_reference(*reference, *picture, samples);
  if (!right) return right.error();
  if (!right->linear.rgba.empty()) return relative_difference(picture->linear, right->linear);
  return mean_difference(shown(picture->picture), shown(right->picture));
}

}  // namespace gloam
