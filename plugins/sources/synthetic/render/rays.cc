#include "plugins/sources/synthetic/render/rays.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "plaza/core/error.h"

namespace plaza::synthetic {
namespace {

constexpr float kNear = 1e-3f;

// Embree takes rays in bunches of up to this many.
constexpr std::size_t kBunch = 64;

void fill(RTCRay& ray, const Vec3& origin, const Vec3& direction, float reach, float time) {
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = kNear;
  ray.tfar = reach;
  ray.time = time;
  ray.mask = ~0u;
  ray.id = 0;
  ray.flags = 0;
}

void miss(RTCHit& hit) {
  hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

std::optional<RayHit> hit_of(const RTCRayHit& traced) {
  if (traced.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  RayHit hit;
  hit.distance = traced.ray.tfar;
  hit.geometry = traced.hit.geomID;
  hit.triangle = traced.hit.primID;
  hit.u = traced.hit.u;
  hit.v = traced.hit.v;
  hit.normal = Vec3(traced.hit.Ng_x, traced.hit.Ng_y, traced.hit.Ng_z).normalized();
  return hit;
}

/// Copies into Embree's own buffers: it wants 16 readable bytes behind the last vertex.
void set_vertices(RTCGeometry geometry, unsigned step, const std::vector<Vec3>& vertices) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3,
                                         sizeof(Vec3), vertices.size());
  if (buffer == nullptr) throw InternalError("Embree has no memory for a mesh");
  std::memcpy(buffer, vertices.data(), vertices.size() * sizeof(Vec3));
}

void set_triangles(RTCGeometry geometry,
                   const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                         sizeof(triangles[0]), triangles.size());
  if (buffer == nullptr) throw InternalError("Embree has no memory for a mesh");
  std::memcpy(buffer, triangles.data(), triangles.size() * sizeof(triangles[0]));
}

/// Calls `use` with the index of a bunch's first query, its queries, and a context that tells
/// Embree of their coherence.
template <class Use>
void for_each_bunch(std::span<const RayQuery> queries, const Use& use) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t first = 0; first < queries.size(); first += kBunch) {
    use(first, queries.subspan(first, std::min(kBunch, queries.size() - first)), context);
  }
}

}  // namespace

// not "threads=1": Embree would hold all of oneTBB, and so the whole run, to one thread
RayDevice::RayDevice() : device_(rtcNewDevice(nullptr)) {
  if (device_ == nullptr) {
    throw InternalError("Embree does not start (error " +
                        std::to_string(static_cast<int>(rtcGetDeviceError(nullptr))) + ")");
  }
}
RayDevice::~RayDevice() { rtcReleaseDevice(device_); }

RayScene::RayScene(std::shared_ptr<const RayDevice> device, bool tight)
    : device_(std::move(device)), scene_(rtcNewScene(device_->get())) {
  if (tight) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
}
RayScene::~RayScene() { rtcReleaseScene(scene_); }

std::optional<RayHit> RayScene::trace(const Vec3& origin, const Vec3& direction, float reach,
                                      float time) const {
  RTCRayHit query;
  fill(query.ray, origin, direction, reach, time);
  miss(query.hit);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_, &context, &query);
  return hit_of(query);
}

bool RayScene::blocked(const Vec3& origin, const Vec3& direction, float reach, float time) const {
  RTCRay ray;
  fill(ray, origin, direction, reach - kNear, time);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_, &context, &ray);
  return ray.tfar < 0;
}

void RayScene::trace(std::span<const RayQuery> queries,
                     std::span<std::optional<RayHit>> hits) const {
  std::array<RTCRayHit, kBunch> rays;
  for_each_bunch(queries, [&](std::size_t first, auto bunch, RTCIntersectContext& context) {
    for (std::size_t i = 0; i < bunch.size(); ++i) {
      fill(rays[i].ray, bunch[i].origin, bunch[i].direction, bunch[i].reach, bunch[i].time);
      miss(rays[i].hit);
    }
    rtcIntersect1M(scene_, &context, rays.data(), static_cast<unsigned>(bunch.size()),
                   sizeof(RTCRayHit));
    for (std::size_t i = 0; i < bunch.size(); ++i) hits[first + i] = hit_of(rays[i]);
  });
}

void RayScene::blocked(std::span<const RayQuery> queries, std::span<std::uint8_t> blocked) const {
  std::array<RTCRay, kBunch> rays;
  for_each_bunch(queries, [&](std::size_t first, auto bunch, RTCIntersectContext& context) {
    for (std::size_t i = 0; i < bunch.size(); ++i) {
      fill(rays[i], bunch[i].origin, bunch[i].direction, bunch[i].reach - kNear, bunch[i].time);
    }
    rtcOccluded1M(scene_, &context, rays.data(), static_cast<unsigned>(bunch.size()),
                  sizeof(RTCRay));
    for (std::size_t i = 0; i < bunch.size(); ++i) blocked[first + i] = rays[i].tfar < 0 ? 1 : 0;
  });
}

StageScene::StageScene(std::shared_ptr<const RayDevice> device,
                       std::shared_ptr<const StageModel> model)
    : RayScene(std::move(device), true), model_(std::move(model)) {
  RTCGeometry geometry = rtcNewGeometry(this->device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  set_vertices(geometry, 0, model_->vertices);
  set_triangles(geometry, model_->triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene());
}

PeopleScene::PeopleScene(std::shared_ptr<const RayDevice> device, std::vector<MovingBody> bodies)
    : RayScene(std::move(device), false), bodies_(std::move(bodies)) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const MovingBody& body = bodies_[i];
    bounds_.push_back(bounds_of(body));
    RTCGeometry geometry = rtcNewGeometry(this->device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryTimeStepCount(geometry, 2);
    set_vertices(geometry, 0, body.open);
    set_vertices(geometry, 1, body.close);
    set_triangles(geometry, body.mesh->triangles());
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene(), geometry, static_cast<unsigned>(i));
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene());
}

}  // namespace plaza::synthetic
