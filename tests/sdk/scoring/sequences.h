#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "plaza/scoring/paired_sequence.h"

namespace plaza::testing_support {

using Ids = std::vector<std::int64_t>;

struct FrameOf {
  Ids truth;
  Ids result;
  Eigen::MatrixXd values;
};

inline Eigen::MatrixXd matrix(std::initializer_list<std::initializer_list<double>> rows) {
  return Eigen::MatrixXd(rows);
}

/// Frames 1, 2, ...
inline PairedSequence sequence_of(const std::vector<FrameOf>& frames) {
  PairedSequenceBuilder builder;
  std::int64_t number = 0;
  for (const FrameOf& frame : frames)
    builder.add(++number, frame.truth, frame.result, frame.values);
  return builder.build();
}

/// One true person 1 in every frame; result ids as given, 0: none. Similarity 1.
inline PairedSequence follow_one(const std::vector<std::int64_t>& ids) {
  std::vector<FrameOf> frames;
  for (const std::int64_t id : ids) {
    if (id == 0) {
      frames.push_back({{1}, {}, Eigen::MatrixXd(1, 0)});
    } else {
      frames.push_back({{1}, {id}, Eigen::MatrixXd::Ones(1, 1)});
    }
  }
  return sequence_of(frames);
}

}  // namespace plaza::testing_support
