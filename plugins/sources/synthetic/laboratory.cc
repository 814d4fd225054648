#include "plugins/sources/synthetic/laboratory.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "plaza/core/error.h"
#include "plaza/core/parallel.h"
#include "plugins/sources/synthetic/common/pixel_random.h"
#include "plugins/sources/synthetic/people/random.h"

namespace plaza::synthetic {

/// One camera's view of one setting.
struct Laboratory::Look {
  Look(const PixelRays& rays, const Setting& setting, const LaboratoryOptions& options,
       std::uint64_t seed)
      : view(rays, *setting.stage, *setting.lights, *setting.ambient, options.samples,
             static_cast<std::uint32_t>(seed)),
        renderer(view, *setting.stage, *setting.lights, *setting.ambient, options.render) {}

  StaticView view;
  ViewRenderer renderer;
};

struct Laboratory::Eye {
  Eye(const Camera& camera, const Laboratory& lab, std::uint64_t seed)
      : rays(camera, CalibrationError(camera, lab.options_.calibration_error_px, seed)),
        looks(look_at_all(rays, lab, seed)),
        sensor({camera.width(), camera.height()}, lab.options_.sensor,
               automatic_exposure(looks.front()->renderer.empty(plain_light(lab))), seed) {}

  static std::vector<std::unique_ptr<Look>> look_at_all(const PixelRays& rays,
                                                        const Laboratory& lab, std::uint64_t seed) {
    std::vector<std::unique_ptr<Look>> out;
    for (const Setting& setting : lab.settings_) {
      out.push_back(std::make_unique<Look>(rays, setting, lab.options_, seed));
    }
    return out;
  }
  /// What exposure is set by, once: whatever becomes of the light later, it stays.
  static LightGains plain_light(const Laboratory& lab) {
    LightGains gains;
    gains.direct.assign(lab.settings_.front().lights->count(), 1.0f);
    return gains;
  }

  PixelRays rays;
  std::vector<std::unique_ptr<Look>> looks;  // by setting
  Sensor sensor;
};

Stage stage_of(const std::string& scenario, const Scene& scene) {
  const Rectangle area{scene.area.min_m, scene.area.max_m};
  for (const ScenarioInfo& info : World::scenarios()) {
    if (info.name == scenario) return info.indoor ? indoor_stage(area) : outdoor_stage(area);
  }
  std::string names;
  for (const ScenarioInfo& info : World::scenarios())
    names += (names.empty() ? "" : ", ") + info.name;
  throw UserError("there is no scenario '" + scenario + "'; there are " + names);
}

namespace {

constexpr double kShadowAppearsS = 2;

}  // namespace

WorldOptions world_options(const LaboratoryOptions& options, const Scene& scene) {
  WorldOptions out;
  out.scenario = options.scenario;
  out.seed = options.seed;
  out.duration_s = options.duration_s;
  out.people = options.people;
  out.stage = stage_of(options.scenario, scene);
  if (options.moved_furniture_s) {
    if (!out.stage.walls) {
      throw UserError("scenario '" + options.scenario +
                      "' plays outdoors, where no furniture is that could be moved");
    }
    // nobody walks where something will stand, nor where something has stood
    for (const Furniture& thing : with_moved_furniture(out.stage).furniture) {
      out.stage.furniture.push_back(thing);
    }
  }
  return out;
}

void check_names(const LostCameras& lost, const Scene& scene) {
  std::string known;
  for (const Camera& camera : scene.cameras) {
    known += (known.empty() ? "'" : ", '") + camera.name() + "'";
  }
  for (const std::string& name : lost.names) {
    const auto is_it = [&](const Camera& camera) { return camera.name() == name; };
    if (std::ranges::any_of(scene.cameras, is_it)) continue;
    throw UserError("the scene has no camera '" + name + "' that could be lost; it has " + known);
  }
}

Laboratory::Laboratory(const LaboratoryOptions& options, std::shared_ptr<const Scene> scene)
    : options_(options), scene_(std::move(scene)), world_(world_options(options, *scene_)) {
  check_names(options_.lost, *scene_);
  meshes_.resize(world_.cast().size());
  parallel_for(meshes_.size(), [&](std::size_t i) {
    const CastMember& member = world_.cast()[i];
    LookSeeds seeds;
    seeds.person = member.looks_seed;
    seeds.clothing = member.clothing_key;
    seeds.dark = member.style == ClothingStyle::kDark;
    seeds.bag = member.bag;
    meshes_[i] = std::make_shared<BodyMesh>(member.proportions, make_look(seeds));
  });
  device_ = std::make_shared<const RayDevice>();
  const Stage stage = stage_of(options_.scenario, *scene_);
  add_setting(stage);
  if (options_.moved_furniture_s) add_setting(with_moved_furniture(stage));
  eyes_.resize(scene_->cameras.size());
  parallel_for(eyes_.size(), [&](std::size_t c) {
    eyes_[c] = std::make_unique<Eye>(scene_->cameras[c], *this, mix(options_.seed, 0xca3e + c));
  });
}

Laboratory::~Laboratory() = default;

void Laboratory::add_setting(const Stage& stage) {
  Setting& setting = settings_.emplace_back();
  setting.model = std::make_shared<const StageModel>(build_stage(stage, options_.seed));
  setting.stage = std::make_unique<StageScene>(device_, setting.model);
  setting.lights = std::make_unique<Lights>(setting.model);
  setting.ambient = std::make_unique<AmbientField>(*setting.stage, *setting.lights);
}

std::size_t Laboratory::setting(std::int64_t frame) const {
  return options_.moved_furniture_s && seconds(frame) >= *options_.moved_furniture_s ? 1 : 0;
}

const Laboratory::Look& Laboratory::look(std::size_t camera, std::int64_t frame) const {
  return *eyes_.at(camera)->looks[setting(frame)];
}

bool Laboratory::lost(std::size_t camera, std::int64_t frame) const {
  return seconds(frame) >= options_.lost.from_s &&
         std::ranges::count(options_.lost.names, scene_->cameras.at(camera).name()) > 0;
}

const StaticView& Laboratory::view(std::size_t camera, std::int64_t frame) const {
  return look(camera, frame).view;
}

double Laboratory::seconds(std::int64_t frame) const {
  return static_cast<double>(frame) / scene_->frame_rate_hz;
}

std::uint32_t Laboratory::key(std::int64_t frame, std::size_t camera) const {
  return static_cast<std::uint32_t>(
      mix(mix(options_.seed, static_cast<std::uint64_t>(frame)), camera));
}

LightGains Laboratory::gains(std::int64_t frame) const {
  // each light goes its own slow way: two waves of half a minute and of some seconds
  const double t = seconds(frame);
  Random draw(mix(options_.seed, 0xd21f7));
  const auto wave = [&] {
    const double slow = draw.uniform(20, 45), quick = draw.uniform(5, 11);
    const double a = draw.uniform(0, 1), b = draw.uniform(0, 1);
    const double sum = 0.75 * std::sin(2 * std::numbers::pi * (t / slow + a)) +
                       0.25 * std::sin(2 * std::numbers::pi * (t / quick + b));
    return static_cast<float>(1 + options_.illumination_drift * sum);
  };
  LightGains out;
  out.ambient = wave();
  const Lights& lights = *settings_.front().lights;
  const bool soft = lights.soft();
  for (std::size_t l = 0; l < lights.count(); ++l) {
    // indoors what is reflected follows the lamps; outdoors clouds dim the sun, not the sky
    out.direct.push_back(soft ? 0.5f * (out.ambient + wave()) : 2 * wave() - 1);
  }
  const LightChange& change = options_.light;
  if (change.factor != 1 && t > change.from_s) {
    const double done =
        t >= change.from_s + change.seconds ? 1 : (t - change.from_s) / change.seconds;
    const auto factor = static_cast<float>(std::pow(change.factor, done));
    out.ambient *= factor;
    for (float& light : out.direct) light *= factor;
  }
  out.shadow = shadow(t);
  return out;
}

BandShadow Laboratory::shadow(double seconds) const {
  BandShadow out;
  const MovingShadow& moving = options_.shadow;
  const double since = seconds - moving.from_s;
  if (moving.share <= 0 || since < 0) return out;
  Random draw(mix(options_.seed, 0x5ade));
  const double way = draw.uniform(-std::numbers::pi, std::numbers::pi);
  const double from = draw.uniform(-std::numbers::pi, std::numbers::pi);
  const auto& sun = settings_.front().model->sun;
  out.towards = sun ? sun->towards
                    : Vec3(static_cast<float>(0.7 * std::cos(from)),
                           static_cast<float>(0.7 * std::sin(from)), 1.0f);
  out.share = static_cast<float>(moving.share * std::min(1.0, since / kShadowAppearsS));
  out.across = {static_cast<float>(std::cos(way)), static_cast<float>(std::sin(way))};
  const Rectangle area = world_.stage().area;
  out.origin = area.center().cast<float>();
  // it begins a quarter of its way before the middle
  const double length = area.size().norm() + moving.width_m;
  const double gone = std::fmod(0.25 * length + moving.speed_mps * since, length);
  out.middle_m = static_cast<float>(gone - 0.5 * length);
  out.half_width_m = static_cast<float>(0.5 * moving.width_m);
  out.edge_m = static_cast<float>(moving.edge_m);
  return out;
}

std::vector<MovingBody> Laboratory::bodies(std::int64_t frame) const {
  const double t = seconds(frame);
  const std::vector<PersonState> now = world_.at(t);
  const std::vector<PersonState> open = world_.at(t - 0.5 * options_.shutter_s);
  const std::vector<PersonState> close = world_.at(t + 0.5 * options_.shutter_s);
  const auto of = [](const std::vector<PersonState>& states,
                     const PersonState& person) -> const PersonState& {
    for (const PersonState& state : states) {
      if (state.person == person.person) return state;
    }
    return person;  // appears or vanishes within the exposure
  };
  std::vector<MovingBody> out;
  for (const PersonState& person : now) {
    MovingBody& body = out.emplace_back();
    body.person = person.person;
    body.mesh = meshes_[person.person];
    body.heading = {static_cast<float>(std::cos(person.heading_rad)),
                    static_cast<float>(std::sin(person.heading_rad))};
    for (auto* vertices : {&body.open, &body.close, &body.normals}) {
      vertices->resize(body.mesh->vertex_count());
    }
    body.mesh->place(of(open, person).pose, body.open);
    body.mesh->place(of(close, person).pose, body.close);
    body.mesh->turn(person.pose, body.normals);
  }
  return out;
}

cv::Mat Laboratory::radiance(std::int64_t frame, std::size_t camera) const {
  const PeopleScene people(device_, bodies(frame));
  return look(camera, frame).renderer.render(people, gains(frame), key(frame, camera));
}

std::vector<cv::Mat> Laboratory::images(std::int64_t frame) const {
  const PeopleScene people(device_, bodies(frame));
  const LightGains light = gains(frame);
  std::vector<cv::Mat> out(eyes_.size());
  parallel_for(eyes_.size(), [&](std::size_t c) {
    if (lost(c, frame)) return;
    cv::Mat radiance = look(c, frame).renderer.render(people, light, key(frame, c));
    out[c] = eyes_[c]->sensor.develop(radiance, key(frame, c));
  });
  return out;
}

std::vector<cv::Mat> Laboratory::empty_images(std::int64_t frame) const {
  const LightGains light = gains(frame);
  std::vector<cv::Mat> out(eyes_.size());
  parallel_for(eyes_.size(), [&](std::size_t c) {
    cv::Mat radiance = look(c, frame).renderer.empty(light);
    out[c] = eyes_[c]->sensor.develop(radiance, key(frame, c));
  });
  return out;
}

std::vector<TruePerson> Laboratory::people(std::int64_t frame) const {
  const double t = seconds(frame);
  const std::vector<PersonState> states = world_.at(t);
  const std::vector<MovingBody> moving = bodies(frame);
  std::vector<std::vector<BodyView>> seen(eyes_.size());
  parallel_for(eyes_.size(), [&](std::size_t c) { seen[c] = body_views(moving, view(c, frame)); });
  std::vector<TruePerson> out;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto identity = world_.identity(states[i].person, t);
    if (!identity) continue;  // beyond the observed area: drawn, but nobody's to find
    TruePerson& person = out.emplace_back();
    person.id = static_cast<std::int64_t>(*identity) + 1;  // files count from 1
    person.position_m = states[i].position_m;
    person.heading_rad = states[i].heading_rad;
    for (std::size_t c = 0; c < seen.size(); ++c) {
      for (const BodyView& view : seen[c]) {
        if (view.body == i) person.views.push_back({c, view.box, view.visibility});
      }
    }
  }
  return out;
}

}  // namespace plaza::synthetic
