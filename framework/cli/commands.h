#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace plaza {

class CliContext;

/// Each function adds one command to the program: its options, help text and what it does (a
/// callback on the subcommand, which may refer to `context`: both live as long as the program).
/// Commands throw UserError and InternalError; main() turns them into exit status 2 and 3. A
/// command that ends otherwise sets context.exit_status. The function of command NAME stands in
/// NAME_command.cc.
void add_run_command(CLI::App& app, CliContext& context);
void add_check_command(CLI::App& app, CliContext& context);
void add_graph_command(CLI::App& app, CliContext& context);
void add_list_command(CLI::App& app, CliContext& context);
void add_show_command(CLI::App& app, CliContext& context);
void add_plugins_command(CLI::App& app, CliContext& context);
void add_eval_command(CLI::App& app, CliContext& context);
void add_study_command(CLI::App& app, CliContext& context);
void add_study_job_command(CLI::App& app, CliContext& context);
void add_cache_command(CLI::App& app, CliContext& context);
void add_help_command(CLI::App& app, CliContext& context);

/// The option of all commands that read a pipeline: "--set POINTER=VALUE", once per value.
void add_set_option(CLI::App& command, std::vector<std::string>& sets);

}  // namespace plaza
