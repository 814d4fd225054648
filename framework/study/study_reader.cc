#include <algorithm>
#include <utility>

#include "framework/config/json_document.h"
#include "framework/config/text.h"
#include "framework/study/study.h"
#include "framework/study/study_fields.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr int kLanguageVersion = 1;

const std::vector<std::string>& top_level_keys() {
  static const std::vector<std::string> kKeys = {
      "$schema", "plaza_study", "name",  "description",     "pipeline", "scene",    "frames", "set",
      "nodes",   "axes",        "seeds", "seed_parameters", "metrics",  "baseline", "draw"};
  return kKeys;
}

/// The forms that an axis has, by the key that tells them apart.
const std::vector<std::string>& axis_forms() {
  static const std::vector<std::string> kForms = {"set", "pipelines", "scenes", "frames",
                                                  "choices"};
  return kForms;
}

class StudyReader {
 public:
  StudyReader(const ConfigValue& root, Study& study, DiagnosticSink& diagnostics)
      : root_(root), study_(study), fields_(study.file, diagnostics) {}

  void read() {
    fields_.know(root_, top_level_keys(), "study");
    read_version();
    study_.name = fields_.text(root_, "name");
    if (study_.name.empty()) study_.name = study_.file.stem().string();
    study_.description = fields_.text(root_, "description");
    fields_.text(root_, "$schema");
    study_.base = fields_.change(root_);
    study_.pipeline_origin = root_.origin;
    read_axes();
    require_pipeline();
    read_seeds();
    if (const ConfigValue* metrics = root_.find("metrics")) read_metrics(*metrics);
    if (const ConfigValue* baseline = root_.find("baseline")) read_baseline(*baseline);
    if (const ConfigValue* draw = root_.find("draw")) {
      if (draw->plain.is_boolean()) {
        study_.draw = draw->plain.get<bool>();
      } else {
        fields_.fail(draw->origin, "expected true or false, got " + type_name(*draw));
      }
    }
  }

 private:
  void read_version() {
    const ConfigValue* version = root_.find("plaza_study");
    const std::string wanted = "\"plaza_study\": " + std::to_string(kLanguageVersion);
    if (version == nullptr) {
      fields_.fail(root_.origin, "missing " + wanted + ", the version of the language of studies");
    } else if (!version->plain.is_number() || version->plain != kLanguageVersion) {
      fields_.fail(version->origin, "expected " + std::to_string(kLanguageVersion) +
                                        ", the version of the language of studies that this Plaza "
                                        "reads, got " +
                                        type_name(*version));
    }
  }

  /// Every combination needs a pipeline: the study's, or one of an axis all of whose values say
  /// one.
  void require_pipeline() {
    if (root_.find("pipeline") != nullptr) return;
    for (const Axis& axis : study_.axes) {
      const bool all = std::all_of(axis.values.begin(), axis.values.end(), [](const AxisValue& v) {
        return v.change.pipeline.has_value();
      });
      if (all) return;
    }
    fields_.fail(root_.origin,
                 "missing \"pipeline\", the pipeline that is varied, or an axis of \"pipelines\"");
  }

  void read_axes() {
    const ConfigValue* axes = root_.find("axes");
    if (axes == nullptr) return;  // repetitions alone are a study, too
    study_.axes_origin = axes->origin;
    if (!axes->is_array()) {
      fields_.fail(axes->origin, "expected a list of axes, got " + type_name(*axes));
      return;
    }
    for (const ConfigValue& item : axes->items) {
      if (!item.is_object()) {
        fields_.fail(item.origin, "expected an axis { ... }, got " + type_name(item));
        continue;
      }
      Axis axis = read_axis(item);
      for (const Axis& other : study_.axes) {
        if (other.name != axis.name || axis.name.empty()) continue;
        fields_.fail(item.origin,
                     "there is already an axis " + quote(axis.name) + "; give another \"name\"");
      }
      study_.axes.push_back(std::move(axis));
    }
  }

  Axis read_axis(const ConfigValue& item) {
    std::vector<std::string> found;
    for (const std::string& form : axis_forms()) {
      if (item.find(form) != nullptr) found.push_back(form);
    }
    Axis axis;
    axis.name = fields_.text(item, "name");
    if (found.size() != 1) {
      std::vector<std::string> keys = axis_forms();
      keys.insert(keys.end(), {"name", "values", "labels"});
      fields_.know(item, keys, "axis");
      fields_.fail(item.origin, "an axis has exactly one of " + quote_all(axis_forms()) +
                                    (found.empty() ? "" : ", got " + quote_all(found)));
      return axis;
    }
    const std::string& form = found.front();
    const ConfigValue& value = *item.find(form);
    if (form == "choices") {
      fields_.know(item, {"name", "choices"}, "axis of choices");
      read_choices(value, axis);
      if (axis.name.empty()) fields_.fail(item.origin, "an axis of choices needs a \"name\"");
    } else if (form == "set") {
      fields_.know(item, {"name", "set", "values", "labels"}, "axis of values");
      read_values(item, value, axis);
    } else {
      fields_.know(item, {"name", "labels", form}, "axis of " + form);
      read_runs(form, value, axis);
      if (axis.name.empty()) axis.name = form == "frames" ? form : form.substr(0, form.size() - 1);
    }
    read_labels(item, axis);
    return axis;
  }

  void read_values(const ConfigValue& item, const ConfigValue& set, Axis& axis) {
    std::vector<const ConfigValue*> pointers;
    if (set.is_array()) {
      for (const ConfigValue& pointer : set.items) pointers.push_back(&pointer);
    } else {
      pointers.push_back(&set);
    }
    std::erase_if(pointers, [this](const ConfigValue* p) { return !fields_.pointer(*p); });
    if (axis.name.empty() && !pointers.empty()) {
      axis.name = pointer_tokens(pointers.front()->text()).back();
    }
    const ConfigValue* values = item.find("values");
    if (values == nullptr) {
      fields_.fail(item.origin, "missing \"values\", the list of values to set");
      return;
    }
    if (!fields_.is_filled_list(*values, "values")) return;
    for (const ConfigValue& value : values->items) {
      AxisValue& entry = axis.values.emplace_back();
      entry.label = label_of(value);
      if (value.plain.is_number()) entry.number = value.plain.get<double>();
      for (const ConfigValue* pointer : pointers) {
        entry.change.settings.push_back({pointer->text(), pointer->origin, value});
      }
    }
  }

  void read_runs(const std::string& form, const ConfigValue& list, Axis& axis) {
    if (!fields_.is_filled_list(list, form)) return;
    for (const ConfigValue& value : list.items) {
      AxisValue& entry = axis.values.emplace_back();
      entry.label = value.is_text() ? value.text() : "";
      if (form == "frames") {
        entry.change.frames = fields_.frames(value);
        continue;
      }
      const auto path = fields_.path(value);
      if (path) entry.label = path->stem().string();
      if (form == "pipelines") {
        entry.change.pipeline = path;
      } else {
        entry.change.settings.push_back({"/scene", value.origin, value});
      }
    }
  }

  void read_choices(const ConfigValue& choices, Axis& axis) {
    if (!fields_.is_filled_list(choices, "choices { \"name\": ..., ... }")) return;
    std::vector<std::string> keys = StudyFields::change_keys();
    keys.emplace_back("name");
    for (const ConfigValue& choice : choices.items) {
      if (!choice.is_object()) {
        fields_.fail(choice.origin,
                     "expected a choice { \"name\": ..., ... }, got " + type_name(choice));
        continue;
      }
      fields_.know(choice, keys, "choice");
      AxisValue& entry = axis.values.emplace_back();
      entry.label = fields_.text(choice, "name");
      entry.change = fields_.change(choice);
      if (choice.find("name") == nullptr) {
        fields_.fail(choice.origin, "missing \"name\", the choice's name in tables and plots");
      }
    }
  }

  void read_labels(const ConfigValue& item, Axis& axis) {
    if (const ConfigValue* labels = item.find("labels");
        labels != nullptr && fields_.is_filled_list(*labels, "labels")) {
      if (labels->items.size() != axis.values.size()) {
        fields_.fail(labels->origin, "expected one label for each of the " +
                                         std::to_string(axis.values.size()) + " values, got " +
                                         std::to_string(labels->items.size()));
      } else {
        for (std::size_t i = 0; i < axis.values.size(); ++i) {
          const ConfigValue& label = labels->items[i];
          axis.values[i].label = label_of(label);
          if (label.plain.is_number()) axis.values[i].number = label.plain.get<double>();
        }
      }
    }
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
      const std::string& label = axis.values[i].label;
      const auto same = [&label](const AxisValue& v) { return v.label == label; };
      const auto end = axis.values.begin() + static_cast<std::ptrdiff_t>(i);
      if (label.empty() || std::any_of(axis.values.begin(), end, same)) {
        fields_.fail(item.origin, label.empty()
                                      ? "value " + std::to_string(i + 1) +
                                            " has no name; give \"labels\", one for each value"
                                      : "two values are called " + quote(label) +
                                            "; give \"labels\", one for each value");
        return;
      }
    }
  }

  void read_seeds() {
    study_.seed_parameters = {"/seed"};
    const ConfigValue* parameters = root_.find("seed_parameters");
    const ConfigValue* seeds = root_.find("seeds");
    if (seeds != nullptr) {
      study_.seeds = fields_.seeds(*seeds);
      study_.seeds_origin = seeds->origin;
    }
    if (parameters == nullptr) return;
    if (seeds == nullptr) {
      fields_.fail(parameters->origin,
                   "\"seed_parameters\" says where \"seeds\" are set, and "
                   "there are none");
    }
    study_.seeds_origin = parameters->origin;
    study_.seed_parameters = fields_.words(*parameters, "places of seeds");
  }

  void read_metrics(const ConfigValue& metrics) {
    if (!fields_.is_filled_list(metrics, "metrics")) return;
    for (const ConfigValue& item : metrics.items) {
      if (item.is_text()) {
        study_.metrics.push_back({item.text(), item.origin});
      } else {
        fields_.fail(item.origin,
                     "expected a metric, such as \"tracking.MOTA\", got " + type_name(item));
      }
    }
  }

  void read_baseline(const ConfigValue& baseline) {
    if (!baseline.is_object() || baseline.members.empty()) {
      fields_.fail(baseline.origin,
                   "expected { AXIS: VALUE, ... }, what others are compared "
                   "with, got " +
                       type_name(baseline));
      return;
    }
    for (const ConfigMember& member : baseline.members) {
      std::vector<std::string> names;
      const Axis* axis = nullptr;
      for (const Axis& candidate : study_.axes) {
        names.push_back(candidate.name);
        if (candidate.name == member.key) axis = &candidate;
      }
      if (axis == nullptr) {
        fields_.fail(member.key_origin,
                     "there is no axis " + quote(member.key) + did_you_mean(member.key, names));
        continue;
      }
      const std::string label = label_of(member.value);
      std::vector<std::string> labels;
      for (const AxisValue& value : axis->values) labels.push_back(value.label);
      if (std::find(labels.begin(), labels.end(), label) == labels.end()) {
        const std::string hint = did_you_mean(label, labels);
        fields_.fail(member.value.origin,
                     "axis " + quote(axis->name) + " has no value " + quote(label) +
                         (hint.empty() ? "; it has " + quote_all(labels) : hint));
      }
      study_.baseline.values[axis->name] = label;
    }
  }

  const ConfigValue& root_;
  Study& study_;
  StudyFields fields_;
};

}  // namespace

bool Axis::numeric() const {
  return std::all_of(values.begin(), values.end(),
                     [](const AxisValue& v) { return v.number.has_value(); });
}

bool is_chosen(const MetricSpec& metric, const std::string& choice) {
  return choice == metric.name || choice == metric.section ||
         choice == metric.section + "." + metric.name;
}

Study read_study_text(std::string_view text, const std::filesystem::path& file) {
  Study study;
  study.file = file;
  const ConfigValue root = to_config_value(parse_json(text, file.string()));
  if (!root.is_object()) {
    throw user_error(root.origin,
                     "a study is an object { \"plaza_study\": 1, ... }, got " + type_name(root));
  }
  DiagnosticSink diagnostics;
  StudyReader(root, study, diagnostics).read();
  const Diagnostics faults = diagnostics.take({file.string()});
  if (!faults.empty()) throw UserError(faults);
  return study;
}

Study read_study(const std::filesystem::path& file) {
  return read_study_text(read_text_file(file), file);
}

}  // namespace plaza
