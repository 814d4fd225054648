#pragma once

namespace CLI {
class App;
}

namespace plaza {

/// Each function adds one command to the program: its options, help text and what it does.
/// Commands throw UserError and InternalError; main() turns them into exit status 2 and 3.
void add_run_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_graph_command(CLI::App& app);
void add_list_command(CLI::App& app);
void add_show_command(CLI::App& app);
void add_plugins_command(CLI::App& app);
void add_eval_command(CLI::App& app);
void add_help_command(CLI::App& app);

}  // namespace plaza
