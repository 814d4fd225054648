#include "plaza/scoring/paired_sequence.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace plaza {
namespace {

bool repeats(std::vector<std::int64_t> identities) {
  std::sort(identities.begin(), identities.end());
  return std::adjacent_find(identities.begin(), identities.end()) != identities.end();
}

std::vector<std::int64_t> sorted_unique(std::vector<std::int64_t> identities) {
  std::sort(identities.begin(), identities.end());
  identities.erase(std::unique(identities.begin(), identities.end()), identities.end());
  return identities;
}

std::vector<int> numbered(const std::vector<std::int64_t>& identities,
                          const std::vector<std::int64_t>& known) {
  std::vector<int> out;
  out.reserve(identities.size());
  for (const std::int64_t id : identities) {
    out.push_back(
        static_cast<int>(std::lower_bound(known.begin(), known.end(), id) - known.begin()));
  }
  return out;
}

template <class Map>
PairedSequence mapped(PairedSequence sequence, const Map& map) {
  for (PairedFrame& frame : sequence.frames) frame.values = frame.values.unaryExpr(map).eval();
  return sequence;
}

}  // namespace

void PairedSequenceBuilder::add(std::int64_t frame, std::span<const std::int64_t> truth,
                                std::span<const std::int64_t> result, Eigen::MatrixXd values) {
  if (values.rows() != static_cast<Eigen::Index>(truth.size()) ||
      values.cols() != static_cast<Eigen::Index>(result.size())) {
    throw std::invalid_argument("values must be truth x result");
  }
  if (!frames_.empty() && frame <= frames_.back().frame) {
    throw std::invalid_argument("frames must be added by rising number");
  }
  Frame added{
      frame, {truth.begin(), truth.end()}, {result.begin(), result.end()}, std::move(values)};
  if (repeats(added.truth) || repeats(added.result)) {
    throw std::invalid_argument("an identity occurs twice in one frame");
  }
  frames_.push_back(std::move(added));
}

PairedSequence PairedSequenceBuilder::build() const {
  PairedSequence sequence;
  std::vector<std::int64_t> truth;
  std::vector<std::int64_t> result;
  for (const Frame& frame : frames_) {
    truth.insert(truth.end(), frame.truth.begin(), frame.truth.end());
    result.insert(result.end(), frame.result.begin(), frame.result.end());
  }
  sequence.truth_count = static_cast<std::int64_t>(truth.size());
  sequence.result_count = static_cast<std::int64_t>(result.size());
  truth = sorted_unique(std::move(truth));
  result = sorted_unique(std::move(result));
  sequence.truth_identities = static_cast<int>(truth.size());
  sequence.result_identities = static_cast<int>(result.size());
  sequence.frames.reserve(frames_.size());
  for (const Frame& frame : frames_) {
    sequence.frames.push_back({.frame = frame.frame,
                               .truth = numbered(frame.truth, truth),
                               .result = numbered(frame.result, result),
                               .values = frame.values});
  }
  return sequence;
}

PairedSequence similarity_from_distance(const PairedSequence& distance, double zero_distance) {
  if (!(zero_distance > 0)) throw std::invalid_argument("zero_distance must be positive");
  return mapped(distance, [=](double d) { return std::max(0.0, 1 - d / zero_distance); });
}

}  // namespace plaza
