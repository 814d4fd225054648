#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plugins/sinks/summary/statistics.h"

namespace plaza::summary {

/// A page for people: who was there, when and where, and a plan with every trajectory.
class Summary final : public Sink {
 public:
  struct Options {
    std::string file = "summary.md";
    std::string plan = "plan.png";
    int plan_width_px = 1200;
  };
  static Declaration<Options> declare();
  Summary(const Options& options, const BuildContext& context);

 private:
  Diagnostics do_check() const override;
  void do_write(const NodeIo& io) override;
  void do_write_rest(const NodeIo& io) override;
  std::vector<Artifact> do_finish(bool complete) override;

  void take_tracks(const NodeIo& io);
  std::string page(const Trajectories& people, bool complete) const;

  Options options_;
  std::shared_ptr<const Scene> scene_;
  std::filesystem::path folder_;
  std::map<TrackId, std::map<std::int64_t, TrackPoint>>
      points_;  ///< final ones; they may come late
  bool any_frame_ = false;
  std::int64_t begin_frame_ = 0, end_frame_ = 0;  ///< seen: [begin, end)
  std::vector<std::int64_t> observations_;        ///< per frame, when they are connected
};

}  // namespace plaza::summary
