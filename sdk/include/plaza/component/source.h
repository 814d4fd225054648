#pragma once

#include <cstdint>
#include <optional>

#include "plaza/component/node.h"

namespace plaza {

struct SourceInfo {
  std::optional<std::int64_t> frame_count;  ///< nothing: not known before the end
  bool rereadable = true;                   ///< false: a live source, seek() works only once, to 0
};

/// Gives payloads frame by frame. The first source of a pipeline is its clock: the run ends where it
/// ends, and it alone gives Frames. Further sources (given detections, ground truth) are read at the
/// same frame and add what else they give.
class PLAZA_API Source : public Node {
 public:
  ~Source() override;

  /// Opens files and devices; once, before the first read.
  SourceInfo open();
  /// Makes `frame` the next one to be read. Throws UserError when it is beyond the end.
  void seek(std::int64_t frame);
  /// Emits the payloads of frame io.frame(), which is the next one in order, and returns true; returns
  /// false, having emitted nothing, at the end. Throws UserError naming camera and remedy when the data
  /// stop half-way or do not fit the scene.
  bool read(NodeIo& io);

 protected:
  virtual SourceInfo do_open() = 0;
  virtual void do_seek(std::int64_t frame) = 0;
  virtual bool do_read(NodeIo& io) = 0;
  /// True when the given frame is known to show no people (synthetic worlds, recorded backgrounds).
  virtual bool do_people_free(std::int64_t frame) const;

 public:
  bool people_free(std::int64_t frame) const { return do_people_free(frame); }

 private:
  void do_process(NodeIo& io) final;
  bool open_ = false;
  std::int64_t next_ = 0;
};

}  // namespace plaza
