#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plaza/core/export.h"

namespace plaza {

/// What a describer found out about an observation or a tracklet (a colour histogram, an
/// orientation). A feature type F names itself in `static constexpr std::string_view kFeature`,
/// which is unique among all plugins.
///
/// Features that can be written as bytes outlive their run: they override do_save(), and F has
///
///   static std::shared_ptr<const F> load(std::string_view bytes);
///
/// which gives a feature that compares with any other exactly as the saved one did, and throws
/// Error for bytes that are none. The component that gives features says so in its declaration
/// (Declaration::feature<F>()), which is where the kernel finds load(). Bytes are only ever read by
/// the build of the plugin that wrote them, on the same kind of machine: they need no version.
class PLAZA_API Feature {
 public:
  virtual ~Feature();
  virtual std::string_view name() const noexcept = 0;
  /// Nothing: it can't be kept, and what carries it is computed in every run. Thread-safe.
  std::optional<std::string> save() const { return do_save(); }

 protected:
  virtual std::optional<std::string> do_save() const;
};

template <class F>
class FeatureOf : public Feature {
 public:
  std::string_view name() const noexcept final { return F::kFeature; }
};

/// A type of features that a component gives.
struct FeatureSpec {
  std::string name;     ///< F::kFeature
  std::string meaning;  ///< one line
  /// F::load(); null where F has none.
  std::shared_ptr<const Feature> (*load)(std::string_view bytes) = nullptr;
};

template <class F>
FeatureSpec feature_spec(std::string meaning) {
  FeatureSpec spec;
  spec.name = F::kFeature;
  spec.meaning = std::move(meaning);
  if constexpr (requires(std::string_view bytes) { F::load(bytes); }) {
    spec.load = [](std::string_view bytes) -> std::shared_ptr<const Feature> {
      return F::load(bytes);
    };
  }
  return spec;
}

/// Features by type; copies share them. At most one of a type: setting again replaces.
class PLAZA_API FeatureSet {
 public:
  template <class F>
  const F* get() const {
    return static_cast<const F*>(find(F::kFeature));
  }
  /// `feature` is not null.
  void set(std::shared_ptr<const Feature> feature);
  bool empty() const { return features_.empty(); }
  std::size_t size() const { return features_.size(); }
  /// In the order in which their types were first set; none is null.
  const std::vector<std::shared_ptr<const Feature>>& all() const { return features_; }

 private:
  const Feature* find(std::string_view name) const;
  std::vector<std::shared_ptr<const Feature>> features_;
};

}  // namespace plaza
