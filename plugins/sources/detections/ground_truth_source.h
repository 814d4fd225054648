#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "plaza/component/declaration.h"
#include "plugins/sources/detections/truth_table.h"

namespace plaza::sources {

/// True people from files: MOTChallenge rows per view, positions and headings on the ground, or
/// both.
///
/// Frames beyond the last annotated one are not annotated, nor are those between annotated ones
/// unless they are interpolated; both count for nothing in an evaluation.
class GroundTruthSource final : public Source {
 public:
  struct Options {
    std::map<std::string, std::filesystem::path> files;
    std::optional<std::filesystem::path> ground;
    std::int64_t every = 1;
    bool interpolate = false;
    std::optional<std::int64_t> frames;
    bool area_only = false;
  };

  static Declaration<Options> declare();
  GroundTruthSource(const Options& options, const BuildContext& context);

 protected:
  Diagnostics do_check() const override;
  SourceInfo do_open() override;
  void do_seek(std::int64_t frame) override;
  bool do_read(NodeIo& io) override;
  std::string do_content_key() const override;

 private:
  TruthTable load(Diagnostics& faults) const;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  TruthTable table_;
};

}  // namespace plaza::sources
