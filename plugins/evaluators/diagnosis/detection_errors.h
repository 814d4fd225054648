#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "plaza/component/declaration.h"
#include "plaza/scoring/detection_errors.h"

namespace plaza::diagnosis {

/// Counts misses and false alarms by kind. Pictures of them are a sink's.
class DetectionErrors final : public Evaluator {
 public:
  struct Options : ErrorRules {};
  static Declaration<Options> declare();
  DetectionErrors(const Options& options, const BuildContext& context);

 private:
  void do_observe(const NodeIo& io) override;
  Evaluation do_evaluate() override;

  Options options_;
  ErrorSorter sorter_;
  std::array<std::int64_t, kStandings> people_{}, missed_people_{};  ///< by Standing
  std::array<std::int64_t, kMissKinds> misses_{};
  std::array<std::int64_t, kAlarmKinds> alarms_{};
};

}  // namespace plaza::diagnosis
