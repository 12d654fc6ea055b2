// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/tracing/embree_tracer.h"

#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "modules/accuracy/module.h"

namespace gloam {
namespace {

/// Data for the alpha test of a hit on a cut-out surface.
struct CutOutMesh {
  TriangleMesh mesh;
  const CutOut* cut_out = nullptr;

  /// `u`, `v`: barycentric weights of the second and third corner.
  [[nodiscard]] bool is_hole(std::uint32_t triangle, float u, float v) const {
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t{triangle}];
    const vec3 share(1.0f - u - v, u, v);
    const vec2 uv = share.x * mesh.uvs[corner[0]] + share.y * mesh.uvs[corner[1]] + share.z * mesh.uvs[corner[2]];
    float alpha = 1.0f;
    if (!mesh.alphas.empty())
      alpha = glm::dot(share, vec3(mesh.alphas[corner[0]], mesh.alphas[corner[1]], mesh.alphas[corner[2]]));
    return cut_out->is_hole(uv, alpha);
  }
};

/// What the filters know about a call. Embree passes the pointer to `embree` on.
struct TraceContext {
  RTCIntersectContext embree;  // the first member
  std::span<const std::uint32_t> without;
};

/// Embree filter: rejects hits on meshes that the rays pass through and, on cut-outs, hits in holes. The user data is
/// null for meshes without holes.
void filter_hits(const RTCFilterFunctionNArguments* args) {
  const auto* mesh = static_cast<const CutOutMesh*>(args->geometryUserPtr);
  const std::span<const std::uint32_t> without = reinterpret_cast<const TraceContext*>(args->context)->without;
  for (unsigned int i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    if (std::ranges::binary_search(without, RTCHitN_geomID(args->hit, args->N, i))) {
      args->valid[i] = 0;
      continue;
    }
    if (mesh == nullptr) continue;
    const float u = RTCHitN_u(args->hit, args->N, i);
    const float v = RTCHitN_v(args->hit, args->N, i);
    if (mesh->is_hole(RTCHitN_primID(args->hit, args->N, i), u, v)) args->valid[i] = 0;
  }
}

void note_error(void* text, RTCError, const char* message) {
  auto& first = *static_cast<std::string*>(text);
  if (first.empty()) first = message != nullptr ? message : "unknown";
}

class EmbreeTracer final : public SceneTracer {
 public:
  explicit EmbreeTracer(SceneTriangles triangles)
      : origin_(triangles.origin),
        triangles_(triangles.count()),
        version_(triangles.hash()),
        cut_outs_(std::move(triangles.cut_outs)),
        device_(rtcNewDevice("set_affinity=0")) {
    if (device_ == nullptr) return;
    rtcSetDeviceErrorFunction(device_, note_error, &error_);
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);  // no ray passes between triangles that share an edge
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    for (TriangleMesh& mesh : triangles.meshes) attach(std::move(mesh));
    // Embree builds with as many TBB threads as the current arena allows: here the caller alone. Embree's own thread
    // setting would apply to all users of TBB in the process.
    tbb::task_arena alone(1);
    alone.execute([this] { rtcCommitScene(scene_); });
  }
  ~EmbreeTracer() override {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    if (device_ != nullptr) rtcReleaseDevice(device_);
  }
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  [[nodiscard]] Status status() const {
    if (device_ == nullptr) return Error{ErrorKind::failed, "Embree cannot be used on this machine"};
    if (!error_.empty()) return Error{ErrorKind::failed, "Embree cannot take the scene: " + error_};
    return {};
  }

  [[nodiscard]] dvec3 origin() const override { return origin_; }
  [[nodiscard]] std::uint64_t triangles() const override { return triangles_; }
  [[nodiscard]] std::uint64_t version() const override { return version_; }

  [[nodiscard]] std::span<const EmissiveMesh> emissive_meshes() const override { return emissive_; }

  void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked,
                std::span<const std::uint32_t> without) const override {
    GLOAM_ASSERT(rays.size() == blocked.size(), "one answer a ray");
    for (std::size_t first = 0; first < rays.size(); first += kBatch) {
      const std::size_t count = std::min(kBatch, rays.size() - first);
      trace(rays.subspan(first, count), blocked.subspan(first, count), without);
    }
  }

 private:
  static constexpr std::size_t kBatch = 64;

  void attach(TriangleMesh mesh) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, std::span<const vec3>(mesh.positions), 1);
    fill_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, std::span<const std::uint32_t>(mesh.indices), 3);
    if (mesh.emissive_reach_m > 0.0) {
      rtcSetGeometryOccludedFilterFunction(geometry, filter_hits);
      emissive_.push_back({attached_, mesh.min, mesh.max, mesh.emissive_reach_m});
    }
    if (mesh.cut_out != kNone) {
      auto data = std::make_unique<CutOutMesh>();
      data->cut_out = &cut_outs_[mesh.cut_out];
      data->mesh = std::move(mesh);
      data->mesh.positions = {};
      rtcSetGeometryUserData(geometry, data.get());
      rtcSetGeometryOccludedFilterFunction(geometry, filter_hits);
      cut_out_meshes_.push_back(std::move(data));
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, attached_++);
    rtcReleaseGeometry(geometry);
  }

  template <class T>
  static void fill_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::span<const T> values,
                          std::size_t values_an_item) {
    void* buffer =
        rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T) * values_an_item, values.size() / values_an_item);
    if (buffer != nullptr) std::memcpy(buffer, values.data(), values.size_bytes());
  }

  void trace(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked,
             std::span<const std::uint32_t> without) const {
    std::array<RTCRay, kBatch> batch;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const ShadowRay& ray = rays[i];
      batch[i] = {.org_x = ray.origin.x,
                  .org_y = ray.origin.y,
                  .org_z = ray.origin.z,
                  .tnear = ray.from,
                  .dir_x = ray.direction.x,
                  .dir_y = ray.direction.y,
                  .dir_z = ray.direction.z,
                  .time = 0.0f,
                  .tfar = ray.to,
                  .mask = ~0u,
                  .id = 0,
                  .flags = 0};
    }
    TraceContext context{.embree = {}, .without = without};
    rtcInitIntersectContext(&context.embree);
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded1M(scene_, &context.embree, batch.data(), static_cast<unsigned int>(rays.size()), sizeof(RTCRay));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool is_segment = rays[i].from < rays[i].to;
      blocked[i] = is_segment && batch[i].tfar == -std::numeric_limits<float>::infinity() ? 1 : 0;
    }
  }

  const dvec3 origin_;
  const std::uint64_t triangles_;
  const std::uint64_t version_;
  const std::vector<CutOut> cut_outs_;
  std::vector<std::unique_ptr<CutOutMesh>> cut_out_meshes_;
  std::vector<EmissiveMesh> emissive_;
  std::uint32_t attached_ = 0;
  std::string error_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace

Result<std::unique_ptr<SceneTracer>> make_embree_tracer(SceneTriangles triangles) {
  auto tracer = std::make_unique<EmbreeTracer>(std::move(triangles));
  GLOAM_TRY(tracer->status());
  return std::unique_ptr<SceneTracer>(std::move(tracer));
}

Result<std::unique_ptr<SceneTracer>> make_scene_tracer(const World& world, JobExecutor& executor,
                                                       const std::optional<dvec3>& origin) {
  return make_embree_tracer(gather_triangles(world, origin, executor));
}

}  // namespace gloam
