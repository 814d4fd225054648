#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plaza/core/diagnostic.h"
#include "plaza/data/ground_truth.h"
#include "plaza/geometry/scene.h"
#include "plaza/io/mot_rows.h"

namespace plaza::sources {

/// Which frames somebody looked at.
struct Annotation {
  std::int64_t every = 1;    ///< every n-th frame, in step with the first one that has rows
  bool interpolate = false;  ///< frames between two of them are filled in
  std::optional<std::int64_t>
      frames;  ///< length of the annotation; not set: to the last frame with rows
};

/// True people by frame and identity, put together from rows of several files.
class TruthTable {
 public:
  explicit TruthTable(const Annotation& annotation) : annotation_(annotation) {}

  /// Boxes of one view; cameras by rising index. Rows with confidence 0 or of another class than
  /// pedestrian (1) do not count; a person seen by several views stands at the mean of the
  /// positions their rows give. Adds faults: rows without identity.
  void add_boxes(std::size_t camera, const std::vector<MotRow>& rows, const std::string& file,
                 Diagnostics& faults);
  /// Positions and headings, which go before those of box rows. Adds faults: rows without identity.
  void add_ground(const std::vector<GroundRow>& rows, const std::string& file, Diagnostics& faults);
  /// After the last add: finds the annotated frames. Adds a fault per file for rows in other
  /// frames.
  void finish(Diagnostics& faults);

  /// Number of frames up to the last annotated one.
  std::int64_t frames() const { return frames_; }
  bool annotated(std::int64_t frame) const;
  /// The truth of a frame (from 0); not annotated and empty where annotated() says so.
  GroundTruth at(std::int64_t frame) const;

 private:
  struct Draft {
    TruePerson person;
    Eigen::Vector2d position_sum_m = Eigen::Vector2d::Zero();
    int positions = 0;
  };
  using People = std::map<std::int64_t, Draft>;  // by identity
  const People* people(std::int64_t frame) const;
  GroundTruth between(std::int64_t before, std::int64_t frame) const;

  Annotation annotation_;
  std::map<std::int64_t, People> by_frame_;
  std::map<std::string, std::map<std::int64_t, int>> first_lines_;  // file -> frame -> line
  std::int64_t phase_ = 0;
  std::int64_t frames_ = 0;
};

}  // namespace plaza::sources
