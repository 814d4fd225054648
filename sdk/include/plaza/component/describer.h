#pragma once

#include "plaza/component/node.h"
#include "plaza/data/observation.h"

namespace plaza {

/// Adds features or a heading to observations; never adds, drops, moves or reorders them.
/// Node ports: in 0 Observations, further inputs as declared; out 0 Observations.
class PLAZA_API Describer : public Node {
 public:
  ~Describer() override;
  Observations describe(const NodeIo& io);

 protected:
  /// `observations` is a copy to be written to.
  virtual void do_describe(const NodeIo& io, Observations& observations) = 0;

 private:
  void do_process(NodeIo& io) final;
};

}  // namespace plaza
