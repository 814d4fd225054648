#include "plugins/sinks/reliability-diagram/reliability_diagram.h"

#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <utility>

#include "plaza/io/output_file.h"
#include "plugins/sinks/drawing/picture_file.h"
#include "plugins/sinks/reliability-diagram/panels.h"

namespace plaza::reliability_diagram {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kObservations = 0, kTruth = 1;

std::string table_of(std::span<const ReliabilityBin> bins) {
  std::ostringstream rows;
  rows << "from,to,observations,mean_probability,right_share\n";
  for (const ReliabilityBin& bin : bins) {
    rows << bin.low << ',' << bin.high << ',' << bin.count << ',';
    if (bin.count > 0) rows << bin.mean_probability;
    rows << ',';
    if (bin.count > 0) rows << bin.right_share;
    rows << '\n';
  }
  return rows.str();
}

}  // namespace

Declaration<ReliabilityDiagram::Options> ReliabilityDiagram::declare() {
  Parameters<Options> p;
  p.value("overlap", &Options::overlap)
      .above(0)
      .at_most(1)
      .meaning("least overlap of a match, the mean over the views in which the true person counts")
      .source("thesis 3.3.2");
  p.value("bins", &Options::bins)
      .at_least(1)
      .at_most(100)
      .meaning("intervals of probability in the diagram and its table");
  p.value("points", &Options::points)
      .at_least(2)
      .at_most(100)
      .meaning("most points of the fitted curve");
  return Declaration<Options>("reliability-diagram",
                              "Draws whether observations are as probable and as precise as they "
                              "say, and fits a detector's \"probability\".")
      .source("figures as reliability gives them")
      .input<Observations>(
          "what is judged; where a view has no measured box, the scene's body is "
          "drawn")
      .input<GroundTruth>("the truth")
      .parameters(std::move(p));
}

ReliabilityDiagram::ReliabilityDiagram(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene), folder_(context.output_folder / context.name) {}

void ReliabilityDiagram::do_write(const NodeIo& io) {
  if (!io.has(kObservations) || !io.has(kTruth)) return;
  judgement_.add(*scene_, io.in<GroundTruth>(kTruth), io.in<Observations>(kObservations),
                 options_.overlap);
}

std::vector<Artifact> ReliabilityDiagram::do_finish(bool complete) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) {
    throw UserError("the folder '" + folder_.string() +
                    "' for pictures could not be made: " + error.message());
  }
  const auto bins = reliability_bins(judgement_.observations, options_.bins);
  const auto curve = calibration_curve(judgement_.observations, options_.points);
  nlohmann::json points = nlohmann::json::array();
  for (const CurvePoint& point : curve) points.push_back({point.score, point.probability});
  const fs::path diagram = folder_ / "reliability.png", table = folder_ / "reliability.csv",
                 fitted = folder_ / "curve.json";
  drawing::write_png(diagram, draw_reliability(judgement_, bins, curve));
  write_file(table, table_of(bins));
  write_file(fitted, nlohmann::json({{"probability", points}}).dump() + "\n");
  const std::string partial = complete ? "" : ", partial";
  return {{diagram, "probabilities and positions against the truth" + partial},
          {table, "the diagram's bins" + partial},
          {fitted, "fitted: \"probability\": " + points.dump() + partial}};
}

}  // namespace plaza::reliability_diagram
