#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace plaza::error_pictures {

/// Errors of one kind in frames that follow each other, of the same person or at the same place:
/// one situation, of which one picture is enough.
struct Episode {
  std::int64_t first_frame = 0, last_frame = 0;
  std::int64_t count = 0;  ///< frames with the error
  std::optional<std::int64_t> id;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< of the last one
  std::int64_t pictured_frame = 0;
  cv::Mat picture;           ///< from the later half of it
  std::string who, caption;  ///< of the picture
};

/// An error to be filed.
struct FiledError {
  std::int64_t frame = 0;
  std::optional<std::int64_t> id;  ///< whose; nobody's are told apart by their places
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
};

struct Pictured {
  cv::Mat picture;
  std::string who, caption;
};

/// The episodes of one kind of error. Memory is bounded by those under way and `most` others.
class EpisodeBook {
 public:
  /// An episode goes on when the next error comes at most `gap_frames` later, and within `reach_m`
  /// where it has no identity.
  EpisodeBook(std::size_t most, std::int64_t gap_frames, double reach_m)
      : most_(most), gap_frames_(gap_frames), reach_m_(reach_m) {}

  /// Frames must not fall. `draw` is called for some errors only: the first of an episode, and
  /// whenever its length has doubled.
  void add(const FiledError& error, const std::function<Pictured()>& draw);

  std::int64_t errors() const { return errors_; }
  std::int64_t episodes() const { return episodes_; }
  /// The longest ones, at most `most`, longest first, of equal ones the earlier.
  std::vector<Episode> longest() const;

 private:
  void close_before(std::int64_t frame);

  std::size_t most_;
  std::int64_t gap_frames_;
  double reach_m_;
  std::int64_t errors_ = 0, episodes_ = 0;
  std::vector<Episode> open_;
  std::vector<Episode> closed_;  ///< as longest() has them
};

}  // namespace plaza::error_pictures
