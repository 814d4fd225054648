#pragma once

#include <cstdint>
#include <string>

#include "plaza/data/ground_truth.h"
#include "plaza/data/observation.h"
#include "plaza/geometry/scene.h"
#include "plaza/scoring/detection_errors.h"

namespace plaza::error_pictures {

/// A view and a box in it: where an error is seen best.
struct BestView {
  std::size_t camera = 0;
  Box box;
};

/// First line of the table.
std::string table_header();
/// A miss as a line; frames from 1. Without a view the box is empty.
std::string table_row(std::int64_t frame, const Miss& miss, const TruePerson& person,
                      const BestView* view, const Scene& scene);
/// A false alarm; `person` is whom it belongs to, or null.
std::string table_row(std::int64_t frame, const FalseAlarm& alarm, const Observation& observation,
                      const TruePerson* person, const BestView* view, const Scene& scene);

}  // namespace plaza::error_pictures
