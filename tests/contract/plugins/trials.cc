#include "tests/contract/plugins/trials.h"

#include <fstream>
#include <functional>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <utility>

#include "tests/support/blob_network.h"
#include "tests/support/overlap_modality.h"

namespace plaza::contract {
namespace {

namespace fs = std::filesystem;
using Values = nlohmann::json;

Trial trial(std::string label, Values values) {
  Trial t;
  t.label = std::move(label);
  t.values = std::move(values);
  return t;
}

std::vector<Trial> defaults() { return {Trial()}; }

Values by_camera(const World& world, const std::function<std::string(std::size_t)>& value) {
  Values out = Values::object();
  for (std::size_t c = 0; c < world.scene()->cameras.size(); ++c) {
    out[world.scene()->cameras[c].name()] = value(c);
  }
  return out;
}

/// For evaluators that may leave out how a run begins.
std::vector<Trial> from_the_start_and_later() {
  return {Trial(), trial("half a second later", {{"from_s", 0.5}})};
}

/// MOTChallenge rows of the world's detections, one file per camera.
Values detection_files(const World& world, const fs::path& folder) {
  return by_camera(world, [&](std::size_t camera) {
    const fs::path file = folder / ("detections" + std::to_string(camera) + ".txt");
    std::ofstream out(file);
    out << std::setprecision(10);
    for (std::int64_t frame = 0; frame < world.frame_count(); ++frame) {
      for (const ImageDetection& d : world.detections(frame).views[camera]) {
        out << frame + 1 << ",-1," << d.box.left << ',' << d.box.top << ',' << d.box.width << ','
            << d.box.height << ',' << d.score << '\n';
      }
    }
    return file.string();
  });
}

/// frame,id,x_m,y_m of the true people.
std::string ground_file(const World& world, const fs::path& folder) {
  const fs::path file = folder / "ground.csv";
  std::ofstream out(file);
  out << std::setprecision(10);
  for (std::int64_t frame = 0; frame < world.frame_count(); ++frame) {
    for (const TruePerson& p : world.ground_truth(frame).people) {
      out << frame + 1 << ',' << p.id << ',' << p.position_m->x() << ',' << p.position_m->y()
          << '\n';
    }
  }
  return file.string();
}

/// Numbered images; a view that is missing has no file.
Values image_files(const World& world, const fs::path& folder) {
  return by_camera(world, [&](std::size_t camera) {
    const fs::path views = folder / ("view" + std::to_string(camera));
    fs::create_directories(views);
    for (std::int64_t frame = 0; frame < world.frame_count(); ++frame) {
      const cv::Mat& image = world.frames(frame).views[camera];
      if (!image.empty())
        cv::imwrite((views / (std::to_string(100 + frame) + ".png")).string(), image);
    }
    return (views / "{frame}.png").string();
  });
}

Values video_files(const World& world, const fs::path& folder) {
  return by_camera(world, [&](std::size_t camera) {
    const fs::path file = folder / ("view" + std::to_string(camera) + ".avi");
    const Camera& c = world.scene()->cameras[camera];
    cv::VideoWriter writer(file.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                           world.scene()->frame_rate_hz, {c.width(), c.height()});
    for (std::int64_t frame = 0; frame < world.frame_count(); ++frame) {
      const cv::Mat& image = world.frames(frame).views[camera];
      writer.write(image.empty() ? world.people_free(frame).views[camera] : image);
    }
    return file.string();
  });
}

Trial follower(Trial t) {
  t.role = SourceRole::kFollower;
  t.label += ", beside another source";
  return t;
}

/// A network that takes whatever is not grey for a person, in boxes of many sizes about each cell.
std::string network_file(const fs::path& folder) {
  test::BlobNetwork network;
  network.width = network.height = 128;
  network.classes = {{1, -1, 0}};
  network.bias = 0;
  const int columns = network.width / network.cell;
  for (int cell = 0; cell < columns * columns; ++cell) {
    const double x = (cell % columns + 0.5) * network.cell;
    const double y = (cell / columns + 0.5) * network.cell;
    const double height = 10.0 + 5.0 * (cell % 7);
    network.boxes[cell] = {x - 0.2 * height, y - 0.5 * height, x + 0.2 * height, y + 0.5 * height};
  }
  const fs::path file = folder / "network.onnx";
  std::ofstream(file, std::ios::binary) << network.bytes();
  return file.string();
}

/// What detectors of single views give: the boxes of an observation, one observation each.
std::shared_ptr<const World> world_of_single_views() {
  auto world = std::make_shared<World>();
  std::vector<PayloadPtr> frames;
  for (std::int64_t frame = 0; frame < world->frame_count(); ++frame) {
    auto split = std::make_shared<Observations>();
    for (const Observation& o : world->observations(frame).items) {
      for (const ViewBox& box : o.boxes) {
        split->items.push_back(o);
        split->items.back().boxes = {box};
      }
    }
    frames.push_back(split);
  }
  world->provide(std::string(Observations::kPort), frames);
  return world;
}

using Maker = std::function<std::vector<Trial>(const fs::path& files)>;

const std::map<std::string, Maker>& table() {
  static const std::map<std::string, Maker> kTable = {
      // sources
      {"detections",
       [](const fs::path& files) {
         const Trial t = trial("files", {{"files", detection_files(World(), files)}});
         return std::vector<Trial>{t, follower(t)};
       }},
      {"ground-truth",
       [](const fs::path& files) {
         const Trial t = trial("ground positions", {{"ground", ground_file(World(), files)}});
         return std::vector<Trial>{follower(t)};
       }},
      {"images",
       [](const fs::path& files) {
         const Values pattern = image_files(World(), files);
         return std::vector<Trial>{trial("numbered files", {{"pattern", pattern}}),
                                   trial("every third", {{"pattern", pattern}, {"step", 3}})};
       }},
      {"synthetic",
       [](const fs::path&) {
         const Trial t = trial("two people", {{"scenario", "two-targets"}, {"frames", 6}});
         Values lost = Values::array({World().scene()->cameras.back().name()});
         return std::vector<Trial>{t, follower(t),
                                   trial("a changing place", {{"scenario", "two-targets"},
                                                              {"frames", 6},
                                                              {"light", 0.5},
                                                              {"light_from_s", 0.1},
                                                              {"light_seconds", 0.1},
                                                              {"shadow", 0.5},
                                                              {"moved_furniture_s", 0.1}}),
                                   trial("a lost camera", {{"scenario", "two-targets"},
                                                           {"frames", 6},
                                                           {"lost_cameras", lost},
                                                           {"lost_from_s", 0.1}})};
       }},
      {"video",
       [](const fs::path& files) {
         return std::vector<Trial>{
             trial("motion JPEG", {{"files", video_files(World(1, 15), files)}})};
       }},
      // models
      {"constant-velocity",
       [](const fs::path&) {
         return std::vector<Trial>{Trial(), trial("restless", {{"acceleration_sigma", 5.0}})};
       }},
      {"cylinder", [](const fs::path&) { return defaults(); }},
      {"box-parallelepiped", [](const fs::path&) { return defaults(); }},
      {"edges",
       [](const fs::path&) {
         return std::vector<Trial>{
             Trial(),
             trial("median", {{"background", "median"}}),
             trial("sobel", {{"method", "sobel"}, {"background", "none"}}),
             trial("silhouette", {{"explains", "silhouette"}}),
             trial("region", {{"explains", "region"}}),
             trial("shapes", {{"least_piece_m", 0.2}, {"longest_line_m", 2.0}})};
       }},
      {"color",
       [](const fs::path&) {
         return std::vector<Trial>{
             Trial(),
             trial("median", {{"background", "median"}}),
             trial("one frame", {{"background_first", 1}}),
             trial("living", {{"follow_light", true}, {"settle_s", 1}}),
             trial("parts", {{"parts", {{0.486, 0.1}, {0.829, 0.1}, {1, 0.1}}}}),
             trial("shapes",
                   {{"least_height_m", 0.2}, {"least_column_m", 0.1}, {"most_hole", 0.05}})};
       }},
      // detectors
      {"boxes", [](const fs::path&) { return defaults(); }},
      {"hog",
       [](const fs::path&) {
         Trial t;
         t.world = std::make_shared<World>(2, 8);  // a tenth of a second per frame
         return std::vector<Trial>{t};
       }},
      {"onnx",
       [](const fs::path& files) {
         const std::string model = network_file(files);
         return std::vector<Trial>{trial("letterbox", {{"model", model}}),
                                   trial("one copy, stretched", {{"model", model},
                                                                 {"head", "yolov8"},
                                                                 {"input_size", {128, 128}},
                                                                 {"fit", "stretch"},
                                                                 {"copies", 1}})};
       }},
      {"ground-fusion",
       [](const fs::path&) {
         std::vector<Trial> trials = {Trial(), trial("two views", {{"min_views", 2}})};
         for (Trial& t : trials) t.world = world_of_single_views();
         return trials;
       }},
      {"hierarchical-grid",
       [](const fs::path&) {
         const Values modalities = Values::array({{{"from", "overlap"}, {"weight", 2.0}}});
         std::vector<Trial> trials = {
             trial("local maxima", {{"modalities", modalities}, {"cells", 20}, {"min_score", 0.3}}),
             trial("greedy", {{"modalities", modalities},
                              {"cells", 20},
                              {"min_score", 0.3},
                              {"inference", "greedy"},
                              {"sizes", {0.9}}}),
             trial("all cells", {{"modalities", modalities},
                                 {"cells", 12},
                                 {"levels", 2},
                                 {"maxima", "all"},
                                 {"shape",
                                  {{"use", "box-parallelepiped"},
                                   {"length_m", 0.5},
                                   {"width_m", 0.5},
                                   {"height_m", 1.75}}}})};
         for (Trial& t : trials) {
           t.world = std::make_shared<World>(3, 12);
           t.finder = [](const std::string& name) -> std::optional<Subject> {
             if (name != "overlap") return std::nullopt;
             return subject_of<test::OverlapModality>();
           };
         }
         return trials;
       }},
      // associators
      {"gnn",
       [](const fs::path&) {
         return std::vector<Trial>{Trial(), trial("keep", {{"reentry", "keep"}}),
                                   trial("unsmoothed", {{"smoothing_s", 0.0}}),
                                   trial("at once", {{"confirm", 1}, {"coast_s", 0.0}})};
       }},
      // evaluators
      {"detection-scores", [](const fs::path&) { return from_the_start_and_later(); }},
      {"tracking-scores", [](const fs::path&) { return from_the_start_and_later(); }},
      {"ground-scores", [](const fs::path&) { return from_the_start_and_later(); }},
      {"detection-errors",
       [](const fs::path&) {
         return std::vector<Trial>{
             Trial(), trial("occluders of its own",
                            {{"occluders", {{"view1", {{{0, 0}, {100, 0}, {100, 200}}}}}}})};
       }},
      {"reliability", [](const fs::path&) { return defaults(); }},
      // sinks and renderers
      {"error-pictures", [](const fs::path&) { return defaults(); }},
      {"reliability-diagram", [](const fs::path&) { return defaults(); }},
      {"overlay-video", [](const fs::path&) { return defaults(); }},
      {"evidence-pictures",
       [](const fs::path&) {
         return std::vector<Trial>{
             trial("two frames",
                   {{"frames", {3, 1}}, {"evidence", {{{"from", "edges"}}, {{"from", "color"}}}}})};
       }},
      {"occluder-map", [](const fs::path&) { return defaults(); }},
      {"image-data-set",
       [](const fs::path&) {
         return std::vector<Trial>{Trial(),
                                   trial("jpeg", {{"format", "jpeg"}, {"people_free", 2}})};
       }},
      {"summary", [](const fs::path&) { return defaults(); }},
  };
  return kTable;
}

}  // namespace

std::vector<Trial> trials_of(const std::string& component, const fs::path& files) {
  const auto it = table().find(component);
  return it == table().end() ? std::vector<Trial>() : it->second(files);
}

}  // namespace plaza::contract
