#pragma once

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "plaza/core/export.h"

namespace plaza {

/// What a describer found out about an observation or a tracklet (a colour histogram, an
/// orientation). A feature type F names itself in `static constexpr std::string_view kFeature`.
class PLAZA_API Feature {
 public:
  virtual ~Feature();
  virtual std::string_view name() const noexcept = 0;
};

template <class F>
class FeatureOf : public Feature {
 public:
  std::string_view name() const noexcept final { return F::kFeature; }
};

/// Features by type; copies share them. At most one of a type: setting again replaces.
class PLAZA_API FeatureSet {
 public:
  template <class F>
  const F* get() const {
    return static_cast<const F*>(find(F::kFeature));
  }
  void set(std::shared_ptr<const Feature> feature);
  bool empty() const { return features_.empty(); }
  std::size_t size() const { return features_.size(); }

 private:
  const Feature* find(std::string_view name) const;
  std::vector<std::shared_ptr<const Feature>> features_;
};

}  // namespace plaza
