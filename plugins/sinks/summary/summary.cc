#include "plugins/sinks/summary/summary.h"

#include <iomanip>
#include <sstream>

#include "plaza/io/output_file.h"
#include "plugins/sinks/drawing/picture_file.h"
#include "plugins/sinks/summary/trajectories.h"

namespace plaza::summary {
namespace {

std::string fixed(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

std::string row_of_counts(const std::string& what, const std::vector<std::int64_t>& counts) {
  const CountFigures f = figures_of_counts(counts);
  return "| " + what + " | " + std::to_string(f.least) + " | " + fixed(f.mean, 2) + " | " +
         std::to_string(f.most) + " |\n";
}

}  // namespace

Declaration<Summary::Options> Summary::declare() {
  Parameters<Options> p;
  p.value("file", &Options::file).meaning("name of the page in the output folder, Markdown");
  p.value("plan", &Options::plan)
      .meaning("name of the picture with all trajectories in the output folder, .png");
  p.value("plan_width_px", &Options::plan_width_px)
      .unit("px")
      .at_least(320)
      .at_most(8000)
      .meaning("width of the picture; its height follows from the place");
  return Declaration<Options>(
             "summary",
             "A page with a table of people, counts per frame, and a plan with every "
             "trajectory.")
      .input<Tracks>("who is where; only final rows count")
      .optional_input<Observations>("counted per frame")
      .parameters(std::move(p));
}

Summary::Summary(const Options& options, const BuildContext& context)
    : options_(options), scene_(context.scene), folder_(context.output_folder) {}

Diagnostics Summary::do_check() const {
  Diagnostics faults;
  const auto check_name = [&](const char* pointer, const std::string& name,
                              const std::string& extension) {
    std::string fault = drawing::fault_of_file_name(name);
    if (fault.empty() && std::filesystem::path(name).extension() != extension) {
      fault = "'" + name + "' must end in " + extension;
    }
    if (!fault.empty()) faults.push_back(fault_at(pointer, fault));
  };
  check_name("/file", options_.file, ".md");
  check_name("/plan", options_.plan, ".png");
  return faults;
}

void Summary::do_write(const NodeIo& io) {
  if (!any_frame_) begin_frame_ = io.frame();
  any_frame_ = true;
  end_frame_ = io.frame() + 1;
  if (const auto* observations = io.find<Observations>(1)) {
    observations_.push_back(static_cast<std::int64_t>(observations->items.size()));
  }
  take_tracks(io);
}

void Summary::do_write_rest(const NodeIo& io) { take_tracks(io); }

void Summary::take_tracks(const NodeIo& io) {
  const auto* tracks = io.find<Tracks>(0);
  if (!tracks) return;
  for (const TrackPoint& p : tracks->points) {
    if (p.final) points_[p.id].insert_or_assign(p.frame, p);
  }
}

std::vector<Artifact> Summary::do_finish(bool complete) {
  Trajectories people;
  for (const auto& [id, points] : points_) {
    for (const auto& [frame, point] : points) people[id].push_back(point);
  }
  const std::filesystem::path page_file = folder_ / options_.file,
                              plan_file = folder_ / options_.plan;
  drawing::write_png(plan_file, draw_trajectories(*scene_, people, options_.plan_width_px));
  write_file(page_file, page(people, complete));
  const std::string partial = complete ? "" : ", partial";
  return {{page_file, "summary of people and counts" + partial},
          {plan_file, "plan from above with every trajectory" + partial}};
}

std::string Summary::page(const Trajectories& people, bool complete) const {
  const double rate_hz = scene_->frame_rate_hz;
  const std::int64_t frames = end_frame_ - begin_frame_;
  std::ostringstream page;
  page << "# " << (scene_->name.empty() ? "Summary" : scene_->name) << "\n\n";
  if (!complete) {
    page << "**Partial: the run ended before its last frame. Everything below is of what was "
            "complete "
            "by then.**\n\n";
  }
  page << people.size() << (people.size() == 1 ? " person" : " people") << " in " << frames
       << (frames == 1 ? " frame" : " frames");
  if (frames > 0) page << " (" << begin_frame_ + 1 << " to " << end_frame_ << ")";
  page << ", " << fixed(static_cast<double>(frames) / rate_hz, 1) << " s at " << rate_hz << " Hz, "
       << scene_->cameras.size() << (scene_->cameras.size() == 1 ? " camera" : " cameras")
       << ".\n\n"
       << "![Plan from above with every trajectory](" << options_.plan << ")\n\n";

  if (frames > 0) {
    page << "## Counts per frame\n\n| | least | mean | most |\n|---|---:|---:|---:|\n"
         << row_of_counts("people", people_per_frame(people, begin_frame_, end_frame_));
    if (!observations_.empty()) page << row_of_counts("observations", observations_);
    page << "\n";
  }

  page << "## People\n\n";
  if (people.empty()) {
    page << "Nobody was tracked.\n";
    return page.str();
  }
  page << "| id | first frame | last frame | seconds | path (m) | mean speed (m/s) | observed |\n"
          "|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const auto& [id, trajectory] : people) {
    const PersonFigures f = figures_of(trajectory, rate_hz);
    page << "| " << id << " | " << f.first_frame + 1 << " | " << f.last_frame + 1 << " | "
         << fixed(f.seconds, 1) << " | " << fixed(f.path_m, 1) << " | " << fixed(f.speed_m_per_s, 2)
         << " | " << fixed(100 * f.observed_share, 0) << " % |\n";
  }
  page << "\nFrames count from 1. Seconds are those in which the person was there. Paths are "
          "measured "
          "along positions averaged over one second; absences of more than a second are left out. "
          "Observed is the share of a person's frames that a detection supports; in the others the "
          "position was bridged.\n";
  return page.str();
}

}  // namespace plaza::summary
