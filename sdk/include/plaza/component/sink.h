#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plaza/component/node.h"

namespace plaza {

/// A file that a run leaves for people to look at.
struct Artifact {
  std::filesystem::path file;
  std::string what;  ///< "overlay video of all views"
};

/// Writes payloads to files while the stream runs. Inputs as declared.
class PLAZA_API Sink : public Node {
 public:
  ~Sink() override;
  /// After flush, or after a fault or interruption (`complete` false): closes files so that they
  /// are valid, and lists them.
  std::vector<Artifact> finish(bool complete) { return do_finish(complete); }

 protected:
  virtual void do_write(const NodeIo& io) = 0;
  /// What associators held back until the flush, which is no frame; io.frame() is one past the
  /// last.
  virtual void do_write_rest(const NodeIo& io) { do_write(io); }
  virtual std::vector<Artifact> do_finish(bool complete) = 0;

 private:
  void do_process(NodeIo& io) final;
  void do_flush(NodeIo& io) final;
};

}  // namespace plaza
