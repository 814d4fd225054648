#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plaza/data/frames.h"
#include "plaza/data/ground_truth.h"
#include "plaza/geometry/scene.h"
#include "plugins/sources/synthetic/render/body_views.h"
#include "plugins/sources/synthetic/render/view_renderer.h"
#include "plugins/sources/synthetic/sensor/sensor.h"
#include "plugins/sources/synthetic/world/world.h"

namespace plaza::synthetic {

/// All light becomes `factor` times what it was, evenly in its logarithm.
struct LightChange {
  double factor = 1;
  double from_s = 1;    ///< after the clip's first frame
  double seconds = 10;  ///< that it takes; 0: at once
};

/// See BandShadow. It crosses the area at a constant speed and comes again from the other side;
/// which way is the seed's to decide.
struct MovingShadow {
  double share = 0;   ///< of the direct light that it takes; 0: there is none
  double from_s = 0;  ///< when it appears, within two seconds
  double speed_mps = 0.15;
  double width_m = 1.2;
  double edge_m = 0.2;
};

/// Cameras that stop giving images: a cable is pulled, a machine goes down.
struct LostCameras {
  std::vector<std::string> names;  ///< of cameras of the scene
  double from_s = 0;               ///< after the clip's first frame; before it they give all images
};

struct LaboratoryOptions {
  std::string scenario = "four-crossing";
  std::uint64_t seed = 1;
  double duration_s = 20;
  std::optional<int> people;
  int samples = 4;
  double shutter_s = 0.012;
  double calibration_error_px = 1.0;
  double illumination_drift = 0.06;
  LightChange light;
  MovingShadow shadow;
  std::optional<double> moved_furniture_s;  ///< when furniture is shoved about; unset: never
  LostCameras lost;
  RenderOptions render;
  SensorOptions sensor;
};

/// A world of people, the place they are in, and the cameras that see it. Rendering of a moment is
/// a pure function of the options and that moment.
class Laboratory {
 public:
  /// Builds people and place and traces what stands still. Throws UserError as World does, and
  /// where a camera that shall be lost isn't one of the scene's.
  Laboratory(const LaboratoryOptions& options, std::shared_ptr<const Scene> scene);
  ~Laboratory();

  const World& world() const { return world_; }
  /// 8-bit BGR images of all cameras, people included, empty where the camera is lost; `frame` may
  /// be negative: before the clip.
  std::vector<cv::Mat> images(std::int64_t frame) const;
  /// The same without anybody.
  std::vector<cv::Mat> empty_images(std::int64_t frame) const;
  std::vector<TruePerson> people(std::int64_t frame) const;
  /// The bodies in the exposure of a frame, in the order of World::at().
  std::vector<MovingBody> bodies(std::int64_t frame) const;
  /// Without lens and sensor: linear radiance of one camera (CV_32FC3).
  cv::Mat radiance(std::int64_t frame, std::size_t camera) const;
  /// The place as that frame has it.
  const StaticView& view(std::size_t camera, std::int64_t frame = 0) const;

 private:
  struct Eye;
  struct Look;
  /// The place while no furniture moves.
  struct Setting {
    std::shared_ptr<const StageModel> model;
    std::unique_ptr<StageScene> stage;
    std::unique_ptr<Lights> lights;
    std::unique_ptr<AmbientField> ambient;
  };
  double seconds(std::int64_t frame) const;
  std::size_t setting(std::int64_t frame) const;
  const Look& look(std::size_t camera, std::int64_t frame) const;
  void add_setting(const Stage& stage);
  bool lost(std::size_t camera, std::int64_t frame) const;
  BandShadow shadow(double seconds) const;
  LightGains gains(std::int64_t frame) const;
  std::uint32_t key(std::int64_t frame, std::size_t camera) const;

  LaboratoryOptions options_;
  std::shared_ptr<const Scene> scene_;
  World world_;
  std::vector<std::shared_ptr<const BodyMesh>> meshes_;  // by cast member
  std::shared_ptr<const RayDevice> device_;
  std::vector<Setting> settings_;           // before furniture is moved, and after
  std::vector<std::unique_ptr<Eye>> eyes_;  // by camera
};

/// The stage that a scenario plays on in a scene; throws UserError for an unknown scenario.
Stage stage_of(const std::string& scenario, const Scene& scene);

/// Throws UserError when the scene has no camera of one of these names.
void check_names(const LostCameras& lost, const Scene& scene);

/// What people are told of these options. Throws UserError for an unknown scenario, and where there
/// is no furniture to be moved.
WorldOptions world_options(const LaboratoryOptions& options, const Scene& scene);

}  // namespace plaza::synthetic
