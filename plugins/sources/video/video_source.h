#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plugins/sources/video/video_file.h"

namespace plaza::sources {

/// One video file per camera.
///
/// Frame k of the run is frame k of every file. The rates in the headers are not believed, since
/// recorders write them wrongly (PETS says 10 Hz and is 7 Hz): the scene's rate holds, unless
/// "frame_rate_hz" says that the files have a higher one. Then frame k is the file's frame nearest
/// to its time.
class VideoSource final : public Source {
 public:
  enum class Uneven { kShortest, kMissing };
  enum class Truncated { kError, kEnd };

  struct Options {
    std::map<std::string, std::filesystem::path> files;
    std::vector<std::string> missing_cameras;
    std::optional<double> frame_rate_hz;
    Uneven uneven = Uneven::kShortest;
    Truncated truncated = Truncated::kError;
  };

  static Declaration<Options> declare();
  VideoSource(const Options& options, const BuildContext& context);

 protected:
  Diagnostics do_check() const override;
  SourceInfo do_open() override;
  void do_seek(std::int64_t frame) override;
  bool do_read(NodeIo& io) override;
  std::string do_content_key() const override;
  std::vector<std::string> do_notes() const override;

 private:
  std::int64_t file_frame(std::int64_t frame) const;
  std::int64_t run_frames(std::int64_t file_frames) const;
  /// Throws UserError when a video ended well before its header says.
  void check_end(const VideoFile& video) const;
  /// Is the run over when the videos of those cameras are?
  bool at_end(const std::vector<char>& ended) const;
  void note_uneven_end(const std::vector<char>& ended, std::int64_t frames);
  cv::Mat read_view(std::size_t camera, std::int64_t frame, char& ended) const;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  std::vector<std::unique_ptr<VideoFile>>
      videos_;              // by camera of the scene; null where it has none
  std::string uneven_end_;  // for the run's report; empty: none was met
};

}  // namespace plaza::sources
