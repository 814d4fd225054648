#include "framework/config/graph_dot.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace plaza {
namespace {

/// A quoted string of the DOT language.
std::string dot_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string node_id(int node) {
  std::string id(1, 'n');
  id += std::to_string(node);
  return id;
}

std::string title(const ResolvedPart& part) {
  const std::string& use = part.entry->declaration.name;
  return part.name == use ? part.name : part.name + "\n" + use;
}

void append_parts(const ResolvedPart& owner, const std::string& id, const std::string& indent,
                  std::string& out) {
  std::size_t count = 0;
  for (const auto& [parameter, parts] : owner.parts) {
    for (const ResolvedPart& part : parts) {
      const std::string below = id + "_" + std::to_string(count++);
      out += indent + below + " [shape=box, style=rounded, label=" + dot_text(title(part)) + "];\n";
      out += indent + id + " -> " + below +
             " [style=dashed, arrowhead=none, label=" + dot_text(parameter) + "];\n";
      append_parts(part, below, indent, out);
    }
  }
}

/// Type of an input: declared ones first, then those of input lists.
std::string input_type(const ResolvedPipeline& pipeline, const ResolvedNode& node,
                       std::size_t input) {
  const Wire& wire = node.inputs[input];
  const auto& producer = pipeline.nodes[static_cast<std::size_t>(wire.node)].entry->declaration;
  return producer.outputs[static_cast<std::size_t>(wire.output)].type;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

}  // namespace

std::string graph_dot(const ResolvedPipeline& pipeline) {
  std::string out = "digraph pipeline {\n  label=" + dot_text(pipeline.name) +
                    ";\n  rankdir=TB;\n  node [shape=box, fontname=\"sans-serif\"];\n"
                    "  edge [fontname=\"sans-serif\", fontsize=10];\n";
  for (std::size_t i = 0; i < pipeline.nodes.size(); ++i) {
    const ResolvedNode& node = pipeline.nodes[i];
    const std::string id = node_id(static_cast<int>(i));
    const bool has_parts = std::any_of(node.parts.begin(), node.parts.end(),
                                       [](const auto& list) { return !list.second.empty(); });
    const std::string declared = id + " [label=" + dot_text(title(node)) +
                                 ", tooltip=" + dot_text(node.entry->declaration.summary) + "];\n";
    if (has_parts) {
      out += "  subgraph cluster_" + id + " {\n    label=\"\";\n    style=dotted;\n    " + declared;
      append_parts(node, id, "    ", out);
      out += "  }\n";
    } else {
      out += "  " + declared;
    }
  }
  for (std::size_t i = 0; i < pipeline.nodes.size(); ++i) {
    const ResolvedNode& node = pipeline.nodes[i];
    // a node that reads several things from one other gets one arrow with all of them
    std::map<int, std::string> labels;
    for (std::size_t k = 0; k < node.inputs.size(); ++k) {
      if (node.inputs[k].node < 0) continue;
      std::string& label = labels[node.inputs[k].node];
      if (!label.empty()) label += "\n";
      label += input_type(pipeline, node, k);
    }
    for (const auto& [producer, label] : labels) {
      out += "  " + node_id(producer) + " -> " + node_id(static_cast<int>(i)) +
             " [label=" + dot_text(label) + "];\n";
    }
  }
  return out + "}\n";
}

std::string wiring_table(const ResolvedPipeline& pipeline) {
  std::size_t name_width = 0;
  std::size_t use_width = 0;
  for (const ResolvedNode& node : pipeline.nodes) {
    name_width = std::max(name_width, node.name.size());
    use_width = std::max(use_width, node.entry->declaration.name.size());
  }
  std::string out;
  for (const ResolvedNode& node : pipeline.nodes) {
    std::string reads;
    for (std::size_t k = 0; k < node.inputs.size(); ++k) {
      if (node.inputs[k].node < 0) continue;
      if (!reads.empty()) reads += ", ";
      reads += input_type(pipeline, node, k) + " from " +
               pipeline.nodes[static_cast<std::size_t>(node.inputs[k].node)].name;
    }
    std::string row = "  " + padded(node.name, name_width) + "  " +
                      padded(node.entry->declaration.name, use_width) + "  " + reads;
    row.erase(row.find_last_not_of(' ') + 1);
    out += row + "\n";
  }
  return out;
}

}  // namespace plaza
