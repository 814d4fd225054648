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
#include "framework/execution/stop.h"
#include "framework/study/child_process.h"
#include "framework/study/report/report_files.h"
#include "framework/study/run_study.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

struct StudyArguments {
  std::string study;
  std::string out;
  std::string cache;
  std::optional<double> cache_limit_gb;
  int jobs = 1;
  std::string launcher = "local";
  std::string hosts;
  bool check = false;
  bool retry = false;
  bool quiet = false;
};

StudyOptions options_of(const StudyArguments& arguments, const CliContext& context) {
  StudyOptions options;
  const std::filesystem::path stem = std::filesystem::path(arguments.study).stem();
  options.out = arguments.out.empty() ? "out" / stem : std::filesystem::path(arguments.out);
  options.cache_folder =
      arguments.cache.empty() ? default_cache_folder() : std::filesystem::path(arguments.cache);
  options.jobs = arguments.jobs;
  options.cache_limit_gb = arguments.cache_limit_gb;
  if (arguments.launcher == "slurm") options.launcher = launch_slurm;
  if (arguments.launcher == "parallel") options.launcher = launch_parallel;
  if (!arguments.hosts.empty() && arguments.launcher != "parallel") {
    throw UserError("--hosts is for --launcher parallel");
  }
  options.hosts = arguments.hosts;
  options.retry = arguments.retry;
  options.quiet = arguments.quiet;
  options.program = {own_program().string()};
  for (const std::string& path : context.plugin_paths) {
    options.program.insert(options.program.end(),
                           {"--plugin-path", std::filesystem::absolute(path).string()});
  }
  return options;
}

void check_study(const StudyArguments& arguments, CliContext& context) {
  const PreparedStudy prepared = prepare_study(read_study(arguments.study), context.registry());
  std::cout << arguments.study << ": ok, " << prepared.study.name << "\n  "
            << prepared.expansion.variants.size() << " variants, " << prepared.jobs.size()
            << " runs, " << prepared.metrics.size() << " metrics\n";
}

void study(const StudyArguments& arguments, CliContext& context) {
  if (arguments.check) return check_study(arguments, context);
  const StudyOptions options = options_of(arguments, context);
  const InterruptScope interrupt;
  struct Clear {  // a stop that was asked for is over with this study
    ~Clear() { clear_stop_request(); }
  } const clear;
  const auto end = run_study(arguments.study, options, context.registry());
  if (!arguments.quiet) {
    std::cout << report_text(end->results) << "See " << options.out.string()
              << ": report.html, report.md, results.csv, times.csv, jobs/\n";
  }
  if (stop_requested()) {
    std::cerr << "plaza: interrupted; the same command goes on where this one ended\n";
    context.exit_status = interrupt.exit_status();
  } else if (!end->complete) {
    std::cerr << "plaza: some runs have no result; the same command tries them again\n";
    context.exit_status = kExitInternalError;
  }
}

}  // namespace

void add_study_command(CLI::App& app, CliContext& context) {
  CLI::App* command =
      app.add_subcommand("study", "Run variants of a pipeline and compare their figures");
  const auto arguments = std::make_shared<StudyArguments>();
  command->add_option("STUDY", arguments->study, "The study's JSON file")->required();
  command
      ->add_option("--out", arguments->out,
                   "Output folder; default: out/<name of the file>. What is done there already is "
                   "not done again")
      ->type_name("DIR");
  command->add_option("--jobs", arguments->jobs, "Runs at a time; default: 1")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command
      ->add_option(
          "--launcher", arguments->launcher,
          "local: processes of this machine; slurm: a job array on a cluster; parallel: GNU "
          "parallel. The last two need the output folder, the cache and plaza itself on a "
          "file system that all machines share")
      ->check(CLI::IsMember({"local", "slurm", "parallel"}))
      ->type_name("ENGINE");
  command
      ->add_option(
          "--hosts", arguments->hosts,
          "With --launcher parallel: ssh hosts, as its --sshlogin takes them (4/host1,host2; "
          "\":\" is this machine)")
      ->type_name("HOSTS");
  command
      ->add_option("--cache-dir", arguments->cache,
                   "Where results of nodes and learned models are kept; default: "
                   "$XDG_CACHE_HOME/plaza or ~/.cache/plaza")
      ->type_name("DIR");
  command
      ->add_option("--cache-limit", arguments->cache_limit_gb,
                   "How large the cache may grow; default: 20 GB, or half of the free disk")
      ->check(CLI::NonNegativeNumber)
      ->type_name("GB");
  command->add_flag("--check", arguments->check, "Check all variants; compute nothing");
  command->add_flag("--retry", arguments->retry, "Run again what failed");
  command->add_flag("--quiet", arguments->quiet, "Print nothing but errors");
  command->footer(
      "All variants are checked before anything is computed. Each run is a process of its own: one "
      "that\nfails is a line in the report. An interrupted study goes on with the same command and "
      "ends with\nthe same tables. The language of studies: docs/studies.md");
  command->callback([arguments, &context] { study(*arguments, context); });
}

}  // namespace plaza
