#include "plugins/sinks/evidence-pictures/evidence_pictures.h"

#include <cstdio>
#include <system_error>

#include "plaza/data/evidence.h"
#include "plaza/data/ground_likelihood.h"
#include "plugins/sinks/drawing/picture_file.h"
#include "plugins/sinks/evidence-pictures/likelihood_pictures.h"

namespace plaza::evidence_pictures {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kFrames = 0, kLikelihood = 1;

std::string six_digits(std::int64_t frame) {
  char text[24];
  std::snprintf(text, sizeof text, "%06lld", static_cast<long long>(frame + 1));
  return text;
}

}  // namespace

Declaration<EvidencePictures::Options> EvidencePictures::declare() {
  Parameters<Options> p;
  p.value("frames", &Options::frames)
      .at_least(1)
      .items(1)
      .meaning(
          "frames to show, from 1 as in the files of results; frames outside of the run are "
          "left out");
  p.input_list("evidence", std::string(EvidenceSet::kPort), {})
      .meaning("modalities whose evidence is shown");
  p.value("sheet_width_px", &Options::sheet_width_px)
      .unit("px")
      .at_least(320)
      .at_most(16000)
      .meaning("width of the sheet with all pictures of a frame");
  p.value("columns", &Options::columns)
      .at_least(1)
      .at_most(20)
      .meaning("most pictures side by side on the sheet");
  return Declaration<Options>("evidence-pictures",
                              "Pictures of what modalities and detectors saw in chosen frames, and "
                              "a labelled sheet of them.")
      .source("thesis Figures 4.4-4.10")
      .input<FrameSet>("images of all views")
      .optional_input<GroundLikelihood>("drawn on the ground of every view and as a surface")
      .parameters(std::move(p));
}

EvidencePictures::EvidencePictures(const Options& options, const BuildContext& context)
    : options_(options),
      name_(context.name),
      scene_(context.scene),
      folder_(context.output_folder),
      evidence_(context.inputs("evidence")) {
  for (const std::int64_t from_one : options.frames) wanted_.insert(from_one - 1);
}

drawing::Section EvidencePictures::view_section(const NodeIo& io, std::size_t camera) const {
  drawing::Section section{scene_->cameras[camera].name(), {}};
  const FrameSet& frames = io.in<FrameSet>(kFrames);
  const cv::Mat image = camera < frames.views.size() ? frames.views[camera] : cv::Mat();
  if (!image.empty()) section.tiles.push_back({image, "image", "as the camera saw it"});
  for (const InputReference& input : evidence_) {
    const auto* evidence = io.find<EvidenceSet>(input.slot);
    if (evidence == nullptr || camera >= evidence->views.size()) continue;
    if (evidence->views[camera] == nullptr) continue;  // no image in this frame
    for (Picture& picture : evidence->views[camera]->pictures()) {
      section.tiles.push_back(
          {std::move(picture.image), input.from + "." + picture.name, std::move(picture.caption)});
    }
  }
  if (const auto* likelihood = io.find<GroundLikelihood>(kLikelihood)) {
    const Camera& c = scene_->cameras[camera];
    const auto add = [&](const char* file, const char* caption, std::span<const double> values) {
      section.tiles.push_back(
          {likelihood_on_view(image, c, likelihood->grid, relative_likelihood(values)), file,
           caption});
    };
    add("likelihood", "joint likelihood of the cells on the ground", likelihood->joint);
    if (scene_->cameras.size() > 1 && camera < likelihood->views.size()) {
      add("likelihood-of-view", "likelihood of the cells in this view alone",
          likelihood->views[camera]);
    }
  }
  return section;
}

drawing::Section EvidencePictures::surface_section(const NodeIo& io) const {
  const auto* likelihood = io.find<GroundLikelihood>(kLikelihood);
  if (likelihood == nullptr) return {};
  return {
      "ground",
      {{likelihood_surface(likelihood->grid, relative_likelihood(likelihood->joint), {1200, 800}),
        "likelihood-surface", "joint likelihood, share of the best cell's"}}};
}

void EvidencePictures::write_section(const drawing::Section& section,
                                     const fs::path& folder) const {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw UserError("the folder '" + folder.string() +
                    "' for pictures could not be made: " + error.message());
  }
  for (const drawing::Tile& tile : section.tiles) {
    drawing::write_png(folder / (tile.name + ".png"), tile.image);
  }
}

void EvidencePictures::do_write(const NodeIo& io) {
  if (!wanted_.contains(io.frame())) return;
  const std::string number = six_digits(io.frame());
  const fs::path folder = folder_ / name_ / number;
  std::vector<drawing::Section> sections;
  for (std::size_t camera = 0; camera < scene_->cameras.size(); ++camera) {
    sections.push_back(view_section(io, camera));
    write_section(sections.back(), folder / sections.back().title);
    if (sections.back().tiles.empty()) sections.back().title += ": no image";
  }
  if (drawing::Section surface = surface_section(io); !surface.tiles.empty()) {
    write_section(surface, folder);
    sections.push_back(std::move(surface));
  }
  const fs::path sheet = folder_ / name_ / ("sheet-" + number + ".png");
  const std::string title = scene_->name + ", frame " + std::to_string(io.frame() + 1);
  drawing::write_png(
      sheet, drawing::contact_sheet(title, sections, options_.sheet_width_px, options_.columns));
  written_.push_back({sheet, "what was seen in frame " + std::to_string(io.frame() + 1) +
                                 ", all pictures on one sheet; each of them is in " +
                                 folder.filename().string() + "/"});
}

std::vector<Artifact> EvidencePictures::do_finish(bool /*complete*/) { return written_; }

}  // namespace plaza::evidence_pictures
