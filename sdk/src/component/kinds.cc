// The checks around every kind's virtual functions: a plugin that breaks an invariant is named at
// once, not where its result makes trouble later.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/core/parallel.h"

namespace plaza {
namespace {

std::string at(const char* what, std::size_t index) {
  return std::string(what) + " " + std::to_string(index) + ": ";
}

void check_observation(const Observation& o, std::size_t index) {
  if (!o.position_m.allFinite())
    throw InternalError(at("observation", index) + "position is not finite");
  const Eigen::Matrix2d& c = o.covariance_m2;
  const bool positive_definite = c.allFinite() && c(0, 0) > 0 && c.determinant() > 0 &&
                                 std::abs(c(0, 1) - c(1, 0)) <= 1e-9 * c.cwiseAbs().maxCoeff();
  if (!positive_definite) {
    throw InternalError(at("observation", index) + "covariance is not symmetric positive definite");
  }
  if (!(o.probability >= 0 && o.probability <= 1)) {
    throw InternalError(at("observation", index) + "probability is not in [0, 1]");
  }
  if (!std::isfinite(o.score))
    throw InternalError(at("observation", index) + "score is not finite");
  if (o.heading_rad && !std::isfinite(*o.heading_rad)) {
    throw InternalError(at("observation", index) + "heading is not finite");
  }
  for (std::size_t i = 1; i < o.boxes.size(); ++i) {
    if (o.boxes[i - 1].camera >= o.boxes[i].camera) {
      throw InternalError(at("observation", index) + "boxes are not by rising camera");
    }
  }
}

void check_likelihood(const GroundLikelihood& likelihood) {
  const GroundGrid& grid = likelihood.grid;
  const auto cells = static_cast<std::size_t>(std::max(grid.columns, 0)) *
                     static_cast<std::size_t>(std::max(grid.rows, 0));
  bool fits = likelihood.joint.size() == cells;
  for (const std::vector<double>& view : likelihood.views) fits = fits && view.size() == cells;
  if (!fits) throw InternalError("a ground likelihood needs one value per cell of its grid");
  const auto bounded = [](const std::vector<double>& values) {
    return std::none_of(values.begin(), values.end(), [](double v) { return std::isinf(v); });
  };
  if (!bounded(likelihood.joint) ||
      !std::all_of(likelihood.views.begin(), likelihood.views.end(), bounded)) {
    throw InternalError("a ground likelihood is infinite; NaN says that it is unknown");
  }
}

}  // namespace

Source::~Source() = default;
SourceInfo Source::open(SourceRole role) {
  role_ = role;
  SourceInfo info = do_open();
  if (info.background_count < 0) throw InternalError("announces a negative number of backgrounds");
  background_count_ = info.background_count;
  open_ = true;
  next_ = 0;
  return info;
}
void Source::seek(std::int64_t frame) {
  if (!open_) throw InternalError("seek before open");
  if (frame < 0) throw std::invalid_argument("seek to a negative frame");
  if (frame == next_) return;
  do_seek(frame);
  next_ = frame;
}
bool Source::read(NodeIo& io) {
  if (!open_) throw InternalError("read before open");
  if (io.frame() != next_) throw InternalError("frames must be read in order; seek first");
  if (!do_read(io)) return false;
  ++next_;
  return true;
}
bool Source::do_people_free(std::int64_t /*frame*/) const { return false; }
std::shared_ptr<const FrameSet> Source::background(std::int64_t index) {
  if (!open_) throw InternalError("background before open");
  if (index < 0 || index >= background_count_) {
    throw std::out_of_range("background " + std::to_string(index) + " of " +
                            std::to_string(background_count_));
  }
  auto frames = do_background(index);
  if (!frames) throw InternalError("announced a background that it does not give");
  return frames;
}
std::shared_ptr<const FrameSet> Source::do_background(std::int64_t /*index*/) { return nullptr; }
std::string Source::do_content_key() const { return {}; }
std::vector<std::string> Source::do_notes() const { return {}; }
void Source::do_process(NodeIo& /*io*/) { throw InternalError("sources are read, not processed"); }

ShapeModel::~ShapeModel() = default;
Silhouette ShapeModel::silhouette(const Pose& pose, const Camera& camera) const {
  if (!pose.position_m.allFinite() || !std::isfinite(pose.heading_rad) || !(pose.scale > 0)) {
    throw std::invalid_argument("pose must be finite and its scale positive");
  }
  return do_silhouette(pose, camera);
}

AppearanceModel::~AppearanceModel() = default;
std::vector<SurfacePoint> AppearanceModel::visible_points(const Pose& pose,
                                                          const Camera& camera) const {
  return do_visible_points(pose, camera);
}

MotionModel::~MotionModel() = default;
MotionState MotionModel::start(const Eigen::Vector2d& position_m,
                               const Eigen::Matrix2d& covariance_m2) const {
  return do_start(position_m, covariance_m2);
}
MotionState MotionModel::predict(const MotionState& state, double dt_s) const {
  if (!(dt_s >= 0)) throw std::invalid_argument("a motion model predicts forward in time");
  return do_predict(state, dt_s);
}
MotionState MotionModel::correct(const MotionState& state, const Eigen::Vector2d& position_m,
                                 const Eigen::Matrix2d& covariance_m2) const {
  return do_correct(state, position_m, covariance_m2);
}
Eigen::Vector2d MotionModel::position(const MotionState& state) const { return do_position(state); }
Eigen::Vector2d MotionModel::velocity(const MotionState& state) const { return do_velocity(state); }
Eigen::Matrix2d MotionModel::position_covariance(const MotionState& state) const {
  return do_position_covariance(state);
}

TemplateBatch::~TemplateBatch() = default;
Modality::~Modality() = default;
Modality::Memory::~Memory() = default;
Modality::Prepared Modality::prepare(const cv::Mat& image, std::size_t camera,
                                     const Past& past) const {
  const Camera& c = scene_->cameras.at(camera);
  if (image.cols != c.width() || image.rows != c.height() || image.type() != CV_8UC3) {
    throw UserError("image is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) +
                    ", the calibration of camera '" + c.name() + "' is for " +
                    std::to_string(c.width()) + "x" + std::to_string(c.height()) + " BGR");
  }
  const cv::Mat& before = past.foreground;
  if (!before.empty() && (before.size() != image.size() || before.type() != CV_8UC1)) {
    throw std::invalid_argument("the previous foreground is no 8-bit mask of the image's size");
  }
  Prepared prepared = do_prepare(image, camera, past);
  if (!prepared.evidence) throw InternalError("prepare() returned no evidence");
  return prepared;
}
std::unique_ptr<TemplateBatch> Modality::sample(const ShapeModel& model,
                                                std::span<const Pose> poses,
                                                std::size_t camera) const {
  if (camera >= scene_->cameras.size()) throw std::out_of_range("camera index");
  auto batch = do_sample(model, poses, camera);
  if (!batch || batch->size() != poses.size()) {
    throw InternalError("sample() must return one template per pose");
  }
  return batch;
}
void Modality::match(const Evidence& evidence, const TemplateBatch& templates,
                     std::span<double> log_likelihood) const {
  if (log_likelihood.size() != templates.size()) {
    throw std::invalid_argument("match() needs room for one likelihood per template");
  }
  std::vector<std::uint32_t> all(templates.size());
  std::iota(all.begin(), all.end(), 0U);
  do_match(evidence, templates, all, log_likelihood);
}
void Modality::match(const Evidence& evidence, const TemplateBatch& templates,
                     std::span<const std::uint32_t> which, std::span<double> log_likelihood) const {
  if (log_likelihood.size() != which.size()) {
    throw std::invalid_argument("match() needs room for one likelihood per template");
  }
  for (const std::uint32_t index : which) {
    if (index >= templates.size()) throw std::out_of_range("template index");
  }
  do_match(evidence, templates, which, log_likelihood);
}
EvidencePtr Modality::explain(const EvidencePtr& evidence, const TemplateBatch& templates,
                              std::span<const std::uint32_t> which) const {
  for (const std::uint32_t index : which) {
    if (index >= templates.size()) throw std::out_of_range("template index");
  }
  if (which.empty()) return evidence;
  EvidencePtr rest = do_explain(evidence, templates, which);
  if (!rest) throw InternalError("explain() returned no evidence");
  return rest;
}
void Modality::do_process(NodeIo& io) {
  const FrameSet& frames = io.in<FrameSet>(0);
  auto evidence = std::make_shared<EvidenceSet>();
  auto masks = std::make_shared<ForegroundMask>();
  evidence->views.resize(frames.views.size());
  masks->views.resize(frames.views.size());
  // after a jump in time what was before says nothing of this frame
  const bool recent =
      in_order_ && last_frame_ == io.frame() - 1 && past_.size() == frames.views.size();
  std::vector<Past> left(frames.views.size());
  parallel_for(frames.views.size(), [&](std::size_t camera) {
    if (frames.views[camera].empty()) {
      if (recent) left[camera].memory = past_[camera].memory;
      return;
    }
    try {
      Prepared prepared = prepare(frames.views[camera], camera, recent ? past_[camera] : Past());
      left[camera] = {prepared.foreground, std::move(prepared.memory)};
      evidence->views[camera] = std::move(prepared.evidence);
      masks->views[camera] = std::move(prepared.foreground);
    } catch (Error& error) {
      error.add_context({.component = {}, .frame = {}, .camera = scene_->cameras[camera].name()});
      throw;
    }
  });
  if (in_order_) {  // else other threads are here at the same time
    past_ = std::move(left);
    last_frame_ = io.frame();
  }
  io.out(0, std::move(evidence));
  if (io.output_count() > 1) io.out(1, std::move(masks));
}

Detector::~Detector() = default;
Observations Detector::detect(const NodeIo& io) const { return detect_all(io).observations; }
Detector::Detected Detector::detect_all(const NodeIo& io) const {
  Detected found = do_detect_all(io);
  for (std::size_t i = 0; i < found.observations.items.size(); ++i)
    check_observation(found.observations.items[i], i);
  if (found.likelihood) check_likelihood(*found.likelihood);
  return found;
}
Detector::Detected Detector::do_detect_all(const NodeIo& io) const { return {do_detect(io), {}}; }
void Detector::do_process(NodeIo& io) {
  Detected found = detect_all(io);
  io.out(0, std::make_shared<Observations>(std::move(found.observations)));
  if (io.output_count() > 1) {
    if (!found.likelihood) throw InternalError("the declared GroundLikelihood was not computed");
    io.out(1, std::move(found.likelihood));
  }
}

Describer::~Describer() = default;
Observations Describer::describe(const NodeIo& io) {
  const Observations& before = io.in<Observations>(0);
  Observations after = before;
  do_describe(io, after);
  if (after.items.size() != before.items.size()) {
    throw InternalError("a describer must not add or drop observations");
  }
  for (std::size_t i = 0; i < after.items.size(); ++i) {
    if (after.items[i].position_m != before.items[i].position_m) {
      throw InternalError(at("observation", i) +
                          "a describer must not move or reorder observations");
    }
    check_observation(after.items[i], i);
  }
  return after;
}
void Describer::do_process(NodeIo& io) { io.out(0, std::make_shared<Observations>(describe(io))); }

AffinityTerm::~AffinityTerm() = default;
void AffinityTerm::evaluate(const AffinityEnd& from, std::span<const AffinityEnd> to,
                            std::span<double> log_affinity) const {
  if (to.size() != log_affinity.size()) {
    throw std::invalid_argument("an affinity term needs room for one value per link");
  }
  do_evaluate(from, to, log_affinity);
  for (std::size_t i = 0; i < log_affinity.size(); ++i) {
    if (!(log_affinity[i] <= 0)) throw InternalError(at("link", i) + "log affinity is not <= 0");
  }
}

Associator::~Associator() = default;
void Associator::check(const AssociatorOutput& output) const {
  for (std::size_t i = 0; i < output.points.size(); ++i) {
    const TrackPoint& p = output.points[i];
    if (p.id <= 0) throw InternalError(at("track point", i) + "id is not positive");
    if (p.frame < 0 || p.frame > last_frame_) {
      throw InternalError(at("track point", i) + "speaks of a frame that was not pushed");
    }
    if (!p.position_m.allFinite())
      throw InternalError(at("track point", i) + "position is not finite");
    if (!(p.score >= 0 && p.score <= 1))
      throw InternalError(at("track point", i) + "score not in [0, 1]");
  }
}
AssociatorOutput Associator::push(const AssociatorInput& input) {
  if (input.frame <= last_frame_)
    throw std::invalid_argument("frames must be pushed in rising order");
  last_frame_ = input.frame;
  AssociatorOutput output = do_push(input);
  check(output);
  return output;
}
AssociatorOutput Associator::flush_tracks() {
  AssociatorOutput output = do_flush_tracks();
  check(output);
  for (std::size_t i = 0; i < output.points.size(); ++i) {
    if (!output.points[i].final)
      throw InternalError(at("track point", i) + "still open after flush");
  }
  return output;
}
namespace {
void emit(NodeIo& io, AssociatorOutput output) {
  auto tracks = std::make_shared<Tracks>();
  tracks->points = std::move(output.points);
  io.out(0, std::move(tracks));
  if (io.output_count() > 1) {
    auto tracklets = std::make_shared<Tracklets>();
    tracklets->items = std::move(output.tracklets);
    io.out(1, std::move(tracklets));
  }
}
}  // namespace
void Associator::do_process(NodeIo& io) {
  AssociatorInput input{.frame = io.frame(), .time_ns = io.time_ns()};
  for (std::size_t i = 0; i < io.input_count(); ++i) {
    if (!io.has(i)) continue;
    if (io.port(i) == Observations::kPort) input.observations = &io.in<Observations>(i);
    if (io.port(i) == Tracklets::kPort) input.tracklets = &io.in<Tracklets>(i);
  }
  emit(io, push(input));
}
void Associator::do_flush(NodeIo& io) {
  // a global associator below another one still gets what that one held back
  for (std::size_t i = 0; i < io.input_count(); ++i) {
    if (io.has(i) && io.port(i) == Tracklets::kPort && !io.in<Tracklets>(i).items.empty()) {
      const AssociatorInput input{
          .frame = io.frame(), .time_ns = io.time_ns(), .tracklets = &io.in<Tracklets>(i)};
      last_frame_ = io.frame();
      AssociatorOutput late = do_push(input);
      last_frame_ = io.frame() - 1;
      check(late);
      AssociatorOutput rest = flush_tracks();
      late.points.insert(late.points.end(), rest.points.begin(), rest.points.end());
      late.tracklets.insert(late.tracklets.end(), rest.tracklets.begin(), rest.tracklets.end());
      emit(io, std::move(late));
      return;
    }
  }
  emit(io, flush_tracks());
}

Evaluator::~Evaluator() = default;
Evaluation Evaluator::evaluate() {
  Evaluation evaluation = do_evaluate();
  for (const auto& [section, values] : evaluation) {
    for (const auto& [key, value] : values.items()) {
      if (value.is_number() && !std::isfinite(value.get<double>())) {
        std::string metric = section;
        metric.append(".").append(key);
        throw InternalError("metric " + metric + " is not finite; leave out what is unknown");
      }
    }
  }
  return evaluation;
}
void Evaluator::do_process(NodeIo& io) { do_observe(io); }
void Evaluator::do_flush(NodeIo& io) { do_observe(io); }

Sink::~Sink() = default;
void Sink::do_process(NodeIo& io) { do_write(io); }
void Sink::do_flush(NodeIo& io) { do_write_rest(io); }

Renderer::~Renderer() = default;
void Renderer::begin(std::int64_t begin_frame, std::int64_t end_frame) {
  if (begin_frame < 0 || end_frame < begin_frame)
    throw std::invalid_argument("empty or negative range");
  do_begin(begin_frame, end_frame);
}
void Renderer::do_process(NodeIo& /*io*/) {}

}  // namespace plaza
