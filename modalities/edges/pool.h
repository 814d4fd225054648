#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace plaza::edges {

/// Large objects that are used again instead of allocated again. Thread-safe; an object comes back
/// by itself when its handle dies, wherever that happens, even after the pool's owner has gone. It
/// keeps what it held. The pool grows to the largest number ever in use at once.
template <class T>
class Pool : public std::enable_shared_from_this<Pool<T>> {
 public:
  struct Return {
    std::shared_ptr<Pool> pool;
    void operator()(T* object) const { pool->put(std::unique_ptr<T>(object)); }
  };
  using Handle = std::unique_ptr<T, Return>;

  static std::shared_ptr<Pool> make() { return std::shared_ptr<Pool>(new Pool); }

  /// An object that nobody else uses; `create()` gives a std::unique_ptr<T> when there is none.
  template <class Create>
  Handle take(Create&& create) {
    std::unique_ptr<T> object;
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        object = std::move(free_.back());
        free_.pop_back();
      }
    }
    if (!object) object = create();
    return Handle(object.release(), Return{this->shared_from_this()});
  }

  std::size_t free_count() const {
    const std::lock_guard lock(mutex_);
    return free_.size();
  }

 private:
  Pool() = default;
  void put(std::unique_ptr<T> object) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(object));
  }

  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<T>> free_;
};

}  // namespace plaza::edges
