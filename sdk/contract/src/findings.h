#pragma once

#include <algorithm>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace plaza::contract {

/// Collects violations. One kind of violation is reported once, however often it happens.
class Findings {
 public:
  void add(std::string text) {
    if (std::find(texts_.begin(), texts_.end(), text) == texts_.end())
      texts_.push_back(std::move(text));
  }
  void require(bool holds, const char* otherwise) {
    if (!holds) add(otherwise);
  }
  /// Runs a step that must not throw; false when it did.
  template <class F>
  bool step(const std::string& what, F&& body) {
    try {
      body();
      return true;
    } catch (const std::exception& error) {
      add(what + " threw: " + error.what());
    } catch (...) {
      add(what + " threw something that is no std::exception");
    }
    return false;
  }
  /// Runs a step that must throw E.
  template <class E, class F>
  void must_throw(const std::string& what, const std::string& wanted, F&& body) {
    try {
      body();
      add(what + " must throw " + wanted);
    } catch (const E&) {
    } catch (const std::exception& error) {
      add(what + " must throw " + wanted + ", threw: " + error.what());
    }
  }
  std::vector<std::string> take() { return std::move(texts_); }

 private:
  std::vector<std::string> texts_;
};

}  // namespace plaza::contract
