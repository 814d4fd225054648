#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "plaza/core/export.h"
#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/geometry/scene.h"
#include "plaza/scoring/paired_sequence.h"

namespace plaza {

/// A person of the result as all views show him.
struct ResultPerson {
  std::int64_t id = 0;
  std::vector<std::optional<Box>> boxes;  ///< [camera of the scene]; nothing where he can't be seen
};

/// Boxes of a person standing at `position_m` in every view: the measured one where there is one,
/// else that of the scene's body; nothing where that is behind the camera.
PLAZA_API std::vector<std::optional<Box>> boxes_in_views(const Scene& scene,
                                                         const Eigen::Vector2d& position_m,
                                                         std::span<const ViewBox> measured);

/// How well a result fits a true person over several views: the mean overlap over the views in
/// which the person counts (kCountingVisibility); a view in which the result has no box overlaps by
/// 0. For a person who counts nowhere: over all views that have a true box.
PLAZA_API double view_overlap(const TruePerson& person, const ResultPerson& result);

/// Who of a frame was found by which result.
struct PeopleMatch {
  std::vector<bool> counts;    ///< [person of the truth]: is to be found, counts in some view
  std::vector<int> result_of;  ///< [person of the truth]; -1: none
  std::vector<int> person_of;  ///< [result]; -1: none
};

/// Matches one frame as add_people() and score_overlap_detection() do: of the people who count, an
/// assignment of largest sum of similarities at `overlap` or more. A result that belongs to one who
/// doesn't count is matched with that one, and right or wrong for nobody.
PLAZA_API PeopleMatch match_people(const GroundTruth& truth, std::span<const ResultPerson> results,
                                   double overlap);

/// Adds one frame to a comparison by boxes: one similarity per true person and result, over all
/// views.
///
/// People who count in no view are neither to be found nor forbidden: results that belong to one of
/// them (in one assignment over all people, at `overlap` or more) are left out, as MOTChallenge
/// does with distractors. People without any box take no part.
PLAZA_API void add_people(PairedSequenceBuilder& builder, std::int64_t frame,
                          const GroundTruth& truth, std::span<const ResultPerson> results,
                          double overlap);

}  // namespace plaza
