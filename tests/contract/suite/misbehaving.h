#pragma once

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "plaza/contract/contract.h"

namespace plaza::contract {

/// Options of the components in these tests: which promise to break. "" keeps all.
struct Fault {
  std::string fault;
};

inline Parameters<Fault> fault_parameter() {
  Parameters<Fault> p;
  p.value("fault", &Fault::fault).meaning("the promise to break");
  return p;
}

template <class C>
std::vector<std::string> with_fault(const std::string& fault) {
  Trial trial;
  trial.label = fault;
  trial.values = {{"fault", fault}};
  return violations(subject_of<C>(), trial);
}

struct FaultCase {
  const char* fault;
  const char* words;  ///< part of the violation that must be reported
};

/// Without a fault nothing is found; each fault is.
template <class C>
void expect_caught(const std::vector<FaultCase>& cases) {
  EXPECT_THAT(with_fault<C>(""), testing::IsEmpty());
  for (const FaultCase& c : cases) {
    EXPECT_THAT(with_fault<C>(c.fault), testing::Contains(testing::HasSubstr(c.words))) << c.fault;
  }
}

}  // namespace plaza::contract
