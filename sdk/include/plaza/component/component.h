#pragma once

#include <string>

#include "plaza/core/diagnostic.h"
#include "plaza/core/export.h"

namespace plaza {

/// Anything a plugin provides: nodes of a pipeline and the parts nested in them.
///
/// Constructors are cheap and touch no file: they take validated options and throw UserError when
/// options contradict each other. check() looks at the outside world.
class PLAZA_API Component {
 public:
  virtual ~Component();
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  /// Everything that would keep this component from working: missing or malformed files, cameras
  /// that the scene lacks. Called once, before anything is computed. A diagnostic's `pointer` is
  /// relative to the component ("/files/view1"); the kernel adds the place in the pipeline.
  Diagnostics check() const { return do_check(); }

 protected:
  Component() = default;
  virtual Diagnostics do_check() const;
};

}  // namespace plaza
