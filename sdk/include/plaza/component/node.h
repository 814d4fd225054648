#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "plaza/component/component.h"
#include "plaza/core/error.h"
#include "plaza/data/payload.h"

namespace plaza {

class Learner;

/// One node's view of one frame: its inputs (by position in the declaration, input lists following)
/// and its outputs. Lives on the kernel's stack for the time of a call.
class PLAZA_API NodeIo {
 public:
  /// `slots` holds the payloads of all nodes in this frame; `inputs` and `outputs` index into it,
  /// an input of -1 is not connected.
  NodeIo(std::int64_t frame, std::int64_t time_ns, PayloadPtr* slots, std::span<const int> inputs,
         std::span<const int> outputs)
      : frame_(frame), time_ns_(time_ns), slots_(slots), inputs_(inputs), outputs_(outputs) {}

  std::int64_t frame() const { return frame_; }      ///< from 0
  std::int64_t time_ns() const { return time_ns_; }  ///< from the first frame

  std::size_t input_count() const { return inputs_.size(); }
  std::size_t output_count() const { return outputs_.size(); }
  /// Type of a connected input that was emitted.
  std::string_view port(std::size_t input) const { return slots_[inputs_[input]]->port(); }

  bool has(std::size_t input) const {
    return input < inputs_.size() && inputs_[input] >= 0 && slots_[inputs_[input]] != nullptr;
  }
  /// A connected input; throws InternalError when it is missing or of another type.
  template <class T>
  const T& in(std::size_t input) const {
    return static_cast<const T&>(*checked(input, T::kPort));
  }
  /// An optional input; null when not connected.
  template <class T>
  const T* find(std::size_t input) const {
    return has(input) ? &in<T>(input) : nullptr;
  }
  template <class T>
  std::shared_ptr<const T> share(std::size_t input) const {
    return std::static_pointer_cast<const T>(checked(input, T::kPort));
  }
  /// Emits a payload; once per output and frame.
  void out(std::size_t output, PayloadPtr payload);

 private:
  const PayloadPtr& checked(std::size_t input, std::string_view port) const;

  std::int64_t frame_;
  std::int64_t time_ns_;
  PayloadPtr* slots_;
  std::span<const int> inputs_;
  std::span<const int> outputs_;
};

/// One entry of a pipeline's "nodes". Plugins derive from the kinds below it (Source, Modality,
/// Detector, Describer, Associator, Evaluator, Sink, Renderer), not from Node itself.
class PLAZA_API Node : public Component {
 public:
  ~Node() override;

  /// Works on one frame. Nodes without memory are called concurrently for different frames; nodes
  /// with memory are called for every frame in order (see ComponentDeclaration::memory).
  void process(NodeIo& io) { do_process(io); }
  /// After the last frame, once, in pipeline order: nodes with memory emit what they still hold.
  /// io.frame() is one past the last frame.
  void flush(NodeIo& io) { do_flush(io); }
  /// Not null when the node has something to learn before the stream starts.
  virtual Learner* learner();

 protected:
  virtual void do_process(NodeIo& io) = 0;
  virtual void do_flush(NodeIo& io);
};

}  // namespace plaza
