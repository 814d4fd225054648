#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/json_document.h"
#include "plaza/core/diagnostic.h"

namespace plaza {

/// Reads one JSON object strictly: every fault goes to one list, with its position, and reading
/// goes on. A value that is missing or wrong is nothing; who asked for it leaves out what depends
/// on it.
class Fields {
 public:
  Fields(const JsonDocument& document, std::string pointer, Diagnostics& faults);

  bool is_object() const { return object_ != nullptr; }
  bool has(std::string_view key) const;
  /// The value of an optional member, null where it is absent.
  const nlohmann::json* find(std::string_view key);
  /// The value of a member that must be there.
  const nlohmann::json* need(std::string_view key);

  std::optional<double> number(std::string_view key);
  std::optional<double> number(std::string_view key, double fallback);
  std::optional<double> positive(std::string_view key);
  std::optional<int> index(std::string_view key);  ///< 0, 1, ...
  std::optional<std::string> text(std::string_view key);
  std::optional<std::string> text(std::string_view key, const std::string& fallback);
  /// One of `choices`.
  std::optional<std::string> choice(std::string_view key, const std::vector<std::string>& choices,
                                    const std::string& fallback = {});
  /// Exactly `count` numbers; nested arrays count in reading order (a matrix by rows).
  std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count);
  std::optional<Eigen::Vector2d> pair(std::string_view key);
  std::optional<Eigen::Vector2i> image_size(std::string_view key);
  std::optional<Eigen::Matrix3d> matrix3(std::string_view key);

  Fields object(std::string_view key);  ///< must be there
  std::string pointer_of(std::string_view key) const;
  const std::string& pointer() const { return pointer_; }
  const JsonDocument& document() const { return document_; }

  void fault(std::string message);                        ///< at the object
  void fault(std::string_view key, std::string message);  ///< at a member, or the object without it
  /// Reports members that nobody asked for, with the nearest name that somebody did.
  void refuse_unknown();

 private:
  const JsonDocument& document_;
  std::string pointer_;
  Diagnostics& faults_;
  const nlohmann::json* object_ = nullptr;
  std::vector<std::string> known_;
};

/// All numbers in nested arrays, in reading order; nothing when there is anything else.
std::optional<std::vector<double>> flat_numbers(const nlohmann::json& value);

std::string in_quotes(std::string_view text);

/// "3.5", "-0.25", "1e-05": a number in a message, six digits.
std::string short_number(double value);

}  // namespace plaza
