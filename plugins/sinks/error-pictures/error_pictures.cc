#include "plugins/sinks/error-pictures/error_pictures.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "plaza/scoring/people.h"
#include "plugins/sinks/drawing/contact_sheet.h"
#include "plugins/sinks/drawing/picture_file.h"
#include "plugins/sinks/error-pictures/crop.h"

namespace plaza::error_pictures {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kFrames = 2, kObservations = 0, kTruth = 1;
constexpr int kTileWidth = 264, kTileHeight = 330, kGap = 12;

const drawing::Color kMissed(70, 70, 240), kAlarm(40, 190, 255), kFound(110, 210, 90),
    kTrue(255, 255, 255);

double seen_area(const Box& box, const Camera& camera) {
  const double width = std::min(box.right(), camera.width() - 0.5) - std::max(box.left, -0.5);
  const double height = std::min(box.bottom(), camera.height() - 0.5) - std::max(box.top, -0.5);
  return width > 0 && height > 0 ? width * height : 0;
}

std::string words(std::string_view kind) {
  std::string text(kind);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string percent(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

std::string counted(std::int64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// What makes a miss one of its kind.
std::string reason_of(const Miss& miss, const ErrorRules& rules) {
  switch (miss.kind) {
    case MissKind::kBehindOccluder:
      return percent(miss.sight.behind_occluder) + " covered";
    case MissKind::kBehindPeople:
      return percent(miss.sight.behind_people) + " covered";
    case MissKind::kAtBorder:
      return miss.sight.cut >= rules.cut_share ? percent(miss.sight.cut) + " outside"
                                               : "area's border";
    case MissKind::kHidden:
      return percent(miss.sight.hidden) + " hidden";
    case MissKind::kNearAnother:
    case MissKind::kDisplaced:
    case MissKind::kUnexplained:
      break;
  }
  return {};
}

std::vector<drawing::Tile> tiles_of(const EpisodeBook& book) {
  std::vector<drawing::Tile> tiles;
  for (const Episode& episode : book.longest()) {
    if (episode.picture.empty()) continue;
    drawing::Tile& tile = tiles.emplace_back();
    tile.image = episode.picture;
    tile.name = "frame " + std::to_string(episode.pictured_frame + 1);
    if (episode.count > 1) tile.name += " (1/" + std::to_string(episode.count) + ")";
    tile.name += ", " + episode.who;
    tile.caption = episode.caption;
  }
  return tiles;
}

drawing::Section section_of(const std::string& title, const EpisodeBook& book) {
  drawing::Section section;
  section.title = title + ": " + std::to_string(book.errors());
  if (book.errors() > 0) {
    section.title += ", in " + counted(book.episodes(), "episode", "episodes");
  }
  section.tiles = tiles_of(book);
  return section;
}

}  // namespace

struct ErrorPictures::Scenery {
  std::int64_t frame;
  const FrameSet* frames;  ///< null: there are no images
  const GroundTruth& truth;
  const Observations& observations;
  const FrameErrors& errors;
  std::vector<std::vector<std::optional<Box>>> observed;  ///< [observation][camera]

  const Box* true_box(std::size_t person, std::size_t camera) const {
    for (const TrueView& view : truth.people[person].views) {
      if (view.camera == camera) return &view.box;
    }
    return nullptr;
  }
  cv::Mat image(std::size_t camera) const {
    return frames != nullptr && camera < frames->views.size() ? frames->views[camera] : cv::Mat();
  }
  /// The view that shows somebody's box largest, where a cut one counts by the square of what is
  /// left; none that doesn't show any of it.
  template <class BoxIn>
  std::optional<BestView> best_view(const Scene& scene, const BoxIn& box_in) const {
    std::optional<BestView> best;
    double most = 0;
    for (std::size_t camera = 0; camera < scene.cameras.size(); ++camera) {
      const Box* const box = box_in(camera);
      if (box == nullptr) continue;
      const double area = seen_area(*box, scene.cameras[camera]);
      const double merit = area > 0 ? area * std::pow(area / box->area(), 2) : 0;
      if (merit <= most) continue;
      best = BestView{camera, *box};
      most = merit;
    }
    return best;
  }
  /// All boxes of a view; those of the error itself (either may be null) stand out.
  std::vector<DrawnBox> boxes(std::size_t camera, const Miss* own_miss,
                              const FalseAlarm* own_alarm) const {
    std::vector<DrawnBox> drawn;
    for (std::size_t i = 0; i < truth.people.size(); ++i) {
      if (const Box* box = true_box(i, camera)) drawn.push_back({*box, {kTrue, 1, 4}});
    }
    std::vector<bool> wrong(observed.size(), false);
    for (const FalseAlarm& alarm : errors.alarms) wrong[alarm.observation] = true;
    for (std::size_t j = 0; j < observed.size(); ++j) {
      if (observed[j][camera] && !wrong[j]) drawn.push_back({*observed[j][camera], {kFound, 1}});
    }
    for (const Miss& miss : errors.misses) {
      const Box* const box = true_box(miss.sight.person, camera);
      if (box != nullptr) drawn.push_back({*box, {kMissed, &miss == own_miss ? 3 : 1}});
    }
    for (const FalseAlarm& alarm : errors.alarms) {
      const auto& box = observed[alarm.observation][camera];
      if (box) drawn.push_back({*box, {kAlarm, &alarm == own_alarm ? 3 : 1}});
    }
    return drawn;
  }
};

Declaration<ErrorPictures::Options> ErrorPictures::declare() {
  Parameters<Options> p;
  declare_error_rules(p);
  p.value("per_kind", &Options::per_kind)
      .at_least(1)
      .at_most(20)
      .meaning(
          "pictures of each kind, of its longest episodes: frames that follow each other, the "
          "same person or place");
  return Declaration<Options>("error-pictures",
                              "Shows misses and false alarms by kind: a table of all of them, and "
                              "a sheet with pictures.")
      .source("kinds as detection-errors counts them")
      .input<Observations>(
          "what is judged; where a view has no measured box, the scene's body is "
          "drawn")
      .input<GroundTruth>("the truth")
      .optional_input<FrameSet>("images of all views, for the pictures")
      .parameters(std::move(p));
}

ErrorPictures::ErrorPictures(const Options& options, const BuildContext& context)
    : options_(options),
      name_(context.name),
      scene_(context.scene),
      folder_(context.output_folder),
      sorter_(context.scene, options) {
  const auto most = static_cast<std::size_t>(options.per_kind);
  const auto gap = std::max<std::int64_t>(1, std::llround(scene_->frame_rate_hz / 2));
  misses_.assign(kMissKinds, EpisodeBook(most, gap, options.displaced_m));
  alarms_.assign(kAlarmKinds, EpisodeBook(most, gap, options.displaced_m));
}

OutputFile& ErrorPictures::table() {
  if (!table_) {
    const fs::path folder = folder_ / name_;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
      throw UserError("the folder '" + folder.string() +
                      "' for pictures could not be made: " + error.message());
    }
    table_.emplace(folder / "errors.csv");
    table_->write(table_header());
  }
  return *table_;
}

/// Empty where there is only one.
std::string ErrorPictures::view_name(std::size_t camera) const {
  return scene_->cameras.size() > 1 ? scene_->cameras[camera].name() : std::string();
}

void ErrorPictures::file_miss(const Scenery& scenery, const Miss& miss) {
  const TruePerson& person = scenery.truth.people[miss.sight.person];
  const auto view = scenery.best_view(
      *scene_, [&](std::size_t camera) { return scenery.true_box(miss.sight.person, camera); });
  table().write(table_row(scenery.frame, miss, person, view ? &*view : nullptr, *scene_));
  FiledError filed;
  filed.frame = scenery.frame;
  filed.id = person.id;
  if (miss.sight.position_m) filed.position_m = *miss.sight.position_m;
  misses_[static_cast<std::size_t>(miss.kind)].add(filed, [&]() -> Pictured {
    if (!view || scenery.frames == nullptr) return {};
    Box focus = view->box;
    if (miss.alarm && scenery.observed[*miss.alarm][view->camera]) {
      focus = around(focus, *scenery.observed[*miss.alarm][view->camera]);
    }
    const std::string reason = reason_of(miss, options_);
    std::string caption = view_name(view->camera);
    caption.append(caption.empty() || reason.empty() ? "" : ", ").append(reason);
    return {
        crop_around(scenery.image(view->camera), focus, scenery.boxes(view->camera, &miss, nullptr),
                    sorter_.occluders(view->camera), {kTileWidth, kTileHeight}),
        "person " + std::to_string(person.id), caption};
  });
}

void ErrorPictures::file_alarm(const Scenery& scenery, const FalseAlarm& alarm) {
  const Observation& observation = scenery.observations.items[alarm.observation];
  const TruePerson* const person = alarm.person ? &scenery.truth.people[*alarm.person] : nullptr;
  const auto view = scenery.best_view(*scene_, [&](std::size_t camera) -> const Box* {
    const auto& box = scenery.observed[alarm.observation][camera];
    return box ? &*box : nullptr;
  });
  table().write(
      table_row(scenery.frame, alarm, observation, person, view ? &*view : nullptr, *scene_));
  FiledError filed;
  filed.frame = scenery.frame;
  filed.position_m = observation.position_m;
  alarms_[static_cast<std::size_t>(alarm.kind)].add(filed, [&]() -> Pictured {
    if (!view || scenery.frames == nullptr) return {};
    Box focus = view->box;
    if (alarm.kind == AlarmKind::kDisplaced) {
      if (const Box* box = scenery.true_box(*alarm.person, view->camera)) {
        focus = around(focus, *box);
      }
    }
    return {crop_around(scenery.image(view->camera), focus,
                        scenery.boxes(view->camera, nullptr, &alarm),
                        sorter_.occluders(view->camera), {kTileWidth, kTileHeight}),
            "p " + percent(observation.probability), view_name(view->camera)};
  });
}

void ErrorPictures::do_write(const NodeIo& io) {
  if (!io.has(kObservations) || !io.has(kTruth)) return;
  const auto& truth = io.in<GroundTruth>(kTruth);
  const auto& observations = io.in<Observations>(kObservations);
  const FrameErrors errors = sorter_.sort(truth, observations);
  Scenery scenery{io.frame(), io.find<FrameSet>(kFrames), truth, observations, errors, {}};
  for (const Observation& o : observations.items) {
    scenery.observed.push_back(boxes_in_views(*scene_, o.position_m, o.boxes));
  }
  for (const Miss& miss : errors.misses) file_miss(scenery, miss);
  for (const FalseAlarm& alarm : errors.alarms) file_alarm(scenery, alarm);
}

void ErrorPictures::write_sheet(const fs::path& file) const {
  std::vector<drawing::Section> sections;
  for (std::size_t i = 0; i < kMissKinds; ++i) {
    sections.push_back(
        section_of("missed, " + words(to_string(static_cast<MissKind>(i))), misses_[i]));
  }
  for (std::size_t i = 0; i < kAlarmKinds; ++i) {
    sections.push_back(
        section_of("false alarm, " + words(to_string(static_cast<AlarmKind>(i))), alarms_[i]));
  }
  std::size_t columns = 4;  // the title's width
  for (const drawing::Section& s : sections) columns = std::max(columns, s.tiles.size());
  const int width = static_cast<int>(columns) * (kTileWidth + kGap) + kGap;
  drawing::write_png(
      file, drawing::contact_sheet(
                "True: dashes; found: green; missed: red; false alarm: amber. " + scene_->name,
                sections, width, static_cast<int>(columns), 1));
}

std::vector<Artifact> ErrorPictures::do_finish(bool complete) {
  OutputFile& file = table();
  file.commit();
  const std::string partial = complete ? "" : ", partial";
  const fs::path sheet = folder_ / name_ / "errors.png";
  write_sheet(sheet);
  return {{file.file(), "misses and false alarms, each with its kind" + partial},
          {sheet, "pictures of misses and false alarms by kind" + partial}};
}

}  // namespace plaza::error_pictures
