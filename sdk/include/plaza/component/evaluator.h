#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "plaza/component/node.h"

namespace plaza {

/// Sections of summary.json's "evaluation": section name -> object of settings and metrics. What
/// was not evaluated is absent, never zero.
using Evaluation = std::map<std::string, nlohmann::json>;

/// Compares results with ground truth. Sees every frame in order, then gives its figures once.
/// Its declaration lists the metrics (name, unit, which way is better). Inputs as declared.
class PLAZA_API Evaluator : public Node {
 public:
  ~Evaluator() override;
  /// After flush. Every metric must be declared, every number finite; else InternalError.
  Evaluation evaluate();

 protected:
  virtual void do_observe(const NodeIo& io) = 0;
  virtual Evaluation do_evaluate() = 0;

 private:
  void do_process(NodeIo& io) final;
  void do_flush(NodeIo& io) final;  // late tracks are observed, too
};

}  // namespace plaza
