#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/io/output_file.h"
#include "plaza/scoring/detection_errors.h"
#include "plugins/sinks/error-pictures/episodes.h"
#include "plugins/sinks/error-pictures/error_table.h"

namespace plaza::error_pictures {

/// A table of all misses and false alarms by kind, and a sheet with pictures of the longest
/// episodes of each kind.
class ErrorPictures final : public Sink {
 public:
  struct Options : ErrorRules {
    int per_kind = 6;
  };
  static Declaration<Options> declare();
  ErrorPictures(const Options& options, const BuildContext& context);

 private:
  void do_write(const NodeIo& io) override;
  void do_write_rest(const NodeIo&) override {}
  std::vector<Artifact> do_finish(bool complete) override;

  struct Scenery;  ///< what is in one frame
  void file_miss(const Scenery& scenery, const Miss& miss);
  void file_alarm(const Scenery& scenery, const FalseAlarm& alarm);
  std::string view_name(std::size_t camera) const;
  OutputFile& table();
  void write_sheet(const std::filesystem::path& file) const;

  Options options_;
  std::string name_;
  std::shared_ptr<const Scene> scene_;
  std::filesystem::path folder_;
  ErrorSorter sorter_;
  std::optional<OutputFile> table_;
  std::vector<EpisodeBook> misses_, alarms_;  ///< by kind
};

}  // namespace plaza::error_pictures
