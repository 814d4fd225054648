#include "plugins/detectors/hierarchical-grid/hierarchical_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "plaza/data/evidence.h"
#include "plugins/detectors/hierarchical-grid/silhouette_codec.h"

namespace plaza {
namespace {

GroundArea searched_area(const Scene& scene, double margin_m) {
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  return {.min_m = scene.area.min_m - margin, .max_m = scene.area.max_m + margin};
}

StateGrid make_grid(const HierarchicalGrid::Options& o, const Scene& scene) {
  int divisor = 1;
  for (int level = 1; level < o.levels && divisor <= o.cells; ++level) divisor *= o.branching;
  if (o.cells % divisor != 0) {
    throw UserError(fault_at("/cells", "must be divisible by branching^(levels - 1), which is " +
                                           std::to_string(divisor) +
                                           ", so that every cell has one parent"));
  }
  return StateGrid(searched_area(scene, o.margin_m), o.cells, o.levels, o.branching);
}

std::vector<Witness> make_witnesses(const std::vector<InputReference>& inputs) {
  if (inputs.empty()) {
    throw UserError(fault_at(
        "/modalities", "is empty: name at least one modality, such as { \"from\": \"edges\" }"));
  }
  std::vector<Witness> witnesses;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    auto modality = std::dynamic_pointer_cast<const Modality>(inputs[i].producer);
    if (!modality) {
      throw UserError(fault_at(
          "/modalities/" + std::to_string(i) + "/from",
          "'" + inputs[i].from + "' is no modality: it can't compare silhouettes with images"));
    }
    witnesses.push_back({std::move(modality), inputs[i].fields.value("weight", 1.0)});
  }
  return witnesses;
}

}  // namespace

HierarchicalGrid::HierarchicalGrid(const Options& options, const BuildContext& context)
    : options_(options),
      scene_(context.scene),
      shape_(context.part<ShapeModel>("shape")),
      witnesses_(make_witnesses(context.inputs("modalities"))),
      curve_(options.probability),
      grid_(make_grid(options, *context.scene)),
      neighbours_(gaussian_neighbours(grid_.finest(), options.smoothing_m)),
      rivals_(cells_around(grid_.finest(), options.separation_m.value_or(3 * options.smoothing_m))),
      hierarchy_(grid_, *scene_, options.sizes) {
  for (const InputReference& input : context.inputs("modalities")) slots_.push_back(input.slot);
  if (options.inference != Inference::kIndependent && options.maxima == Maxima::kAll) {
    throw UserError(
        fault_at("/maxima",
                 "\"all\" needs \"inference\": \"independent\": who is inferred together is "
                 "no maximum of one surface"));
  }
}

void HierarchicalGrid::do_finish(std::int64_t /*seen*/) {
  hierarchy_.compute(*shape_, options_.min_inside, options_.occluders);
  sample();
}

void HierarchicalGrid::do_save(std::ostream& out) const { hierarchy_.save(out); }

void HierarchicalGrid::do_load(std::istream& in) {
  hierarchy_.load(in);
  sample();
}

void HierarchicalGrid::sample() {
  search_ = std::make_unique<GridSearch>(
      grid_, hierarchy_, *shape_, witnesses_, scene_->cameras,
      ViewTrust{options_.visible_share, options_.sharp_px, options_.edge_loss, options_.hidden_loss,
                options_.empty_views},
      options_.refine_above, options_.spread);
  if (options_.inference != Inference::kIndependent) {
    const bool mean_field = options_.inference == Inference::kMeanField;
    joint_ = std::make_unique<JointSearch>(
        grid_, *search_, neighbours_, rivals_,
        JointSearch::Options{
            .min_score = options_.min_score,
            .accept_score = mean_field ? options_.accept_score.value_or(options_.min_score / 2)
                                       : options_.min_score,
            .watch_score = options_.watch_score,
            .doubt_score = options_.doubt_score,
            .doubt_people = options_.doubt_people,
            .doubt_starts = options_.doubt_starts,
            .mean_field = mean_field ? &curve_ : nullptr,
            .most = options_.most,
            .rounds = options_.rounds,
            .reach_m = options_.reach_m,
            .max_sigma_m = options_.max_sigma_m,
            .nearer_only = options_.occlusion_order,
            .size_sigma = options_.size_sigma});
  }
}

std::string HierarchicalGrid::do_extra_key() const {
  std::string bytes;
  const std::size_t cells = grid_.size(grid_.levels() - 1);
  for (const Camera& camera : scene_->cameras) {
    for (const std::size_t cell : {cells / 3, cells / 2, 2 * cells / 3}) {
      const Pose pose{grid_.position(grid_.levels() - 1, static_cast<CellIndex>(cell)), 0, 1};
      encode(shape_->silhouette(pose, camera), bytes);
    }
  }
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return "silhouettes " + std::to_string(hash);
}

AllEvidence HierarchicalGrid::evidence_of(const NodeIo& io) const {
  AllEvidence evidence;
  for (const std::size_t slot : slots_) {
    evidence.push_back(io.in<EvidenceSet>(slot).views);
    if (evidence.back().size() != scene_->cameras.size()) {
      throw InternalError("evidence of " + std::to_string(evidence.back().size()) +
                          " views in a scene of " + std::to_string(scene_->cameras.size()));
    }
  }
  return evidence;
}

SearchResult HierarchicalGrid::searched(const AllEvidence& evidence) const {
  if (!search_) throw InternalError("the template hierarchy was neither computed nor loaded");
  return search_->search(evidence);
}

Observations HierarchicalGrid::do_detect(const NodeIo& io) const {
  return do_detect_all(io).observations;
}

std::vector<FoundPerson> HierarchicalGrid::independently(const LevelLikelihood& finest) const {
  const GroundGrid& grid = grid_.finest();
  const std::vector<double> surface = smoothed(grid, finest.joint, neighbours_);
  std::vector<CellIndex> found;
  if (options_.maxima == Maxima::kLocal) {
    found = local_maxima(grid, surface, finest.evaluated, rivals_);
  } else {
    for (std::size_t cell = 0; cell < surface.size(); ++cell) {
      if (finest.evaluated[cell] != 0) found.push_back(static_cast<CellIndex>(cell));
    }
  }
  std::erase_if(found, [&](CellIndex cell) {
    return !(search_->score_of(cell, surface[cell], finest) >= options_.min_score);
  });
  std::stable_sort(found.begin(), found.end(),
                   [&](CellIndex a, CellIndex b) { return surface[a] > surface[b]; });
  std::vector<FoundPerson> people;
  for (const CellIndex cell : found) {
    FoundPerson& person = people.emplace_back();
    person.body.cell = cell;
    person.score = search_->score_of(cell, surface[cell], finest);
    person.peak = options_.maxima == Maxima::kLocal
                      ? peak_at(grid, surface, cell, options_.max_sigma_m)
                      : Peak{grid_.position(grid_.levels() - 1, cell), covariance_of_cell(grid)};
    for (const std::vector<double>& view : finest.views) person.views.push_back(view[cell]);
  }
  return people;
}

Detector::Detected HierarchicalGrid::do_detect_all(const NodeIo& io) const {
  const AllEvidence evidence = evidence_of(io);
  SearchResult result = searched(evidence);
  LevelLikelihood& finest = result.levels.back();
  const std::vector<FoundPerson> people =
      joint_ ? joint_->infer(evidence, result) : independently(finest);
  Detected out;
  out.observations.grid = grid_.finest();
  for (const FoundPerson& person : people) {
    if (out.observations.items.size() == static_cast<std::size_t>(options_.most)) break;
    Observation o = observation_of(person);
    if (scene_->area.contains(o.position_m)) out.observations.items.push_back(std::move(o));
  }

  auto likelihood = std::make_shared<GroundLikelihood>();
  likelihood->grid = grid_.finest();
  for (std::size_t cell = 0; cell < finest.joint.size(); ++cell) {
    if (finest.evaluated[cell] == 0) finest.joint[cell] = std::nan("");
  }
  likelihood->joint = std::move(finest.joint);
  likelihood->views = std::move(finest.views);
  out.likelihood = std::move(likelihood);
  return out;
}

Observation HierarchicalGrid::observation_of(const FoundPerson& person) const {
  Observation o;
  o.position_m = person.peak.position_m;
  o.covariance_m2 = options_.covariance_scale * person.peak.covariance_m2;
  o.probability = curve_(person.score);
  o.score = person.score;
  Body body = shape_->body();
  const double scale = search_->sizes()[person.body.size].scale;
  body.height_m *= scale;
  body.radius_m *= scale;
  for (std::size_t camera = 0; camera < person.views.size(); ++camera) {
    if (!std::isfinite(person.views[camera])) continue;
    if (const auto box = body_box(scene_->cameras[camera], o.position_m, body)) {
      o.boxes.push_back({camera, *box, person.views[camera]});
    }
  }
  return o;
}

}  // namespace plaza
