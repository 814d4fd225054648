#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "framework/cache/cache_folder.h"
#include "framework/cli/commands.h"
#include "framework/cli/context.h"
#include "framework/cli/interrupt.h"
#include "framework/cli/run_report.h"
#include "framework/config/frame_range.h"
#include "framework/config/pipeline.h"
#include "framework/execution/run.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

struct RunArguments {
  std::string pipeline;
  std::vector<std::string> sets;
  std::string frames;
  std::string out;
  std::string cache;
  int threads = 0;
  bool quiet = false;
  std::string progress = "text";
};

void read_frames(const std::string& text, RunOptions& options) {
  if (text.empty()) return;
  const auto range = parse_frame_range(text);
  if (!range) {
    throw UserError("--frames " + text +
                    ": give A:B with 0 <= A < B, frames from A (the first is 0) to " +
                    "before B; either may be left out");
  }
  options.first_frame = range->first;
  options.end_frame = range->end;
}

RunOptions options_of(const RunArguments& arguments) {
  RunOptions options;
  read_frames(arguments.frames, options);
  const std::filesystem::path stem = std::filesystem::path(arguments.pipeline).stem();
  options.output_folder =
      arguments.out.empty() ? "out" / stem : std::filesystem::path(arguments.out);
  options.cache_folder =
      arguments.cache.empty() ? default_cache_folder() : std::filesystem::path(arguments.cache);
  options.threads = arguments.threads;
  options.progress = ProgressStyle::kTerminal;
  if (arguments.progress == "json") options.progress = ProgressStyle::kJsonLines;
  if (arguments.quiet) options.progress = ProgressStyle::kQuiet;
  return options;
}

void run(const RunArguments& arguments, CliContext& context) {
  const RunOptions options = options_of(arguments);
  const InterruptScope interrupt;  // before anything that takes long
  const auto [pipeline, scene] = read_pipeline_in_scene(
      {.file = arguments.pipeline, .sets = arguments.sets}, context.registry());
  const RunReport report = run_pipeline(pipeline, scene, options);
  for (const std::string& note : report.notes) std::cerr << "plaza: note: " << note << '\n';
  if (options.progress == ProgressStyle::kJsonLines) {
    print_report_json(std::cout, report, options.output_folder);
  } else if (options.progress != ProgressStyle::kQuiet) {
    print_report(std::cout, report, pipeline, options.output_folder);
  }
  if (!report.complete) {
    std::cerr << "plaza: " << report.stop_reason << "; what is in "
              << options.output_folder.string() << " is valid and says that it is partial\n";
    context.exit_status = interrupt.exit_status();
  }
}

}  // namespace

void add_run_command(CLI::App& app, CliContext& context) {
  CLI::App* command = app.add_subcommand("run", "Run a pipeline and write its results");
  const auto arguments = std::make_shared<RunArguments>();
  command->add_option("PIPELINE", arguments->pipeline, "The pipeline's JSON file")->required();
  add_set_option(*command, arguments->sets);
  command->add_option("--frames", arguments->frames, "Frames A (from 0) to before B")
      ->type_name("A:B");
  command->add_option("--out", arguments->out, "Output folder; default: out/<name of the file>")
      ->type_name("DIR");
  command
      ->add_option("--threads", arguments->threads,
                   "Threads; 1: in sequence, the reference; default: all cores")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command
      ->add_option(
          "--cache-dir", arguments->cache,
          "Where learned models are kept; default: $XDG_CACHE_HOME/plaza or ~/.cache/plaza")
      ->type_name("DIR");
  command
      ->add_option("--progress", arguments->progress,
                   "text, or json: JSON lines on standard output")
      ->check(CLI::IsMember({"text", "json"}))
      ->type_name("STYLE");
  command->add_flag("--quiet", arguments->quiet, "Print nothing but errors");
  command->footer(
      "Writes tracks.<camera>.txt, tracks.ground.csv, observations.ground.csv, resolved.json and\n"
      "summary.json. Ctrl-C ends the run cleanly with what is complete; a second one at once.");
  command->callback([arguments, &context] { run(*arguments, context); });
}

}  // namespace plaza
