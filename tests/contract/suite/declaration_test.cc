#include <gmock/gmock.h>

#include <functional>

#include "plaza/contract/contract.h"

namespace plaza::contract {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

ComponentDeclaration good() {
  ComponentDeclaration d;
  d.name = "good-one";
  d.kind = "detector";
  d.summary = "Finds people";
  d.inputs = {{"Frames", true, "images"}};
  d.outputs = {{"Observations", true, "people"}};
  ParameterSpec p;
  p.name = "sigma_px";
  p.type = ParameterType::kReal;
  p.default_value = 1.5;
  p.minimum = 0;
  p.meaning = "blur";
  d.parameters = {p};
  return d;
}

TEST(DeclarationContractTest, AGoodDeclarationPasses) {
  EXPECT_THAT(declaration_violations(good()), IsEmpty());
}

TEST(DeclarationContractTest, EveryFaultIsNamed) {
  struct Case {
    const char* words;
    std::function<void(ComponentDeclaration&)> spoil;
  };
  const Case cases[] = {
      {"name is not made of", [](auto& d) { d.name = "Good_one"; }},
      {"kind \"finder\" is unknown", [](auto& d) { d.kind = "finder"; }},
      {"summary is empty", [](auto& d) { d.summary = ""; }},
      {"summary has more than one line", [](auto& d) { d.summary = "a\nb"; }},
      {"\"sigma_px\": its meaning is empty", [](auto& d) { d.parameters[0].meaning = ""; }},
      {"\"Sigma\": its name is not", [](auto& d) { d.parameters[0].name = "Sigma"; }},
      {"\"sigma_px\" stands twice", [](auto& d) { d.parameters.push_back(d.parameters[0]); }},
      {"name that pipelines use themselves", [](auto& d) { d.parameters[0].name = "from"; }},
      {"default -1.0 is outside its range", [](auto& d) { d.parameters[0].default_value = -1.0; }},
      {"is outside its range",
       [](auto& d) {
         d.parameters[0].minimum_exclusive = true;
         d.parameters[0].default_value = 0.0;
       }},
      {"default \"x\" has another type", [](auto& d) { d.parameters[0].default_value = "x"; }},
      {"its range is empty", [](auto& d) { d.parameters[0].maximum = -3; }},
      {"is required and has a default", [](auto& d) { d.parameters[0].required = true; }},
      {"is none of its choices",
       [](auto& d) {
         d.parameters[0].type = ParameterType::kChoice;
         d.parameters[0].choices = {"a", "b"};
         d.parameters[0].default_value = "c";
       }},
      {"parts of the unknown kind \"hat\"",
       [](auto& d) {
         d.parameters[0].type = ParameterType::kPart;
         d.parameters[0].default_value = {{"use", "bowler"}};
         d.parameters[0].part_kind = "hat";
       }},
      {"is outside its range",
       [](auto& d) {
         ParameterSpec list;
         list.name = "angles";
         list.type = ParameterType::kList;
         list.meaning = "angles";
         list.element = {d.parameters[0]};
         list.default_value = {1.0, -2.0};
         d.parameters = {list};
       }},
      {"feature \"Hue\": its name is not made",
       [](auto& d) {
         d.features = {{"Hue", "colour"}};
       }},
      {"feature \"hue\": its meaning is empty",
       [](auto& d) {
         d.features = {{"hue", ""}};
       }},
      {"feature \"hue\" stands twice",
       [](auto& d) {
         d.features = {{"hue", "colour"}, {"hue", "colour"}};
       }},
      {"declares features, but gives neither",
       [](auto& d) {
         d.features = {{"hue", "colour"}};
         d.outputs = {{"Detections", true, "people"}};
       }},
      {"the meaning of input Frames is empty", [](auto& d) { d.inputs[0].meaning = ""; }},
      {"output Observations stands twice", [](auto& d) { d.outputs.push_back(d.outputs[0]); }},
      {"output 0 is not Observations", [](auto& d) { d.outputs[0].type = "Tracks"; }},
      {"must not read the ground truth",
       [](auto& d) {
         d.inputs.push_back({"GroundTruth", false, "cheating"});
       }},
      {"has no memory between frames", [](auto& d) { d.memory = true; }},
      {"declares memory without giving one",
       [](auto& d) {
         d.kind = "modality";
         d.memory = true;
       }},
      {"only evaluators declare metrics",
       [](auto& d) {
         d.metrics = {{"s", "M", "", Better::kHigher, "m"}};
       }},
      {"declares no metric",
       [](auto& d) {
         d.kind = "evaluator";
         d.memory = true;
       }},
      {"has no outputs", [](auto& d) { d.kind = "sink"; }},
      {"a source has no inputs", [](auto& d) { d.kind = "source"; }},
      {"input 0 is not Observations", [](auto& d) { d.kind = "describer"; }},
      {"output 0 is not Evidence", [](auto& d) { d.kind = "modality"; }},
      {"input 1 is not Tracks", [](auto& d) { d.kind = "renderer"; }},
      {"output 0 is not Tracks", [](auto& d) { d.kind = "associator"; }},
  };
  for (const Case& c : cases) {
    ComponentDeclaration d = good();
    c.spoil(d);
    EXPECT_THAT(declaration_violations(d), Contains(HasSubstr(c.words))) << c.words;
  }
}

}  // namespace
}  // namespace plaza::contract
