#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

/// What evidence remembers of the templates that it was compared with.
namespace plaza {

/// A number that no other batch of templates of this library has, or ever had.
class BatchSerial {
 public:
  std::uint64_t value() const { return value_; }

 private:
  static std::uint64_t next() {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
  }
  std::uint64_t value_ = next();
};

/// One value per template of a batch, kept when it is first computed. Thread-safe: whoever comes
/// while it is being kept computes it as well.
template <class Value>
class Memo {
 public:
  explicit Memo(std::size_t size) : entries_(size) {}

  bool knows(std::size_t index) const {
    return entries_[index].state.load(std::memory_order_acquire) == kKept;
  }
  /// Only what it knows.
  const Value& at(std::size_t index) const { return entries_[index].value; }
  void keep(std::size_t index, const Value& value) {
    Entry& entry = entries_[index];
    std::uint8_t state = kEmpty;
    if (!entry.state.compare_exchange_strong(state, kBusy, std::memory_order_relaxed)) return;
    entry.value = value;
    entry.state.store(kKept, std::memory_order_release);
  }

 private:
  enum : std::uint8_t { kEmpty, kBusy, kKept };
  struct Entry {
    std::atomic<std::uint8_t> state = kEmpty;
    Value value = {};
  };
  std::vector<Entry> entries_;
};

/// The memos of one evidence as it was prepared, by batch. All that is explained away leaves
/// templates elsewhere as they were, and a search asks for them again and again.
template <class Value>
class Memos {
 public:
  Memo<Value>& of(const BatchSerial& batch, std::size_t size) {
    const std::lock_guard lock(mutex_);
    for (auto& [serial, memo] : memos_) {
      if (serial == batch.value()) return *memo;
    }
    return *memos_.emplace_back(batch.value(), std::make_unique<Memo<Value>>(size)).second;
  }

 private:
  std::mutex mutex_;
  std::vector<std::pair<std::uint64_t, std::unique_ptr<Memo<Value>>>> memos_;
};

}  // namespace plaza
