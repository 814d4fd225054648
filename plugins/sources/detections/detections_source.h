#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/data/detections.h"

namespace plaza::sources {

/// Detections of someone else's detector, one MOTChallenge file per camera, frames from 1.
///
/// As the first source of a pipeline it gives Frames too, with all views missing, and ends after
/// the highest frame in any file (or "frames"). Further down it only adds Detections; a frame
/// without rows has none.
class DetectionsSource final : public Source {
 public:
  struct Options {
    std::map<std::string, std::filesystem::path> files;
    std::vector<std::string> missing_cameras;
    std::optional<double> min_score;
    std::optional<std::int64_t> frames;
  };

  static Declaration<Options> declare();
  DetectionsSource(const Options& options, const BuildContext& context);

 protected:
  Diagnostics do_check() const override;
  SourceInfo do_open() override;
  void do_seek(std::int64_t frame) override;
  bool do_read(NodeIo& io) override;
  std::string do_content_key() const override;

 private:
  /// Detections of one camera by frame (from 0), in the order of the file.
  using ByFrame = std::map<std::int64_t, std::vector<ImageDetection>>;
  struct Loaded {
    std::vector<ByFrame> views;  // by camera of the scene
    std::int64_t frames = 0;
    Diagnostics faults;
  };
  Loaded load() const;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  Loaded loaded_;
};

}  // namespace plaza::sources
