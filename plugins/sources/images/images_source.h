#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plugins/sources/images/image_series.h"

namespace plaza::sources {

/// Numbered image files, one series per camera; frame k of the run is number first + k * step.
///
/// A number that a camera has no file for is a missing view in that frame. The run ends with the
/// highest number of any camera.
class ImagesSource final : public Source {
 public:
  enum class Damaged { kError, kMissing };

  struct Options {
    std::map<std::string, std::filesystem::path> pattern;
    std::map<std::string, std::filesystem::path> people_free;
    std::vector<std::string> missing_cameras;
    std::optional<std::int64_t> first;
    std::int64_t step = 1;
    Damaged damaged = Damaged::kError;
  };

  static Declaration<Options> declare();
  ImagesSource(const Options& options, const BuildContext& context);

 protected:
  Diagnostics do_check() const override;
  SourceInfo do_open() override;
  void do_seek(std::int64_t frame) override;
  bool do_read(NodeIo& io) override;
  std::shared_ptr<const FrameSet> do_background(std::int64_t index) override;
  std::string do_content_key() const override;

 private:
  /// The number of frame 0, and how many frames there are.
  struct Numbering {
    std::int64_t first = 0;
    std::int64_t frames = 0;
  };
  Numbering number_frames(const std::vector<ImageSeries>& series) const;
  /// What is wrong with the first image from number `from` on, or nothing.
  std::string first_image_fault(const Camera& camera, const ImageSeries& series,
                                std::int64_t from) const;
  cv::Mat read_view(std::size_t camera, std::int64_t frame) const;
  /// Reads one file of a camera; empty when it is damaged and may be. `what` begins messages.
  cv::Mat read_file(std::size_t camera, const std::filesystem::path& file,
                    const std::string& what) const;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  std::vector<ImageSeries> series_;       // by camera of the scene; empty where it has no pattern
  std::vector<ImageSeries> people_free_;  // likewise
  std::vector<std::int64_t> people_free_numbers_;  // that any camera has, rising
  Numbering numbering_;
};

}  // namespace plaza::sources
