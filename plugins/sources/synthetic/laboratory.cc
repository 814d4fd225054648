#include "plugins/sources/synthetic/laboratory.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "plaza/core/error.h"
#include "plaza/core/parallel.h"
#include "plugins/sources/synthetic/common/pixel_random.h"
#include "plugins/sources/synthetic/people/random.h"

namespace plaza::synthetic {

struct Laboratory::Eye {
  Eye(const Camera& camera, const Laboratory& lab, std::uint64_t seed)
      : rays(camera, CalibrationError(camera, lab.options_.calibration_error_px, seed)),
        view(rays, *lab.stage_, *lab.lights_, *lab.ambient_, lab.options_.samples,
             static_cast<std::uint32_t>(seed)),
        renderer(view, *lab.stage_, *lab.lights_, *lab.ambient_, lab.options_.render),
        sensor({camera.width(), camera.height()}, lab.options_.sensor,
               automatic_exposure(renderer.empty({std::vector<float>(view.lights, 1.0f), 1.0f})),
               seed) {}

  PixelRays rays;
  StaticView view;
  ViewRenderer renderer;
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

WorldOptions world_options(const LaboratoryOptions& options, const Scene& scene) {
  WorldOptions out;
  out.scenario = options.scenario;
  out.seed = options.seed;
  out.duration_s = options.duration_s;
  out.people = options.people;
  out.stage = stage_of(options.scenario, scene);
  return out;
}

}  // namespace

Laboratory::Laboratory(const LaboratoryOptions& options, std::shared_ptr<const Scene> scene)
    : options_(options), scene_(std::move(scene)), world_(world_options(options, *scene_)) {
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
  model_ = std::make_shared<const StageModel>(build_stage(world_.stage(), options_.seed));
  device_ = std::make_shared<const RayDevice>();
  stage_ = std::make_unique<StageScene>(device_, model_);
  lights_ = std::make_unique<Lights>(model_);
  ambient_ = std::make_unique<AmbientField>(*stage_, *lights_);
  eyes_.resize(scene_->cameras.size());
  parallel_for(eyes_.size(), [&](std::size_t c) {
    eyes_[c] = std::make_unique<Eye>(scene_->cameras[c], *this, mix(options_.seed, 0xca3e + c));
  });
}

Laboratory::~Laboratory() = default;

const StaticView& Laboratory::view(std::size_t camera) const { return eyes_.at(camera)->view; }

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
  const bool soft = lights_->soft();
  for (std::size_t l = 0; l < lights_->count(); ++l) {
    // indoors what is reflected follows the lamps; outdoors clouds dim the sun, not the sky
    out.direct.push_back(soft ? 0.5f * (out.ambient + wave()) : 2 * wave() - 1);
  }
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
  return eyes_.at(camera)->renderer.render(people, gains(frame), key(frame, camera));
}

std::vector<cv::Mat> Laboratory::images(std::int64_t frame) const {
  const PeopleScene people(device_, bodies(frame));
  const LightGains light = gains(frame);
  std::vector<cv::Mat> out(eyes_.size());
  parallel_for(eyes_.size(), [&](std::size_t c) {
    cv::Mat radiance = eyes_[c]->renderer.render(people, light, key(frame, c));
    out[c] = eyes_[c]->sensor.develop(radiance, key(frame, c));
  });
  return out;
}

std::vector<cv::Mat> Laboratory::empty_images(std::int64_t frame) const {
  const LightGains light = gains(frame);
  std::vector<cv::Mat> out(eyes_.size());
  parallel_for(eyes_.size(), [&](std::size_t c) {
    cv::Mat radiance = eyes_[c]->renderer.empty(light);
    out[c] = eyes_[c]->sensor.develop(radiance, key(frame, c));
  });
  return out;
}

std::vector<TruePerson> Laboratory::people(std::int64_t frame) const {
  const double t = seconds(frame);
  const std::vector<PersonState> states = world_.at(t);
  const std::vector<MovingBody> moving = bodies(frame);
  std::vector<std::vector<BodyView>> seen(eyes_.size());
  parallel_for(eyes_.size(), [&](std::size_t c) { seen[c] = body_views(moving, eyes_[c]->view); });
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
