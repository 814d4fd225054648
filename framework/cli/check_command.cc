#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "framework/cli/commands.h"
#include "framework/cli/context.h"
#include "framework/config/graph_dot.h"
#include "framework/config/json_document.h"
#include "framework/config/pipeline.h"
#include "framework/scene/draw.h"
#include "framework/scene/scene_file.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

struct CheckArguments {
  std::filesystem::path file;
  std::vector<std::string> sets;
  std::filesystem::path draw;
};

/// A scene has cameras and a pipeline has not; the two are told apart by what they say, not by
/// their names.
bool is_scene(const std::filesystem::path& file) {
  const nlohmann::json root = read_json(file).root;
  return root.is_object() && root.contains("cameras") && !root.contains("nodes") &&
         !root.contains("extends");
}

std::string cameras_text(const Scene& scene) {
  std::string text;
  for (const Camera& camera : scene.cameras) text += (text.empty() ? "" : ", ") + camera.name();
  return text;
}

void check(const CheckArguments& arguments, CliContext& context) {
  std::shared_ptr<const Scene> scene;
  if (is_scene(arguments.file)) {
    if (!arguments.sets.empty())
      throw UserError("--set is for pipelines; " + arguments.file.string() + " is a scene");
    scene = read_scene(arguments.file);
    std::cout << arguments.file.string() << ": ok, a scene of " << scene->cameras.size()
              << (scene->cameras.size() == 1 ? " camera: " : " cameras: ") << cameras_text(*scene)
              << '\n';
  } else {
    const PipelineInScene read =
        read_pipeline_in_scene({arguments.file, arguments.sets}, context.registry());
    const ResolvedPipeline& pipeline = read.pipeline;
    scene = read.scene;
    assemble(pipeline, scene, {});
    std::cout << arguments.file.string() << ": ok, " << pipeline.name << "\n  scene "
              << pipeline.scene_file.string() << ", cameras " << cameras_text(*scene) << "\n\n"
              << wiring_table(pipeline);
  }
  if (!arguments.draw.empty()) {
    draw_scene_grid(*scene, arguments.draw);
    std::cout << "ground grid drawn into each view: " << arguments.draw.string() << '\n';
  }
}

}  // namespace

void add_check_command(CLI::App& app, CliContext& context) {
  CLI::App* command = app.add_subcommand(
      "check", "Check a pipeline or a scene and everything it needs; compute nothing");
  const auto arguments = std::make_shared<CheckArguments>();
  command->add_option("FILE", arguments->file, "A pipeline's or a scene's JSON file")->required();
  add_set_option(*command, arguments->sets);
  command
      ->add_option("--draw", arguments->draw,
                   "Draw the scene's ground grid into a picture of each view, written to DIR")
      ->type_name("DIR");
  command->footer(
      "Prints every fault with file, line, column and remedy, and ends with status 2; else who "
      "reads what\n"
      "from whom.");
  command->callback([arguments, &context] { check(*arguments, context); });
}

}  // namespace plaza
