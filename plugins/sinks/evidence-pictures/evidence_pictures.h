#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plugins/sinks/drawing/contact_sheet.h"

namespace plaza::evidence_pictures {

/// Shows what modalities and detectors saw in some frames: the pictures of every view's evidence,
/// step by step, and the likelihood on the ground, each as a file of its own and all of a frame
/// together on a labelled sheet (thesis Figures 4.4-4.10).
class EvidencePictures final : public Sink {
 public:
  struct Options {
    std::vector<std::int64_t> frames = {1};
    int sheet_width_px = 1920;
    int columns = 4;
  };
  static Declaration<Options> declare();
  EvidencePictures(const Options& options, const BuildContext& context);

 private:
  void do_write(const NodeIo& io) override;
  void do_write_rest(const NodeIo&) override {}
  std::vector<Artifact> do_finish(bool complete) override;

  drawing::Section view_section(const NodeIo& io, std::size_t camera) const;
  drawing::Section surface_section(const NodeIo& io) const;
  void write_section(const drawing::Section& section, const std::filesystem::path& folder) const;

  Options options_;
  std::string name_;
  std::shared_ptr<const Scene> scene_;
  std::filesystem::path folder_;
  std::vector<InputReference> evidence_;
  std::set<std::int64_t> wanted_;  ///< frames from 0
  std::vector<Artifact> written_;
};

}  // namespace plaza::evidence_pictures
