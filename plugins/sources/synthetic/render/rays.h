#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plugins/sources/synthetic/body/body_mesh.h"
#include "plugins/sources/synthetic/render/body_bounds.h"
#include "plugins/sources/synthetic/stage/stage_model.h"

namespace plaza::synthetic {

/// Embree's device. Scenes are built by the calling thread alone, so that a tree does not depend on
/// how many threads there are.
class RayDevice {
 public:
  RayDevice();
  ~RayDevice();
  RayDevice(const RayDevice&) = delete;
  RayDevice& operator=(const RayDevice&) = delete;
  RTCDevice get() const { return device_; }

 private:
  RTCDevice device_;
};

/// Where a ray met a triangle.
struct RayHit {
  float distance = 0;  ///< along the ray, whose direction has unit length: metres
  std::uint32_t geometry = 0;
  std::uint32_t triangle = 0;
  float u = 0, v = 0;
  Vec3 normal = Vec3::Zero();  ///< of the triangle, unit length, either side
};

/// A ray to be shot.
struct RayQuery {
  Vec3 origin, direction;  ///< direction: unit length
  float reach = 0;         ///< metres
  float time = 0;          ///< in [0, 1], the moment within the exposure
};

/// Triangles that rays are shot at. Any number of threads may shoot at once.
class RayScene {
 public:
  /// `tight`: no ray slips through between two triangles, for a tenth more time.
  RayScene(std::shared_ptr<const RayDevice> device, bool tight);
  virtual ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// First hit before `reach` metres; `time` in [0, 1] is the moment within the exposure.
  std::optional<RayHit> trace(const Vec3& origin, const Vec3& direction, float reach,
                              float time = 0) const;
  /// Whether anything is in the way within (1 mm, reach).
  bool blocked(const Vec3& origin, const Vec3& direction, float reach, float time = 0) const;
  /// The same for rays that go much the same way, several at once. Results may depend in their last
  /// bits on which rays are asked for together. `hits`, `blocked`: one for each query.
  void trace(std::span<const RayQuery> queries, std::span<std::optional<RayHit>> hits) const;
  void blocked(std::span<const RayQuery> queries, std::span<std::uint8_t> blocked) const;

 protected:
  RTCScene scene() const { return scene_; }
  RTCDevice device() const { return device_->get(); }

 private:
  std::shared_ptr<const RayDevice> device_;
  RTCScene scene_;
};

/// What stands still.
class StageScene final : public RayScene {
 public:
  StageScene(std::shared_ptr<const RayDevice> device, std::shared_ptr<const StageModel> model);
  const StageModel& model() const { return *model_; }

 private:
  std::shared_ptr<const StageModel> model_;
};

/// A person in one exposure: positions of its mesh when the shutter opens and closes, normals in
/// the middle of the exposure.
struct MovingBody {
  std::size_t person = 0;
  std::shared_ptr<const BodyMesh> mesh;
  Eigen::Vector2f heading{1, 0};  ///< unit
  std::vector<Vec3> open, close;
  std::vector<Vec3> normals;
};

/// All people in one exposure, blurred by their motion.
class PeopleScene final : public RayScene {
 public:
  PeopleScene(std::shared_ptr<const RayDevice> device, std::vector<MovingBody> bodies);
  /// By RayHit::geometry.
  const std::vector<MovingBody>& bodies() const { return bodies_; }
  const std::vector<BodyBounds>& bounds() const { return bounds_; }

 private:
  std::vector<MovingBody> bodies_;
  std::vector<BodyBounds> bounds_;
};

}  // namespace plaza::synthetic
