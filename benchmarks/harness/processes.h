#pragma once
// Child processes, run one after the other, their standard output read line by line.

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dartboard {

/// A child process could not be started, ended with another status than 0, or was killed; the message names the command
/// and the status.
struct ProcessError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Takes one line of output, without its newline.
using LineSink = std::function<void(std::string_view line)>;

enum class Stderr { shown, discarded, as_output };

/// Run a program, searched in PATH unless it holds a slash, and wait for its end. No shell comes in between, so nothing
/// in an argument needs quoting. Standard input is empty. It runs in `folder`, or in the working folder.
///
/// throws  ProcessError; whatever `on_line` throws, after the child has been killed
void run_program(const std::string& program, const std::vector<std::string>& arguments, const LineSink& on_line,
                 Stderr errors = Stderr::shown, const std::filesystem::path& folder = {});

/// Run the executable that is now running, again. It is reached through /proc/self/exe: still the same file when a
/// build has replaced it meanwhile, so a study never mixes two builds.
void run_self(const std::vector<std::string>& arguments, const LineSink& on_line);

}  // namespace dartboard
