// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/tracing/embree_tracer.h"

#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "modules/accuracy/module.h"
#include "modules/accuracy/tracing/surface_fetch.h"

namespace gloam {
namespace {

/// A mesh in an Embree scene: data for the alpha test of cut-outs, and for surfaces.
struct AttachedMesh {
  TriangleMesh mesh;                       ///< without positions; indices only of cut-outs
  const CutOut* cut_out = nullptr;         ///< null: no holes
  const std::uint32_t* corners = nullptr;  ///< Embree's copy of the indices

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

/// Data of a call for the filter functions. Embree passes the pointer to `embree` on to them.
struct TraceContext {
  TraceContext() { rtcInitIntersectContext(&embree); }

  RTCIntersectContext embree = {};         // the first member
  std::span<const std::uint32_t> without;  ///< of occluded() and through_body()
  const SceneAssets* assets = nullptr;     ///< of nearest(); null in through_body()
};

const TraceContext& context_of(const RTCFilterFunctionNArguments* args) {
  return *reinterpret_cast<const TraceContext*>(args->context);
}

bool is_hole(const RTCFilterFunctionNArguments* args, unsigned int i) {
  const auto* mesh = static_cast<const AttachedMesh*>(args->geometryUserPtr);
  if (mesh->cut_out == nullptr) return false;
  return mesh->is_hole(RTCHitN_primID(args->hit, args->N, i), RTCHitN_u(args->hit, args->N, i),
                       RTCHitN_v(args->hit, args->N, i));
}

/// Rejects the hits for whose number in the packet rejects() holds.
template <class Rejects>
void reject_hits(const RTCFilterFunctionNArguments* args, const Rejects& rejects) {
  for (unsigned int i = 0; i < args->N; ++i)
    if (args->valid[i] == -1 && rejects(i)) args->valid[i] = 0;
}

/// Embree filter of occluded(): rejects hits on meshes that the rays pass through and, on cut-outs, hits in holes.
void filter_hits(const RTCFilterFunctionNArguments* args) {
  const std::span<const std::uint32_t> without = context_of(args).without;
  reject_hits(args, [&](unsigned int i) {
    return std::ranges::binary_search(without, RTCHitN_geomID(args->hit, args->N, i)) || is_hole(args, i);
  });
}

/// Embree filter of nearest(): rejects hits on the back of surfaces that have none, and in holes of cut-outs. Of
/// through_body(): as filter_hits().
void filter_nearest(const RTCFilterFunctionNArguments* args) {
  if (context_of(args).assets == nullptr) return filter_hits(args);
  const SurfaceSource& surface = static_cast<const AttachedMesh*>(args->geometryUserPtr)->mesh.surface;
  const bool double_sided = is_double_sided(*context_of(args).assets, surface);
  reject_hits(args, [&](unsigned int i) {
    const vec3 winding_normal(RTCHitN_Ng_x(args->hit, args->N, i), RTCHitN_Ng_y(args->hit, args->N, i),
                              RTCHitN_Ng_z(args->hit, args->N, i));
    const vec3 direction(RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                         RTCRayN_dir_z(args->ray, args->N, i));
    const bool back = (glm::dot(winding_normal, direction) > 0.0f) != surface.mirrored;
    return (back && !double_sided) || is_hole(args, i);
  });
}

/// Whether Embree takes the number as a coordinate of a ray: it asserts that coordinates are below 1.844e18.
bool is_coordinate(float value) { return std::abs(value) < 1.8e18f; }

bool is_ray(const vec3& origin, const vec3& direction, float from, float to) {
  for (int axis = 0; axis < 3; ++axis)
    if (!is_coordinate(origin[axis]) || !is_coordinate(direction[axis])) return false;
  return from <= to;  // also for NaN
}

/// A ray that is not finite, or too far away for Embree, meets nothing.
RTCRay make_ray(vec3 origin, vec3 direction, float from, float to) {
  if (!is_ray(origin, direction, from, to)) {
    origin = vec3(0.0f);
    direction = vec3(0.0f, 0.0f, 1.0f);
    from = 1.0f;
    to = 0.0f;  // before `from`: no ray
  }
  return {.org_x = origin.x,
          .org_y = origin.y,
          .org_z = origin.z,
          .tnear = from,
          .dir_x = direction.x,
          .dir_y = direction.y,
          .dir_z = direction.z,
          .time = 0.0f,
          .tfar = to,
          .mask = ~0u,
          .id = 0,
          .flags = 0};
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
        all_version_(triangles.hash_of_all()),
        cut_outs_(std::move(triangles.cut_outs)),
        device_(rtcNewDevice("set_affinity=0")) {
    if (device_ == nullptr) return;
    rtcSetDeviceErrorFunction(device_, note_error, &error_);
    scene_ = new_scene();
    for (TriangleMesh& mesh : triangles.meshes) attach(scene_, std::move(mesh));
    if (!triangles.uncast.empty()) uncast_ = new_scene();
    for (TriangleMesh& mesh : triangles.uncast) attach(uncast_, std::move(mesh));
    // Embree builds with as many TBB threads as the current arena allows: here the caller alone. Embree's own thread
    // setting would apply to all users of TBB in the process.
    tbb::task_arena alone(1);
    alone.execute([this] {
      rtcCommitScene(scene_);
      if (uncast_ != nullptr) rtcCommitScene(uncast_);
    });
  }
  ~EmbreeTracer() override {
    if (uncast_ != nullptr) rtcReleaseScene(uncast_);
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
  [[nodiscard]] std::uint64_t all_version() const override { return all_version_; }

  [[nodiscard]] std::span<const EmissiveMesh> emissive_meshes() const override { return emissive_; }

  void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked,
                std::span<const std::uint32_t> without) const override {
    GLOAM_ASSERT(rays.size() == blocked.size(), "one answer a ray");
    for (std::size_t first = 0; first < rays.size(); first += kBatch) {
      const std::size_t count = std::min(kBatch, rays.size() - first);
      trace(rays.subspan(first, count), blocked.subspan(first, count), without);
    }
  }

  void through_body(std::span<const ShadowRay> rays, std::span<BodyPath> paths,
                    std::span<const std::uint32_t> without) const override {
    GLOAM_ASSERT(rays.size() == paths.size(), "one path a ray");
    TraceContext context;
    context.without = without;
    for (std::size_t i = 0; i < rays.size(); ++i) paths[i] = path_on(rays[i], context);
  }

  void nearest(const SceneAssets& assets, std::span<const SurfaceRay> rays,
               std::span<TracedSurface> surfaces) const override {
    GLOAM_ASSERT(rays.size() == surfaces.size(), "one surface a ray");
    TraceContext context;
    context.assets = &assets;
    for (std::size_t i = 0; i < rays.size(); ++i) surfaces[i] = surface_on(rays[i], context);
  }

 private:
  static constexpr std::size_t kBatch = 64;

  [[nodiscard]] RTCScene new_scene() const {
    const RTCScene scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no ray passes between triangles that share an edge
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    return scene;
  }

  /// Meshes of both scenes are numbered on, in the order of attached_.
  void attach(RTCScene scene, TriangleMesh mesh) {
    const auto number = static_cast<std::uint32_t>(attached_.size());
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, std::span<const vec3>(mesh.positions), 1);
    fill_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, std::span<const std::uint32_t>(mesh.indices), 3);
    const bool casts = scene == scene_, emissive = mesh.emissive_reach_m > 0.0;
    if (casts && emissive) emissive_.push_back({number, mesh.min, mesh.max, mesh.emissive_reach_m});
    auto data = std::make_unique<AttachedMesh>();
    if (mesh.cut_out != kNone) data->cut_out = &cut_outs_[mesh.cut_out];
    if (casts && (emissive || data->cut_out != nullptr)) rtcSetGeometryOccludedFilterFunction(geometry, filter_hits);
    rtcSetGeometryIntersectFilterFunction(geometry, filter_nearest);
    rtcSetGeometryUserData(geometry, data.get());
    data->mesh = std::move(mesh);
    data->mesh.positions = {};
    if (data->cut_out == nullptr) data->mesh.indices = {};
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, number);
    data->corners = static_cast<const std::uint32_t*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_INDEX, 0));
    attached_.push_back(std::move(data));
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
    for (std::size_t i = 0; i < rays.size(); ++i)
      batch[i] = make_ray(rays[i].origin, rays[i].direction, rays[i].from, rays[i].to);
    TraceContext context;
    context.without = without;
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded1M(scene_, &context.embree, batch.data(), static_cast<unsigned int>(rays.size()), sizeof(RTCRay));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool is_segment = rays[i].from < rays[i].to;
      blocked[i] = is_segment && batch[i].tfar == -std::numeric_limits<float>::infinity() ? 1 : 0;
    }
  }

  /// Follows the ray from surface to surface.
  [[nodiscard]] BodyPath path_on(const ShadowRay& ray, TraceContext& context) const {
    constexpr float kStep = 1e-6f;  // beyond a surface, as a share of the ray so far
    const float length = glm::length(ray.direction);
    BodyPath path;
    std::uint32_t body = RTC_INVALID_GEOMETRY_ID;
    bool inside = true;
    float entered = ray.from, from = ray.from;
    while (from < ray.to) {
      RTCRayHit at{};
      at.ray = make_ray(ray.origin, ray.direction, from, ray.to);
      at.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context.embree, &at);
      if (at.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
      const vec3 winding_normal(at.hit.Ng_x, at.hit.Ng_y, at.hit.Ng_z);
      const bool mirrored = attached_[at.hit.geomID]->mesh.surface.mirrored;
      const bool leaves = (glm::dot(winding_normal, ray.direction) > 0.0f) != mirrored;
      if (body == RTC_INVALID_GEOMETRY_ID && leaves) body = at.hit.geomID;
      if (at.hit.geomID != body) return {path.inside_m, true};
      // An edge may be met twice, once for each of its triangles: the second time changes nothing.
      if (leaves && inside) path.inside_m += (at.ray.tfar - entered) * length;
      if (!leaves && !inside) entered = at.ray.tfar;
      inside = !leaves;
      from = at.ray.tfar + std::max(at.ray.tfar, kStep) * kStep;
    }
    path.blocked = body != RTC_INVALID_GEOMETRY_ID && inside;
    return path;
  }

  [[nodiscard]] TracedSurface surface_on(const SurfaceRay& ray, TraceContext& context) const {
    RTCRayHit at{};
    at.ray = make_ray(ray.origin, ray.direction, 0.0f, ray.to_m);
    at.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context.embree, &at);
    if (uncast_ != nullptr) rtcIntersect1(uncast_, &context.embree, &at);
    TracedSurface surface;
    if (at.hit.geomID == RTC_INVALID_GEOMETRY_ID) return surface;
    surface.hit = true;
    surface.distance_m = at.ray.tfar;
    surface.position = ray.origin + at.ray.tfar * ray.direction;
    const AttachedMesh& mesh = *attached_[at.hit.geomID];
    const SurfaceHit hit = {.corners = mesh.corners + 3 * std::size_t{at.hit.primID},
                            .share = vec3(1.0f - at.hit.u - at.hit.v, at.hit.u, at.hit.v),
                            .winding_normal = vec3(at.hit.Ng_x, at.hit.Ng_y, at.hit.Ng_z),
                            .direction = ray.direction};
    fetch_surface(*context.assets, mesh.mesh.surface, hit, textures_, surface);
    return surface;
  }

  const dvec3 origin_;
  const std::uint64_t triangles_;
  const std::uint64_t version_;
  const std::uint64_t all_version_;
  const std::vector<CutOut> cut_outs_;
  const TextureFetch textures_;
  std::vector<std::unique_ptr<AttachedMesh>> attached_;  ///< by number
  std::vector<EmissiveMesh> emissive_;
  std::string error_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;   ///< meshes that cast shadows
  RTCScene uncast_ = nullptr;  ///< all others; null if there are none
};

}  // namespace

Result<std::unique_ptr<SceneTracer>> make_embree_tracer(SceneTriangles triangles) {
  auto tracer = std::make_unique<EmbreeTracer>(std::move(triangles));
  GLOAM_TRY(tracer->status());
  return std::unique_ptr<SceneTracer>(std::move(tracer));
}

Result<std::unique_ptr<SceneTracer>> make_scene_tracer(const World& world, JobExecutor& executor,
                                                       const std::optional<dvec3>& origin, TracedInstances traced) {
  return make_embree_tracer(gather_triangles(world, origin, executor, traced));
}

}  // namespace gloam
