#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/component/parameter.h"
#include "plaza/core/export.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/geometry/scene.h"

// Why a detector was wrong: each miss and each false alarm of a frame is of one kind. The idea is
// that of D. Hoiem, Y. Chodpathumwan, Q. Dai, "Diagnosing error in object detectors" (ECCV 2012),
// and D. Bolya et al., "TIDE" (ECCV 2020); the kinds are those of people seen by calibrated
// cameras.

namespace plaza {

/// In what position a true person is to be found, in the order in which it is decided: the first
/// that holds.
enum class Standing {
  kBehindOccluder,  ///< static occluders cover much of the boxes
  kBehindPeople,    ///< boxes of people nearer to the camera do
  kAtBorder,        ///< much of the boxes is outside of the images, or the area ends nearby
  kNearAnother,     ///< another true person stands close: two may be taken for one
  kHidden,          ///< the truth says that much is hidden, by what nobody described
  kInSight,         ///< none of these
};
inline constexpr std::size_t kStandings = 6;
PLAZA_API std::string_view to_string(Standing standing);  ///< "behind_occluder", ...

/// Misses are of their person's standing; those in sight are displaced or unexplained.
enum class MissKind {
  kBehindOccluder,
  kBehindPeople,
  kAtBorder,
  kNearAnother,
  kHidden,
  kDisplaced,    ///< in sight, and a false alarm is paired with it: found, at a wrong place
  kUnexplained,  ///< in sight, and nothing there
};
inline constexpr std::size_t kMissKinds = 7;
PLAZA_API std::string_view to_string(MissKind kind);

/// In the order in which it is decided.
enum class AlarmKind {
  kDisplaced,    ///< paired with a miss, of whatever kind
  kDuplicate,    ///< where somebody was found already
  kAtBorder,     ///< the area, and with it the annotation, ends nearby
  kGhost,        ///< on a line of sight to people, in every view that would show it
  kUnexplained,  ///< none of these
};
inline constexpr std::size_t kAlarmKinds = 5;
PLAZA_API std::string_view to_string(AlarmKind kind);

/// Where the kinds end. Parameters of whoever sorts errors, by declare_error_rules().
struct ErrorRules {
  double overlap = 0.3;
  double hidden_share = 0.3;
  double cut_share = 0.2;
  double border_m = 0.3;
  double near_m = 0.6;
  double displaced_m = 1.0;
  double displaced_overlap = 0.2;
  double sight_share = 0.25;
  /// Camera -> polygons -> corners -> (x, y), pixels. Empty: the scene's occluders.
  std::map<std::string, std::vector<std::vector<std::vector<double>>>> occluders;
};

/// A true person who counts, and how hard he is to find. Shares are of the area of his boxes, means
/// over the views in which the truth has one; [0, 1].
struct PersonSight {
  std::size_t person = 0;      ///< index into GroundTruth::people
  double behind_occluder = 0;  ///< covered by static occluders
  double behind_people = 0;    ///< covered by boxes of people who stand nearer to the camera
  double cut = 0;              ///< outside of the image
  double hidden = 0;           ///< 1 - visibility, as the truth says
  double border_m = std::numeric_limits<double>::infinity();   ///< to the border of the area
  double nearest_m = std::numeric_limits<double>::infinity();  ///< to the next true person
  /// The true one; without it where the boxes' lower edges stand on the ground, mean over views.
  std::optional<Eigen::Vector2d> position_m;
  Standing standing = Standing::kInSight;
};

struct Miss {
  PersonSight sight;
  MissKind kind = MissKind::kUnexplained;
  std::optional<std::size_t> alarm;  ///< the observation that is paired with it
};

struct FalseAlarm {
  std::size_t observation = 0;  ///< index into Observations::items
  AlarmKind kind = AlarmKind::kUnexplained;
  /// Whom it is paired with, repeats, or stands in line with (in its first view).
  std::optional<std::size_t> person;
};

struct FrameErrors {
  std::vector<PersonSight> people;  ///< all who count, found or not
  std::vector<Miss> misses;
  std::vector<FalseAlarm> alarms;
};

/// Sorts the errors of frames of one scene.
class PLAZA_API ErrorSorter {
 public:
  /// Throws UserError that names the faulty entry of parameter "occluders": a camera that the scene
  /// lacks, a polygon of less than three corners, a corner that is no pair of numbers.
  ErrorSorter(std::shared_ptr<const Scene> scene, const ErrorRules& rules);

  /// Matches are made as match_people() does; people without a box and frames that nobody annotated
  /// have no errors. Misses and alarms are paired one to one, as many as possible, nearest first in
  /// sum.
  FrameErrors sort(const GroundTruth& truth, const Observations& observations) const;

  /// Polygons that hide people in a view, pixels: [polygon][corner].
  const std::vector<std::vector<Eigen::Vector2d>>& occluders(std::size_t camera) const {
    return occluders_.at(camera);
  }

 private:
  std::vector<PersonSight> sights_of(const GroundTruth& truth) const;
  Standing standing_of(const PersonSight& sight) const;
  double border_distance_m(const Eigen::Vector2d& position_m) const;

  std::shared_ptr<const Scene> scene_;
  ErrorRules rules_;
  std::vector<std::vector<std::vector<Eigen::Vector2d>>> occluders_;  ///< [camera][polygon][corner]
};

/// Share of a box that polygons (even-odd rule) and boxes cover together, in [0, 1], found at the
/// centres of 24 x 48 equal cells of it.
PLAZA_API double covered_share(const Box& box,
                               std::span<const std::vector<Eigen::Vector2d>> polygons,
                               std::span<const Box> boxes);

/// Declares the parameters of ErrorRules for `Options`, which derives from it.
template <class Options>
void declare_error_rules(Parameters<Options>& p) {
  const auto real = [](double ErrorRules::*member) {
    return static_cast<double Options::*>(member);
  };
  p.value("overlap", real(&ErrorRules::overlap))
      .above(0)
      .at_most(1)
      .meaning("least overlap of a match, the mean over the views in which the true person counts")
      .source("thesis 3.3.2");
  p.value("hidden_share", real(&ErrorRules::hidden_share))
      .above(0)
      .at_most(1)
      .meaning(
          "least share of a person's boxes, mean over views, that hides him: behind occluders, "
          "behind people, or as the truth says");
  p.value("cut_share", real(&ErrorRules::cut_share))
      .above(0)
      .at_most(1)
      .meaning(
          "least share of a person's boxes, mean over views, outside of the images that is "
          "called at the border");
  p.value("border_m", real(&ErrorRules::border_m))
      .unit("m")
      .at_least(0)
      .meaning(
          "who stands nearer to the border of the area, within or outside, is at the border; "
          "false alarms too");
  p.value("near_m", real(&ErrorRules::near_m))
      .unit("m")
      .at_least(0)
      .meaning("people nearer to each other may be taken for one");
  p.value("displaced_m", real(&ErrorRules::displaced_m))
      .unit("m")
      .at_least(0)
      .meaning(
          "a false alarm at most this far from a miss is that person at a wrong place; as "
          "near to somebody who was found, a duplicate");
  p.value("displaced_overlap", real(&ErrorRules::displaced_overlap))
      .above(0)
      .at_most(1)
      .meaning("or with at least this overlap with the miss");
  p.value("sight_share", real(&ErrorRules::sight_share))
      .above(0)
      .at_most(1)
      .meaning(
          "a ghost's box shares at least this much of the smaller of both boxes with "
          "somebody's, in every view");
  p.value(
       "occluders",
       static_cast<std::map<std::string, std::vector<std::vector<std::vector<double>>>> Options::*>(
           &ErrorRules::occluders))
      .unit("px")
      .meaning(
          "polygons that hide people, by the camera's name: [[x, y], ...]; empty: the scene's. "
          "For runs whose scene lacks what others have");
}

}  // namespace plaza
