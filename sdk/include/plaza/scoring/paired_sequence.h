#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "plaza/core/export.h"

namespace plaza {

/// One frame of truth and result, and how well each fits each.
struct PairedFrame {
  std::int64_t frame = 0;
  std::vector<int>
      truth;  ///< dense identities, [0, PairedSequence::truth_identities), each at most once
  std::vector<int> result;  ///< dense identities, [0, PairedSequence::result_identities)
  /// truth x result. Similarities lie in [0, 1]; distances are >= 0, +infinity for pairs that can't
  /// be.
  Eigen::MatrixXd values;
};

/// A whole sequence, as the scorers take it: by rising frame, in each frame in the order of the
/// files (which decides between equal matches). Frames in which nobody is need not be listed.
struct PairedSequence {
  std::vector<PairedFrame> frames;
  int truth_identities = 0;
  int result_identities = 0;
  std::int64_t truth_count = 0;   ///< people, summed over the frames
  std::int64_t result_count = 0;  ///< the same of the result
};

/// Collects frames under the identities that files and trackers use, and numbers these densely, by
/// rising identity.
class PLAZA_API PairedSequenceBuilder {
 public:
  /// `values` is truth x result; frames come by rising number. Throws std::invalid_argument where
  /// the sizes differ, frames do not rise or an identity is in one frame twice.
  void add(std::int64_t frame, std::span<const std::int64_t> truth,
           std::span<const std::int64_t> result, Eigen::MatrixXd values);

  PairedSequence build() const;

 private:
  struct Frame {
    std::int64_t frame = 0;
    std::vector<std::int64_t> truth;
    std::vector<std::int64_t> result;
    Eigen::MatrixXd values;
  };
  std::vector<Frame> frames_;
};

/// 1 - distance / zero_distance, and 0 beyond: TrackEval's similarity of points.
PLAZA_API PairedSequence similarity_from_distance(const PairedSequence& distance,
                                                  double zero_distance);

}  // namespace plaza
