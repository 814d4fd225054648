#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "framework/cache/cache_folder.h"
#include "framework/cli/commands.h"
#include "framework/cli/context.h"
#include "framework/cli/interrupt.h"
#include "framework/study/study_job.h"

namespace plaza {
namespace {

struct JobArguments {
  std::string folder;
  std::string cache;
  std::optional<double> cache_limit_gb;
  int threads = 1;
};

void run_job(const JobArguments& arguments, CliContext& context) {
  const InterruptScope interrupt;
  JobOptions options;
  options.folder = arguments.folder;
  options.cache_folder =
      arguments.cache.empty() ? default_cache_folder() : std::filesystem::path(arguments.cache);
  constexpr double kBytesPerGb = 1e9;
  if (arguments.cache_limit_gb) {
    options.cache_limit_bytes =
        static_cast<std::uintmax_t>(*arguments.cache_limit_gb * kBytesPerGb);
  }
  options.threads = arguments.threads;
  if (!run_study_job(options, context.registry())) context.exit_status = interrupt.exit_status();
}

}  // namespace

void add_study_job_command(CLI::App& app, CliContext& context) {
  CLI::App* command =
      app.add_subcommand("study-job", "Run one run of a study (what launchers call)");
  command->group("");  // not in the list of commands: nobody needs it by hand
  const auto arguments = std::make_shared<JobArguments>();
  command->add_option("FOLDER", arguments->folder, "The job's folder, DIR/jobs/ID of a study")
      ->required();
  command->add_option("--cache-dir", arguments->cache)->type_name("DIR");
  command->add_option("--cache-limit", arguments->cache_limit_gb)->type_name("GB");
  command->add_option("--threads", arguments->threads)->check(CLI::Range(1, 1024))->type_name("N");
  command->callback([arguments, &context] { run_job(*arguments, context); });
}

}  // namespace plaza
