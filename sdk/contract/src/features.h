#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "findings.h"
#include "plaza/component/declaration.h"
#include "plaza/data/observation.h"
#include "stage.h"

namespace plaza::contract {

/// Features that come out of a component: declared, and the same after save() and load().
class FeatureCheck {
 public:
  FeatureCheck(const ComponentDeclaration& declaration, Findings& findings)
      : declaration_(&declaration), findings_(&findings) {}

  /// Of everything in the payload that carries features; those that also came in are not its own.
  void look_at(const Payload& given, const Payload* received);

 private:
  void check(const FeatureSet& features, const FeatureSet* received);
  void check(const Feature& feature);
  void check_load(const FeatureSpec& spec, const std::string& bytes);
  void check_damaged(const FeatureSpec& spec, std::string_view bytes);

  const ComponentDeclaration* declaration_;
  Findings* findings_;
  std::map<std::string, int, std::less<>> seen_;
};

/// What the trial's describers make of the world's observations, by frame, and what they say of
/// their features.
struct Described {
  std::vector<Observations> frames;
  std::vector<FeatureSpec> features;
};
Described describe_world(const Stage& stage, std::int64_t frames);

/// The observation with features that were saved and loaded where they can be.
Observation with_loaded_features(const Observation& observation,
                                 const std::vector<FeatureSpec>& features);

}  // namespace plaza::contract
