#include "framework/config/wiring.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "framework/config/text.h"
#include "plaza/data/frames.h"
#include "plaza/data/ground_truth.h"

namespace plaza {
namespace {

const ComponentDeclaration& declaration_of(const NodeDraft& draft) {
  return draft.node.entry->declaration;
}

std::optional<int> port_index(const std::vector<PortSpec>& ports, std::string_view type) {
  for (std::size_t i = 0; i < ports.size(); ++i) {
    if (ports[i].type == type) return static_cast<int>(i);
  }
  return std::nullopt;
}

std::string types_text(const std::vector<PortSpec>& ports) {
  std::string text;
  for (const PortSpec& port : ports) {
    if (!text.empty()) text += ", ";
    text += port.type;
  }
  return text.empty() ? "nothing" : text;
}

class Wirer {
 public:
  Wirer(std::vector<NodeDraft>& drafts, const Registry& registry, DiagnosticSink& diagnostics)
      : drafts_(drafts), registry_(registry), diagnostics_(diagnostics) {
    for (std::size_t i = 0; i < drafts_.size(); ++i) {
      if (drafts_[i].node.entry == nullptr) continue;
      if (declaration_of(drafts_[i]).kind != "source") continue;
      clock_ = i;
      break;
    }
  }

  void wire() {
    check_first();
    for (std::size_t i = 0; i < drafts_.size(); ++i) {
      if (drafts_[i].node.entry != nullptr) wire_node(i);
    }
  }

 private:
  void check_first() {
    if (drafts_.empty() || drafts_[0].node.entry == nullptr) return;
    const ComponentDeclaration& first = declaration_of(drafts_[0]);
    if (first.kind == "source") return;
    std::string message =
        "the first node must be a source, " + quote(first.name) + " is " + a_or_an(first.kind);
    std::vector<std::string> sources;
    for (const ComponentEntry* entry : registry_.all("source"))
      sources.push_back(entry->declaration.name);
    if (clock_) {
      message += "; move " + quote(drafts_[*clock_].node.name) + " up";
    } else if (!sources.empty()) {
      message += "; there are " + quote_all(sources);
    }
    diagnostics_.add(drafts_[0].value->origin, message);
  }

  /// The output of node `i` with this type, as others may read it.
  std::optional<int> offered(std::size_t i, std::string_view type) const {
    const NodeDraft& draft = drafts_[i];
    if (draft.node.entry == nullptr) return std::nullopt;
    const bool muted =
        type == FrameSet::kPort && declaration_of(draft).kind == "source" && clock_ != i;
    return muted ? std::nullopt : port_index(declaration_of(draft).outputs, type);
  }

  std::optional<std::size_t> nearest_above(std::size_t i, std::string_view type) const {
    while (i > 0) {
      if (offered(--i, type)) return i;
    }
    return std::nullopt;
  }

  bool unknown_above(std::size_t i) const {
    return std::any_of(drafts_.begin(), drafts_.begin() + static_cast<std::ptrdiff_t>(i),
                       [](const NodeDraft& d) { return d.node.entry == nullptr; });
  }

  std::vector<std::string> names_above_giving(std::size_t i,
                                              const std::set<std::string>& types) const {
    std::vector<std::string> names;
    for (std::size_t j = 0; j < i; ++j) {
      const bool gives = std::any_of(types.begin(), types.end(), [&](const std::string& type) {
        return offered(j, type).has_value();
      });
      if (gives) names.push_back(drafts_[j].node.name);
    }
    return names;
  }

  /// The node called `name` if node `i` may read from it; else says why not.
  std::optional<std::size_t> find_above(std::size_t i, const std::string& name,
                                        const Origin& origin, const std::set<std::string>& types) {
    std::optional<std::size_t> found;
    std::vector<std::string> above;
    for (std::size_t j = 0; j < drafts_.size(); ++j) {
      if (drafts_[j].node.name == name && !found) found = j;
      if (j < i) above.push_back(drafts_[j].node.name);
    }
    if (found && *found < i) return found;
    if (found == i) {
      diagnostics_.add(origin, "a node can't read from itself");
    } else if (found) {
      diagnostics_.add(origin, "node " + quote(name) +
                                   " is below; nodes read from nodes above them, so move " +
                                   quote(name) + " up");
    } else {
      std::string message = "there is no node " + quote(name);
      const std::string hint = did_you_mean(name, above);
      const std::vector<std::string> useful = names_above_giving(i, types);
      if (!hint.empty()) {
        message += hint;
      } else if (!useful.empty()) {
        message += "; nodes above that would do: " + quote_all(useful);
      }
      diagnostics_.add(origin, message);
    }
    return std::nullopt;
  }

  /// What "from" decides: input type -> node, or nothing for an input that is to stay unconnected.
  using Choices = std::map<std::string, std::pair<std::optional<std::size_t>, Origin>>;

  Choices read_from(std::size_t i) {
    Choices choices;
    const ConfigValue* from = drafts_[i].value->find("from");
    if (from == nullptr) return choices;
    std::set<std::string> wanted;
    for (const PortSpec& port : declaration_of(drafts_[i]).inputs) wanted.insert(port.type);
    if (wanted.empty()) {
      const bool lists = !drafts_[i].node.input_lists.empty();
      diagnostics_.add(
          from->origin,
          quote(declaration_of(drafts_[i]).name) +
              (lists ? " reads only what " + quote(drafts_[i].node.input_lists.begin()->first) +
                           " names; remove \"from\""
                     : " reads nothing; remove \"from\""));
      return choices;
    }
    if (from->is_text()) {
      choose_by_name(i, *from, wanted, choices);
    } else if (from->is_array()) {
      for (const ConfigValue& item : from->items) choose_by_name(i, item, wanted, choices);
    } else if (from->is_object()) {
      for (const ConfigMember& member : from->members) choose_by_type(i, member, wanted, choices);
    } else {
      diagnostics_.add(
          from->origin,
          "expected a node's name, a list of names or { TYPE: name }, got " + type_name(*from));
    }
    return choices;
  }

  void choose_by_name(std::size_t i, const ConfigValue& value, const std::set<std::string>& wanted,
                      Choices& choices) {
    if (!value.is_text()) {
      diagnostics_.add(value.origin, "expected a node's name, got " + type_name(value));
      return;
    }
    const auto producer = find_above(i, value.text(), value.origin, wanted);
    if (!producer || drafts_[*producer].node.entry == nullptr) {
      // whatever it would have given is not to be missed
      for (const std::string& type : wanted) excused_.insert({i, type});
      return;
    }
    bool gives = false;
    for (const std::string& type : wanted) {
      if (!offered(*producer, type)) continue;
      gives = true;
      const auto [choice, fresh] = choices.try_emplace(type, *producer, value.origin);
      if (!fresh) {
        diagnostics_.add(value.origin, quote(drafts_[*choice->second.first].node.name) + " and " +
                                           quote(value.text()) + " both give " + type +
                                           "; say which: \"from\": { " + quote(type) + ": " +
                                           quote(value.text()) + " }");
      }
    }
    if (!gives) refuse_types(i, *producer, value.origin, wanted);
  }

  void choose_by_type(std::size_t i, const ConfigMember& member,
                      const std::set<std::string>& wanted, Choices& choices) {
    const ConfigValue& value = member.value;
    if (!wanted.contains(member.key)) {
      const std::vector<std::string> types(wanted.begin(), wanted.end());
      const std::string hint = did_you_mean(member.key, types);
      diagnostics_.add(member.key_origin,
                       quote(declaration_of(drafts_[i]).name) + " does not read " +
                           quote(member.key) +
                           (hint.empty() ? "; it reads " + quote_all(types) : hint));
      return;
    }
    if (value.is_null()) {
      const auto& inputs = declaration_of(drafts_[i]).inputs;
      const PortSpec& port = inputs[static_cast<std::size_t>(*port_index(inputs, member.key))];
      if (port.required) {
        diagnostics_.add(value.origin, "only optional inputs can be left unconnected, " +
                                           member.key + " is required");
        excused_.insert({i, member.key});
      }
      choices[member.key] = {std::nullopt, value.origin};
      return;
    }
    if (!value.is_text()) {
      diagnostics_.add(value.origin, "expected a node's name, got " + type_name(value));
      excused_.insert({i, member.key});
      return;
    }
    const auto producer = find_above(i, value.text(), value.origin, {member.key});
    if (!producer || drafts_[*producer].node.entry == nullptr) {
      excused_.insert({i, member.key});
    } else if (!offered(*producer, member.key)) {
      refuse_types(i, *producer, value.origin, {member.key});
      excused_.insert({i, member.key});
    } else {
      choices[member.key] = {*producer, value.origin};
    }
  }

  void refuse_types(std::size_t i, std::size_t producer, const Origin& origin,
                    const std::set<std::string>& wanted) {
    const ComponentDeclaration& given = declaration_of(drafts_[producer]);
    const std::string& name = drafts_[producer].node.name;
    std::string needs;
    for (const std::string& type : wanted) needs += (needs.empty() ? "" : " or ") + type;
    if (wanted.contains(std::string(FrameSet::kPort)) && given.kind == "source" &&
        clock_ != producer && port_index(given.outputs, FrameSet::kPort)) {
      diagnostics_.add(origin, "only the first source gives Frames, which is " +
                                   quote(drafts_[*clock_].node.name) + ", not " + quote(name));
      return;
    }
    std::string message =
        "node " + quote(name) + " gives " + types_text(given.outputs) + ", not " + needs;
    const std::vector<std::string> useful = names_above_giving(i, wanted);
    if (!useful.empty())
      message += "; above, " + quote_all(useful) + (useful.size() > 1 ? " do" : " does");
    diagnostics_.add(origin, message);
  }

  void refuse_missing(std::size_t i, const PortSpec& port) {
    std::string message = quote(declaration_of(drafts_[i]).name) + " needs " + port.type +
                          ", which no node above gives";
    for (std::size_t j = i + 1; j < drafts_.size(); ++j) {
      if (!offered(j, port.type)) continue;
      diagnostics_.add(drafts_[i].value->origin,
                       message + "; move " + quote(drafts_[j].node.name) + " up, it does");
      return;
    }
    std::vector<std::string> makers;
    for (const ComponentEntry* entry : registry_.all()) {
      const ComponentDeclaration& d = entry->declaration;
      // what needs the type itself (a describer of observations) would only move the question
      const auto input = port_index(d.inputs, port.type);
      const bool needs_it = input && d.inputs[static_cast<std::size_t>(*input)].required;
      if (port_index(d.outputs, port.type) && !needs_it) makers.push_back(d.name);
    }
    message += makers.empty() ? "; no component that is installed gives it"
                              : "; place one above that does: " + quote_all(makers);
    diagnostics_.add(drafts_[i].value->origin, message);
  }

  void refuse_truth(std::size_t i, const Origin& origin) {
    const ComponentDeclaration& declaration = declaration_of(drafts_[i]);
    diagnostics_.add(
        origin, quote(declaration.name) + " is " + a_or_an(declaration.kind) +
                    " and reads GroundTruth; only evaluators, sinks and renderers may, so that "
                    "no result knows the truth");
  }

  bool may_read_truth(std::size_t i) const {
    const std::string& kind = declaration_of(drafts_[i]).kind;
    return kind == "evaluator" || kind == "sink" || kind == "renderer";
  }

  void wire_node(std::size_t i) {
    ResolvedNode& node = drafts_[i].node;
    const Choices choices = read_from(i);
    for (const PortSpec& port : declaration_of(drafts_[i]).inputs) {
      const std::string pointer = "/from/" + port.type;
      Wire wire;
      std::optional<std::size_t> producer;
      if (const auto choice = choices.find(port.type); choice != choices.end()) {
        producer = choice->second.first;
        node.origins[pointer] = choice->second.second;
      } else {
        producer = nearest_above(i, port.type);
        Origin by_default;
        by_default.pointer = node.pointer + pointer;
        node.origins[pointer] = std::move(by_default);
      }
      if (port.type == GroundTruth::kPort && !may_read_truth(i)) {
        refuse_truth(i, drafts_[i].value->origin);
      } else if (producer) {
        wire = {static_cast<int>(*producer), *offered(*producer, port.type)};
      } else if (port.required && !unknown_above(i) && !excused_.contains({i, port.type})) {
        refuse_missing(i, port);
      }
      node.inputs.push_back(wire);
    }
    for (const InputRecordDraft& record : drafts_[i].records) wire_record(i, record);
  }

  void wire_record(std::size_t i, const InputRecordDraft& record) {
    ResolvedNode& node = drafts_[i].node;
    if (record.from.empty()) return;  // already complained about
    if (record.port == GroundTruth::kPort && !may_read_truth(i))
      return refuse_truth(i, record.origin);
    auto& records = node.input_lists[record.parameter];
    const bool twice =
        std::any_of(records.begin(), records.end(),
                    [&](const ResolvedInputRecord& other) { return other.from == record.from; });
    if (twice) {
      diagnostics_.add(record.origin,
                       quote(record.parameter) + " reads " + quote(record.from) + " twice");
      return;
    }
    const auto producer = find_above(i, record.from, record.origin, {record.port});
    if (!producer || drafts_[*producer].node.entry == nullptr) return;
    const auto output = offered(*producer, record.port);
    if (!output) return refuse_types(i, *producer, record.origin, {record.port});
    records.push_back({record.from, record.fields, node.inputs.size()});
    node.inputs.push_back({static_cast<int>(*producer), *output});
  }

  std::vector<NodeDraft>& drafts_;
  const Registry& registry_;
  DiagnosticSink& diagnostics_;
  std::optional<std::size_t> clock_;  ///< the first source
  std::set<std::pair<std::size_t, std::string>>
      excused_;  ///< inputs whose "from" has its own error
};

}  // namespace

void wire_nodes(std::vector<NodeDraft>& drafts, const Registry& registry,
                DiagnosticSink& diagnostics) {
  Wirer(drafts, registry, diagnostics).wire();
}

}  // namespace plaza
