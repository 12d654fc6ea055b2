// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/kept_pipelines.h"

#include <filesystem>
#include <string>
#include <system_error>

#include "engine/core/hash.h"
#include "engine/core/text/formatted.h"
#include "engine/render/pipelines/pipeline_record.h"
#include "sandbox/output/file_io.h"
#include "sandbox/session/loading/scene_loading.h"
#include "shaders/every/shaders.h"

namespace gloam {
namespace {

/// The list's file: by scene, camera, view and knobs. A scene that has changed in its file may need other pipelines;
/// the list is then right for most, and written anew.
std::string list_file(const Session& session, const Options& options) {
  Hasher hash;
  std::error_code fault;
  const std::filesystem::path path = std::filesystem::absolute(options.scene, fault);
  hash.text(is_builtin(options.scene) || fault ? options.scene : path.string());
  hash.text(options.camera).text(options.view);
  const KnobRegistry& knobs = session.renderer->knobs();
  for (const Knob& knob : knobs.knobs()) hash.text(knob.name).bytes_of(knobs.number(knob));
  return options.cache_dir + "/pipelines/" + formatted("%016llx.json", static_cast<unsigned long long>(hash.digest()));
}

}  // namespace

void make_kept_pipelines(Session& session, const Options& options, LogSink& log) {
  if (options.cache_dir.empty()) return;
  const std::string path = list_file(session, options);
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault)) return;
  const auto kept = read_text_file(path, ErrorKind::input);
  if (kept && is_sound_record(*kept))
    session.renderer->make_pipelines(*kept, every_shader());
  else
    log.warning((kept ? path + ": is damaged" : kept.error().message) + "; the list of pipelines is made again");
}

void keep_pipelines(Session& session, const Options& options, LogSink& log) {
  if (options.cache_dir.empty()) return;
  const std::string path = list_file(session, options);
  const std::string record = session.renderer->pipeline_record();
  const auto kept = read_text_file(path, ErrorKind::input);
  if (kept && *kept == record) return;
  Status written = make_folder_of(path);
  if (written.ok()) written = write_file(path, record);
  if (!written.ok()) log.warning(written.error().message);
}

}  // namespace gloam
