#pragma once

#include <gtest/gtest.h>

#include "plaza/contract/contract.h"

namespace plaza::contract {

/// Adds one GoogleTest failure per violation:
///
///   TEST(MyDetectorTest, KeepsTheContract) {
///     plaza::contract::expect_kept(plaza::contract::subject_of<MyDetector>());
///   }
inline void expect_kept(const Subject& subject, const Trial& trial = {}) {
  for (const std::string& violation : violations(subject, trial)) {
    ADD_FAILURE() << subject.declaration.kind << " \"" << subject.declaration.name << "\" ("
                  << trial.label << "): " << violation;
  }
}

}  // namespace plaza::contract
