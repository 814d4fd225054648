#include "plaza/component/parameter.h"

#include <utility>

namespace plaza {

std::string_view to_string(ParameterType type) {
  switch (type) {
    case ParameterType::kBoolean:
      return "boolean";
    case ParameterType::kInteger:
      return "integer";
    case ParameterType::kReal:
      return "real";
    case ParameterType::kText:
      return "text";
    case ParameterType::kChoice:
      return "choice";
    case ParameterType::kPath:
      return "path";
    case ParameterType::kList:
      return "list";
    case ParameterType::kMap:
      return "map";
    case ParameterType::kPart:
      return "part";
    case ParameterType::kPartList:
      return "parts";
    case ParameterType::kInputList:
      return "inputs";
  }
  return "?";
}

ParameterSpec detail::scalar_spec(ParameterType type) {
  ParameterSpec spec;
  spec.type = type;
  return spec;
}

ParameterSpec& ParameterBuilder::limits() const {
  ParameterSpec* spec = spec_;
  while ((spec->type == ParameterType::kList || spec->type == ParameterType::kMap) &&
         !spec->element.empty()) {
    spec = &spec->element[0];
  }
  return *spec;
}

ParameterBuilder& ParameterBuilder::unit(std::string text) {
  spec_->unit = std::move(text);
  return *this;
}
ParameterBuilder& ParameterBuilder::meaning(std::string text) {
  spec_->meaning = std::move(text);
  return *this;
}
ParameterBuilder& ParameterBuilder::source(std::string text) {
  spec_->source = std::move(text);
  return *this;
}
ParameterBuilder& ParameterBuilder::required() {
  spec_->required = true;
  spec_->default_value = nullptr;
  return *this;
}
ParameterBuilder& ParameterBuilder::at_least(double limit) {
  limits().minimum = limit;
  limits().minimum_exclusive = false;
  return *this;
}
ParameterBuilder& ParameterBuilder::above(double limit) {
  limits().minimum = limit;
  limits().minimum_exclusive = true;
  return *this;
}
ParameterBuilder& ParameterBuilder::at_most(double limit) {
  limits().maximum = limit;
  limits().maximum_exclusive = false;
  return *this;
}
ParameterBuilder& ParameterBuilder::below(double limit) {
  limits().maximum = limit;
  limits().maximum_exclusive = true;
  return *this;
}
ParameterBuilder& ParameterBuilder::items(std::size_t at_least,
                                          std::optional<std::size_t> at_most) {
  spec_->min_items = at_least;
  spec_->max_items = at_most;
  return *this;
}

}  // namespace plaza
