// Pipelines made into components, and what can be said of them: resolved.json, graph, schema,
// texts.
#include <cstdlib>

#include "framework/config/component_text.h"
#include "framework/config/graph_dot.h"
#include "framework/config/schema.h"
#include "plaza/component/node.h"
#include "tests/framework/config/pipeline_fixture.h"

namespace plaza::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class AssembleTest : public PipelineFixture {
 protected:
  std::string assembly_errors(const std::string& nodes) const {
    try {
      assemble(read_nodes(nodes), make_scene(), "out");
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(AssembleTest, MakesEveryNode) {
  const Assembly assembly = assemble(read_nodes(kWholeNodes), make_scene(), "out");
  ASSERT_EQ(assembly.nodes.size(), 9U);
  for (const auto& node : assembly.nodes) EXPECT_NE(dynamic_cast<Node*>(node.get()), nullptr);
}

TEST_F(AssembleTest, FactoriesGetPartsProducersAndFolders) {
  Registry registry = make_registry();
  ComponentEntry entry = *registry.find("grid");
  entry.declaration.name = "spy";
  BuildContext seen;
  json values;
  const ComponentFactory original = entry.factory;
  entry.factory = [&](const json& v, const BuildContext& context) {
    seen = context;
    values = v;
    return original(v, context);
  };
  registry.add(entry);
  const ResolvedPipeline pipeline = read_pipeline_text(
      with_nodes(
          R"({ "use": "synthetic" }, { "use": "edges" }, { "use": "spy", "name": "d", "cells": 9, "modalities": [ { "from": "edges", "weight": 3 } ] })"),
      {"p.json", {}}, registry);
  const Assembly assembly = assemble(pipeline, make_scene(), "out");
  EXPECT_EQ(seen.name, "d");
  EXPECT_EQ(seen.output_folder, "out");
  EXPECT_EQ(seen.scene, assembly.scene);
  EXPECT_EQ(seen.seed, component_seed(0, "/nodes/d"));
  ASSERT_EQ(seen.inputs("modalities").size(), 1U);
  EXPECT_EQ(seen.inputs("modalities")[0].producer, assembly.nodes[1]);
  EXPECT_EQ(seen.inputs("modalities")[0].slot, 1U);  // after the optional mask
  EXPECT_EQ(seen.inputs("modalities")[0].fields["weight"], 3.0);
  EXPECT_NE(seen.part<ShapeModel>("shape"), nullptr);
  EXPECT_EQ(values["cells"], 9);
}

TEST_F(AssembleTest, SeedsDependOnThePipelineAndTheNameAlone) {
  EXPECT_EQ(component_seed(7, "/nodes/a"), component_seed(7, "/nodes/a"));
  EXPECT_NE(component_seed(7, "/nodes/a"), component_seed(8, "/nodes/a"));
  EXPECT_NE(component_seed(7, "/nodes/a"), component_seed(7, "/nodes/b"));
  EXPECT_EQ(component_seed(0, ""), 0x5B21F68FFA77F14CU)
      << "seeds must never change between versions";
}

TEST_F(AssembleTest, CollectsTheFaultsOfAllComponents) {
  EXPECT_EQ(assembly_errors(
                "{ \"use\": \"video\", \"files\": { \"a\": \"a.avi\",\n  \"b\": \"b.avi\" } },\n"
                "{ \"use\": \"edges\", \"directions\": 7 },\n"
                "{ \"use\": \"grid\", \"modalities\": [ { \"from\": \"edges\" } ],\n"
                "  \"shape\": { \"use\": \"cylinder\", \"radii_m\": [0.5, 0.2, 0.2] } }"),
            "p.json:2:35: /nodes/0/files/a: there is no file a.avi\n"
            "p.json:3:8: /nodes/0/files/b: there is no file b.avi\n"
            "p.json:4:33: /nodes/1/directions: directions come in pairs, 7 is odd\n"
            "p.json:6:45: /nodes/2/shape/radii_m/0: the head is wider than the torso");
}

TEST_F(AssembleTest, OtherExceptionsAreThePluginsFaultAndNameIt) {
  const std::string nodes =
      R"({ "use": "synthetic" }, { "use": "boxes" }, { "use": "gnn" }, { "use": "faulty", "name": "f" })";
  EXPECT_THROW(assemble(read_nodes(nodes), make_scene(), "out"), InternalError);
  EXPECT_EQ(assembly_errors(nodes), "component \"/nodes/f\" (faulty) failed: index 7 of 3");
}

class ResolvedTest : public PipelineFixture {};

TEST_F(ResolvedTest, HoldsEveryValueWithItsOrigin) {
  const json resolved = read_nodes(kWholeNodes, {"/nodes/edges/directions=6"}).resolved_json();
  EXPECT_EQ(resolved["plaza"], 1);
  EXPECT_EQ(resolved["name"], "p");
  EXPECT_EQ(resolved["seed"], 0);
  EXPECT_EQ(resolved["scene"], (folder_ / "scene.json").string());
  EXPECT_EQ(
      resolved["nodes"][1],
      json::parse(
          R"({ "use": "edges", "name": "edges", "directions": 6, "sigma_px": 2.0, "from": { "Frames": "cameras" } })"));
  EXPECT_EQ(resolved["nodes"][3]["shape"]["radii_m"], json::parse("[0.12, 0.25, 0.18]"));
  EXPECT_EQ(resolved["nodes"][3]["modalities"][0],
            json::parse(R"({ "from": "edges", "weight": 2.0 })"));
  const json& origins = resolved["origins"];
  EXPECT_EQ(origins["/nodes/1/directions"], "--set /nodes/edges/directions=6");
  EXPECT_EQ(origins["/nodes/1/sigma_px"], "p.json:3:31");
  EXPECT_EQ(origins["/nodes/3/shape/radii_m/0"], "default");
  EXPECT_EQ(origins["/nodes/6/affinities/0/sigma_m"], "p.json:8:84");
  EXPECT_EQ(origins["/nodes/1/from/Frames"], "default");
  EXPECT_EQ(origins["/seed"], "default");
  EXPECT_FALSE(origins.contains("/description"));
  for (const auto& [pointer, origin] : origins.items()) {
    EXPECT_TRUE(resolved.contains(json::json_pointer(pointer)))
        << pointer << " has an origin but no value";
  }
}

TEST_F(ResolvedTest, IsAPipelineThatGivesTheSame) {
  const ResolvedPipeline first =
      read_nodes(kWholeNodes, {"/seed=3", "/nodes/report/logo=logo.png"});
  json once = first.resolved_json();
  const json twice = read(once.dump(), {}, "elsewhere/resolved.json").resolved_json();
  json again = twice;
  once.erase("origins");
  again.erase("origins");
  EXPECT_EQ(once, again);
  EXPECT_EQ(once["nodes"][8]["logo"], (folder_ / "logo.png").string());
}

TEST_F(ResolvedTest, UnconnectedInputsStaySo) {
  const ResolvedPipeline pipeline =
      read_nodes(R"({ "use": "synthetic" }, { "use": "boxes" }, { "use": "gnn" },
      { "use": "overlay", "from": { "GroundTruth": null } })");
  const ResolvedPipeline again = read(pipeline.resolved_json().dump());
  EXPECT_EQ(again.nodes[3].inputs[2].node, -1);
}

class GraphTest : public PipelineFixture {};

TEST_F(GraphTest, ShowsNodesWiresAndParts) {
  const std::string dot = graph_dot(read_nodes(kWholeNodes, {"/name=A \"quoted\" \\ name"}));
  EXPECT_THAT(dot, HasSubstr("label=\"A \\\"quoted\\\" \\\\ name\""));
  EXPECT_THAT(dot, HasSubstr("n0 [label=\"cameras\\nsynthetic\""));
  EXPECT_THAT(dot, HasSubstr("n0 -> n1 [label=\"Frames\"]"));
  EXPECT_THAT(dot, HasSubstr("n2 -> n3 [label=\"ForegroundMask\\nEvidence\"]"));
  EXPECT_THAT(dot, HasSubstr("n6 -> n6_1 [style=dashed, arrowhead=none, label=\"affinities\"]"));
  EXPECT_THAT(dot, HasSubstr("n6_1 [shape=box, style=rounded, label=\"appearance\"]"));
}

TEST_F(GraphTest, IsAcceptedByGraphviz) {
  if (std::system("dot -V > /dev/null 2>&1") != 0) GTEST_SKIP() << "graphviz is not installed";
  write("g.dot", graph_dot(read_nodes(kWholeNodes, {"/name=A \"quoted\" \\ name"})));
  EXPECT_EQ(std::system("dot -Tsvg g.dot -o g.svg > /dev/null 2>&1"), 0);
}

TEST_F(GraphTest, TheTableSaysWhoReadsWhat) {
  EXPECT_EQ(
      wiring_table(read_nodes(
          R"({ "use": "synthetic", "name": "cameras" }, { "use": "boxes" }, { "use": "histogram" })")),
      "  cameras    synthetic\n"
      "  boxes      boxes      Frames from cameras\n"
      "  histogram  histogram  Frames from cameras, Observations from boxes\n");
}

class ComponentTextTest : public PipelineFixture {};

TEST_F(ComponentTextTest, TellsEverythingDeclared) {
  const std::string text = component_text(*registry_.find("gnn"));
  for (const char* part :
       {"gnn, an associator", "Assigns observations frame by frame.", "Observations", "Tracklets",
        "gate_m", "real", " m ", "1.0", "> 0, <= 10", "thesis (6.1)", "new | keep", "motion part",
        "constant-velocity", "it has memory"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(component_text(*registry_.find("scores")),
              testing::AllOf(HasSubstr("MOTA"), HasSubstr("higher is better")));
  EXPECT_THAT(component_text(*registry_.find("overlay")), HasSubstr("optional"));
  EXPECT_THAT(component_text(*registry_.find("video")), HasSubstr("required"));
  EXPECT_THAT(component_text(*registry_.find("cylinder")), HasSubstr("a part of other components"));
}

TEST_F(ComponentTextTest, JsonHoldsTheSame) {
  const json gate = component_json(*registry_.find("gnn"))["parameters"][0];
  EXPECT_EQ(gate["name"], "gate_m");
  EXPECT_EQ(gate["above"], 0);
  EXPECT_EQ(gate["at_most"], 10);
  EXPECT_EQ(gate["default"], 1.0);
  EXPECT_EQ(gate["unit"], "m");
  EXPECT_EQ(component_json(*registry_.find("grid"))["parameters"][3]["fields"][0]["name"],
            "weight");
  EXPECT_EQ(component_json(*registry_.find("scores"))["metrics"][0]["better"], "higher");
}

class SchemaTest : public PipelineFixture {
 protected:
  /// What python's jsonschema says of each document ('y' or 'n'); nothing when it is not installed.
  std::string verdicts(const std::vector<std::string>& documents) const {
    write("schema.json", pipeline_schema(registry_).dump());
    json all = json::array();
    for (const std::string& document : documents) all.push_back(json::parse(document));
    write("documents.json", all.dump());
    write("validate.py",
          "import json, jsonschema\n"
          "schema = json.load(open('schema.json'))\n"
          "jsonschema.Draft7Validator.check_schema(schema)\n"
          "validator = jsonschema.Draft7Validator(schema)\n"
          "documents = json.load(open('documents.json'))\n"
          "open('verdicts', 'w').write(''.join('ny'[validator.is_valid(d)] for d in documents))\n");
    if (std::system("python3 -W ignore validate.py > /dev/null 2>&1") != 0) return {};
    std::ifstream in("verdicts");
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  static bool has_validator() {
    return std::system("python3 -c 'import jsonschema' > /dev/null 2>&1") == 0;
  }
};

TEST_F(SchemaTest, DescribesEveryComponentForEditors) {
  const json schema = pipeline_schema(registry_);
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
  const json& sigma = schema["definitions"]["component.edges"]["properties"]["sigma_px"];
  EXPECT_EQ(sigma["type"], "number");
  EXPECT_EQ(sigma["exclusiveMinimum"], 0);
  EXPECT_EQ(sigma["default"], 3.0);
  EXPECT_EQ(sigma["description"], "tolerance; in px; > 0; source: thesis (4.1)");
  EXPECT_EQ(schema["definitions"]["component.edges"]["additionalProperties"], false);
  const json& uses = schema["definitions"]["node"]["properties"]["use"]["enum"];
  EXPECT_NE(std::find(uses.begin(), uses.end(), "edges"), uses.end());
  EXPECT_EQ(std::find(uses.begin(), uses.end(), "cylinder"), uses.end()) << "parts are no nodes";
  EXPECT_TRUE(schema["definitions"].contains("part.affinity"));
  EXPECT_EQ(schema["else"]["required"], json::parse(R"(["plaza", "scene", "nodes"])"));
}

TEST_F(SchemaTest, AcceptsWhatTheReaderAccepts) {
  if (!has_validator()) GTEST_SKIP() << "python3-jsonschema is not installed";
  EXPECT_EQ(
      verdicts({with_nodes(kWholeNodes), read_nodes(kWholeNodes).resolved_json().dump(),
                R"({ "extends": "b.json", "nodes": [ { "name": "edges", "use": null },
                           { "name": "x", "sigma": 1 }, { "use": "video", "after": "x" } ] })",
                with_nodes(R"({ "use": "video", "files": { "a": "b" }, "frame_rate_hz": null })")}),
      "yyyy");
}

TEST_F(SchemaTest, RefusesWhatTheReaderRefuses) {
  if (!has_validator()) GTEST_SKIP() << "python3-jsonschema is not installed";
  std::vector<std::string> documents = {
      R"({ "plaza": 1, "scene": "s", "nodes": [] })",
      R"({ "plaza": 2, "scene": "s", "nodes": [ { "use": "synthetic" } ] })"};
  for (const char* nodes :
       {R"({ "use": "synthetic", "frames": 0 })", R"({ "use": "synthetic", "frame": 3 })",
        R"({ "use": "video" })", R"({ "use": "cylinder" })", R"({ "use": "synthetik" })",
        R"({ "use": "synthetic", "scenario": "run" })", R"({ "use": "synthetic", "frames": 2.5 })",
        R"({ "use": null, "name": "a" })", R"({ "name": "a" })",
        R"({ "use": "color", "bins": [8, 8] })",
        R"({ "use": "gnn", "motion": { "use": "location" } })",
        R"({ "use": "grid", "modalities": [ { "weight": 1 } ] })",
        R"({ "use": "synthetic", "name": "A" })"}) {
    documents.push_back(with_nodes(nodes));
    EXPECT_NE(node_errors(nodes), "no error") << nodes;
  }
  EXPECT_EQ(verdicts(documents), std::string(documents.size(), 'n'));
}

}  // namespace
}  // namespace plaza::test
