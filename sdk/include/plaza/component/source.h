#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/node.h"
#include "plaza/data/frames.h"

namespace plaza {

struct SourceInfo {
  /// How many frames are expected, for progress and early checks; nothing: not known before the
  /// end. A video's header may be wrong by a few: only read() says where the end is.
  std::optional<std::int64_t> frame_count;
  bool rereadable = true;  ///< false: a live source, seek() works only once, to 0
  /// How many images of the empty place the source has besides its frames; see background().
  std::int64_t background_count = 0;
};

/// What a source is in its pipeline.
enum class SourceRole {
  kClock,     ///< the first source: the run ends where it ends, and it alone gives Frames
  kFollower,  ///< a further source: gives no Frames and never ends; beyond its data it says
              ///< "nothing here"
};

/// Gives payloads frame by frame. The first source of a pipeline is its clock: the run ends where
/// it ends, and it alone gives Frames. Further sources (given detections, ground truth) are read at
/// the same frame and add what else they give.
class PLAZA_API Source : public Node {
 public:
  ~Source() override;

  /// Opens files and devices; before the first read. Opening again starts again at frame 0.
  SourceInfo open(SourceRole role = SourceRole::kClock);
  /// Makes `frame` the next one to be read. Throws UserError when it is beyond the end.
  void seek(std::int64_t frame);
  /// Emits the payloads of frame io.frame(), which is the next one in order, and returns true;
  /// returns false, having emitted nothing, at the end. Throws UserError naming camera and remedy
  /// when the data stop half-way or do not fit the scene.
  bool read(NodeIo& io);

 protected:
  SourceRole role() const { return role_; }

  virtual SourceInfo do_open() = 0;
  virtual void do_seek(std::int64_t frame) = 0;
  virtual bool do_read(NodeIo& io) = 0;
  /// True when the given frame is known to show no people.
  virtual bool do_people_free(std::int64_t frame) const;
  virtual std::shared_ptr<const FrameSet> do_background(std::int64_t index);
  virtual std::string do_content_key() const;
  virtual std::vector<std::string> do_notes() const;  ///< none, unless a source has its own

 public:
  bool people_free(std::int64_t frame) const { return do_people_free(frame); }
  /// The index-th of SourceInfo::background_count images of the place without people, taken at
  /// another time than the frames (recorded before anybody came in, or rendered): for those who
  /// learn from people-free frames, never part of a run. `frame` and `time_ns` of the set count
  /// from the first of them. In any order, after open(); does not change what read() gives next.
  /// Throws std::out_of_range for an index that was not announced, UserError when the data stop
  /// half-way.
  std::shared_ptr<const FrameSet> background(std::int64_t index);
  /// Text that changes when what the source reads from outside changes (its files with sizes and
  /// times of modification), for cache keys; parameters need not be in it. Works before open().
  std::string content_key() const { return do_content_key(); }
  /// What was met while reading that is no error, but that whoever reads the results should know:
  /// a sentence each, without the node's name, for the report at the run's end.
  std::vector<std::string> notes() const { return do_notes(); }

 private:
  void do_process(NodeIo& io) final;
  SourceRole role_ = SourceRole::kClock;
  bool open_ = false;
  std::int64_t next_ = 0;
  std::int64_t background_count_ = 0;
};

}  // namespace plaza
