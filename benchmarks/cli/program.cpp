#include "benchmarks/cli/program.h"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <system_error>

#include "benchmarks/cli/option_checks.h"
#include "benchmarks/cli/verb_names.h"
#include "benchmarks/harness/tell.h"
#include "core/plain/error.h"
#include "core/time/solve/stop_request.h"

namespace dartboard {
namespace {

constexpr std::size_t longest_message = 2000;  // letters

// CLI11 would answer "a subcommand is required" to a misspelt verb.
void require_known_verb(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  for (const CLI::App* verb : app.get_subcommands({}))  // hidden ones, too
    if (verb->get_name() == argv[1]) return;
  std::string verbs;
  for (const VerbName& verb : verb_names) verbs += (verbs.empty() ? "" : ", ") + std::string(verb.name);
  throw InputError(fmt::format("there is no verb '{}'; the verbs are {}", argv[1], verbs));
}

/// Printed text may still wait in a buffer, for a disk that is full or a reader that is gone.
/// returns  `exit_code`, or that of a failure when standard output did not take everything
int written_out(int exit_code) {
  if (exit_code > 128) {  // ended by a signal, perhaps because the terminal is gone
    std::fflush(stdout);
    return exit_code;
  }
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return exit_code;
  if (exit_code == exit_io) return exit_io;  // reported already
  const std::string reason = errno == 0 ? "" : ": " + std::generic_category().message(errno);
  tell(stderr, "dartboard: standard output cannot be written{}\n", reason);
  return exit_io;
}

int answer(int argc, char** argv, const std::function<void(CLI::App&, Outcome&)>& add_verbs) {
  Outcome outcome;
  outcome.command_line.emplace_back("dartboard");
  for (int k = 1; k < argc; ++k) outcome.command_line.emplace_back(argv[k]);

  CLI::App app("Scores a topology-based mechanical simulator on truth, speed and stability.", "dartboard");
  app.require_subcommand(1);
  app.set_version_flag("--version", DARTBOARD_VERSION);
  app.footer(
      "Exit status: 0 agrees, 1 disagrees, 2 wrong usage, 3 input or output failed, or a picture could not be drawn.");
  for (const VerbName& verb : verb_names) app.add_subcommand(std::string(verb.name), std::string(verb.help));

  try {
    add_verbs(app, outcome);
    check_common_options(app);
    require_known_verb(app, argc, argv);
    app.parse(argc, argv);
    return outcome.exit_code;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    tell(stderr, "dartboard: {}\nRun with --help for more information.\n", one_line(error.what(), longest_message));
    return exit_usage;
  } catch (const InputError& error) {
    tell(stderr, "dartboard: {}\n", one_line(error.what(), longest_message));
    return exit_usage;
  } catch (const std::exception& error) {  // IoError, and exceptions of the system when a disk or a process fails
    tell(stderr, "dartboard: {}\n", one_line(error.what(), longest_message));
    return exit_io;
  }
}

}  // namespace

int run_program(int argc, char** argv, const std::function<void(CLI::App&, Outcome&)>& add_verbs) {
  const int exit_code = written_out(answer(argc, argv, add_verbs));
  // an abandoned factorisation may still use memory that the end of the process would free
  if (work_left_behind()) std::_Exit(exit_code);
  return exit_code;
}

}  // namespace dartboard
