#include "plugins/sources/synthetic/synthetic_source.h"

#include <cmath>
#include <utility>

#include "plaza/core/error.h"

namespace plaza::synthetic {
namespace {

constexpr double kBackgroundMinute = 60;  // seconds

}  // namespace

Declaration<SyntheticSource::Options> SyntheticSource::declare() {
  Parameters<Options> p;
  p.value("scenario", &Options::scenario)
      .meaning(
          "what people do: two-targets, three-boxmotion, three-targets, four-interaction, "
          "four-crossing, six-targets, twins, crowd, standing (in a room), campus, terrace (in the "
          "open)")
      .source("thesis Table 3.1");
  p.value("seed", &Options::seed)
      .at_least(0)
      .meaning("decides everything that is drawn by chance: people, ways, place, light, noise");
  p.value("frames", &Options::frames).at_least(1).meaning("length of the clip");
  p.value("backgrounds", &Options::backgrounds)
      .at_least(0)
      .meaning(
          "images of the place without people, taken in the minute before the clip, for those who "
          "learn from people-free frames")
      .source("thesis 4.3.2");
  p.value("people", &Options::people)
      .at_least(2)
      .at_most(10)
      .meaning("how many people at most, where a scenario leaves it open; unset: its own number");
  p.value("samples", &Options::samples)
      .at_least(1)
      .at_most(64)
      .meaning("rays per pixel where people are, each at its own place and moment");
  p.value("shadows", &Options::shadows)
      .meaning("whether people keep light from the place, from each other and from themselves");
  p.value("reflections", &Options::reflections)
      .meaning("whether people are mirrored in a glossy floor");
  p.value("shutter_ms", &Options::shutter_ms)
      .unit("ms")
      .at_least(0)
      .at_most(100)
      .meaning("how long the shutter is open, half before and half after the frame's time");
  p.value("calibration_error_px", &Options::calibration_error_px)
      .unit("px")
      .at_least(0)
      .at_most(20)
      .meaning(
          "root mean square distance over the image between where the scene's calibration says a "
          "point is and where it is");
  p.value("illumination_drift", &Options::illumination_drift)
      .at_least(0)
      .at_most(0.5)
      .meaning("by which share lamps and sun slowly change, within half a minute");
  p.value("light", &Options::light)
      .at_least(0.05)
      .at_most(20)
      .meaning(
          "what all light becomes in the clip, as a multiple of what it was; the cameras' exposure "
          "stays, and what is too bright for them is white");
  p.value("light_from_s", &Options::light_from_s)
      .unit("s")
      .at_least(0)
      .meaning("when it begins to, after the first frame");
  p.value("light_seconds", &Options::light_seconds)
      .unit("s")
      .at_least(0)
      .meaning("how long that takes; 0: a switch");
  p.value("shadow", &Options::shadow)
      .at_least(0)
      .at_most(1)
      .meaning(
          "share of the direct light that is taken by a band-shaped shadow, which moves slowly "
          "over "
          "the ground and whatever stands there, as that of a tree before a window; it isn't in "
          "people-free images");
  p.value("shadow_from_s", &Options::shadow_from_s)
      .unit("s")
      .at_least(0)
      .meaning("when it appears, within two seconds");
  p.value("shadow_mps", &Options::shadow_mps)
      .unit("m/s")
      .at_least(0)
      .at_most(5)
      .meaning("how fast it moves, across itself; when it has left the area, it comes again");
  p.value("shadow_width_m", &Options::shadow_width_m)
      .unit("m")
      .above(0)
      .at_most(50)
      .meaning("how wide it is, from half to half");
  p.value("shadow_edge_m", &Options::shadow_edge_m)
      .unit("m")
      .above(0)
      .at_most(10)
      .meaning("over which distance it fades at its edges");
  p.value("moved_furniture_s", &Options::moved_furniture_s)
      .unit("s")
      .at_least(0)
      .meaning(
          "when a table and a plant of the room are shoved some way into the area, all at once; "
          "people keep off both places all the time; unset: never");
  p.value("lost_cameras", &Options::lost_cameras)
      .meaning(
          "cameras that stop giving images within the clip; their view is then empty, and the "
          "truth goes on telling what they would have seen");
  p.value("lost_from_s", &Options::lost_from_s)
      .unit("s")
      .at_least(0)
      .meaning("when they stop, after the first frame; 0: the clip has no image of them");
  p.value("blur_px", &Options::blur_px)
      .unit("px")
      .at_least(0)
      .at_most(10)
      .meaning("sigma of the lens's blur");
  p.value("vignetting", &Options::vignetting)
      .at_least(0)
      .at_most(0.9)
      .meaning("share of the light that is lost in the image's corners");
  p.value("noise", &Options::noise)
      .at_least(0)
      .at_most(20)
      .meaning(
          "factor on the sensor's shot and read noise (9000 electrons full well, 22 read noise)");
  p.value("colour_spread", &Options::colour_spread)
      .at_least(0)
      .at_most(5)
      .meaning("factor on how far cameras differ in colour (4.5 %) and exposure (7 %)");
  p.value("bayer", &Options::bayer)
      .meaning("one colour per pixel and the others interpolated, as in most cameras");
  return Declaration<Options>("synthetic",
                              "Renders people in a room or in the open, with known truth.")
      .source("thesis 3.2, Table 3.1")
      .output<FrameSet>("images of all cameras but those that are lost")
      .output<GroundTruth>(
          "who is where in the scene's area: identity, position, heading, and in each view the "
          "box of the whole body and its visible share")
      .parameters(std::move(p));
}

SyntheticSource::SyntheticSource(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene) {}

SyntheticSource::~SyntheticSource() = default;

LaboratoryOptions SyntheticSource::laboratory_options() const {
  LaboratoryOptions out;
  out.scenario = options_.scenario;
  out.seed = static_cast<std::uint64_t>(options_.seed);
  out.duration_s = static_cast<double>(options_.frames) / scene_->frame_rate_hz;
  out.people = options_.people;
  out.samples = options_.samples;
  out.shutter_s = options_.shutter_ms * 1e-3;
  out.calibration_error_px = options_.calibration_error_px;
  out.illumination_drift = options_.illumination_drift;
  out.light = {
      .factor = options_.light, .from_s = options_.light_from_s, .seconds = options_.light_seconds};
  out.shadow = {.share = options_.shadow,
                .from_s = options_.shadow_from_s,
                .speed_mps = options_.shadow_mps,
                .width_m = options_.shadow_width_m,
                .edge_m = options_.shadow_edge_m};
  out.moved_furniture_s = options_.moved_furniture_s;
  out.lost = {.names = options_.lost_cameras, .from_s = options_.lost_from_s};
  out.render.shadows = options_.shadows;
  out.render.reflections = options_.reflections;
  out.sensor.blur_px = options_.blur_px;
  out.sensor.vignetting = options_.vignetting;
  out.sensor.noise = options_.noise;
  out.sensor.colour_spread = options_.colour_spread;
  out.sensor.bayer = options_.bayer;
  return out;
}

const Laboratory& SyntheticSource::laboratory() {
  if (!laboratory_) laboratory_ = std::make_unique<Laboratory>(laboratory_options(), scene_);
  return *laboratory_;
}

Diagnostics SyntheticSource::do_check() const {
  Diagnostics faults;
  const auto note = [&](const std::string& pointer, const auto& check) {
    try {
      check();
    } catch (const UserError& error) {
      Diagnostic& fault = faults.emplace_back();
      fault.pointer = pointer;
      fault.message = error.what();
    }
  };
  const LaboratoryOptions checked = laboratory_options();
  note("/scenario", [&] { World world(world_options(checked, *scene_)); });
  note("/lost_cameras", [&] { check_names(checked.lost, *scene_); });
  return faults;
}

SourceInfo SyntheticSource::do_open() {
  return {.frame_count = options_.frames,
          .rereadable = true,
          .background_count = role() == SourceRole::kClock ? options_.backgrounds : 0};
}

std::shared_ptr<const FrameSet> SyntheticSource::do_background(std::int64_t index) {
  auto frames = std::make_shared<FrameSet>();
  frames->frame = index;
  frames->time_ns = scene_->time_of_frame(index);
  // evenly over a minute that ends one second before the clip
  const double step_s = kBackgroundMinute / static_cast<double>(options_.backgrounds);
  const double before_s = 1 + step_s * static_cast<double>(options_.backgrounds - index);
  frames->views = laboratory().empty_images(-std::llround(before_s * scene_->frame_rate_hz));
  return frames;
}

void SyntheticSource::do_seek(std::int64_t frame) {
  if (role() == SourceRole::kFollower || frame < options_.frames) return;
  throw UserError("frame " + std::to_string(frame + 1) + " is beyond the end: the clip has " +
                  std::to_string(options_.frames) + " frames (\"frames\")");
}

bool SyntheticSource::do_read(NodeIo& io) {
  const bool clock = role() == SourceRole::kClock;
  if (clock && io.frame() >= options_.frames) return false;
  auto truth = std::make_shared<GroundTruth>();
  truth->annotated = io.frame() < options_.frames;
  if (truth->annotated) truth->people = laboratory().people(io.frame());
  if (clock) {
    auto frames = std::make_shared<FrameSet>();
    frames->frame = io.frame();
    frames->time_ns = io.time_ns();
    frames->views = laboratory().images(io.frame());
    io.out(0, std::move(frames));
  }
  io.out(1, std::move(truth));
  return true;
}

}  // namespace plaza::synthetic
