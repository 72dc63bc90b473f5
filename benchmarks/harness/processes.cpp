#include "benchmarks/harness/processes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace dartboard {
namespace {

/// Both ends of a pipe; children inherit neither by default.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
  }
  ~Pipe() {
    close_write_end();
    ::close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_write_end() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// The targets of a child's three standard streams, and the folder that it runs in.
class Surroundings {
 public:
  Surroundings(int standard_output, Stderr errors, const std::filesystem::path& folder) {
    check(posix_spawn_file_actions_init(&actions_));
    check(posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0));
    check(posix_spawn_file_actions_adddup2(&actions_, standard_output, STDOUT_FILENO));
    if (errors == Stderr::discarded)
      check(posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0));
    if (errors == Stderr::as_output) check(posix_spawn_file_actions_adddup2(&actions_, standard_output, STDERR_FILENO));
    if (!folder.empty()) check(posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()));
  }
  ~Surroundings() { posix_spawn_file_actions_destroy(&actions_); }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  static void check(int error) {
    if (error != 0) throw std::system_error(error, std::generic_category(), "cannot prepare a child");
  }
  posix_spawn_file_actions_t actions_;
};

/// A started process, which is killed if it goes out of scope before its end was awaited.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int wait() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0)
      if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "cannot wait for a child");
    pid_ = -1;
    return status;
  }

 private:
  pid_t pid_;
};

std::string command_line(const std::string& program, const std::vector<std::string>& arguments) {
  return arguments.empty() ? program : fmt::format("{} {}", program, fmt::join(arguments, " "));
}

pid_t spawn(const std::string& path, const std::string& name, const std::vector<std::string>& arguments,
            const Surroundings& surroundings) {
  // the child's arguments are not modified: the missing const is C's
  std::vector<char*> argv{const_cast<char*>(name.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t pid = -1;
  const int error = posix_spawnp(&pid, path.c_str(), surroundings.get(), nullptr, argv.data(), environ);
  if (error != 0)
    throw ProcessError(fmt::format("cannot start `{}`: {}", command_line(name, arguments), std::strerror(error)));
  return pid;
}

void read_lines(int descriptor, const LineSink& on_line) {
  std::string rest;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::system_error(errno, std::generic_category(), "cannot read what a child prints");
    if (got == 0) break;
    rest.append(buffer.data(), static_cast<std::size_t>(got));
    std::size_t start = 0;
    for (std::size_t end; (end = rest.find('\n', start)) != std::string::npos; start = end + 1)
      on_line(std::string_view(rest).substr(start, end - start));
    rest.erase(0, start);
  }
  if (!rest.empty()) on_line(rest);
}

/// Like run_program, but the name that the child sees as its own may differ from its path.
void run(const std::string& path, const std::string& name, const std::vector<std::string>& arguments,
         const LineSink& on_line, Stderr errors, const std::filesystem::path& folder = {}) {
  Pipe pipe;
  Child child(spawn(path, name, arguments, Surroundings(pipe.write_end(), errors, folder)));
  // the end of the output is only seen once no writer is left, this process included
  pipe.close_write_end();
  read_lines(pipe.read_end(), on_line);
  const int status = child.wait();
  if (WIFSIGNALED(status))
    throw ProcessError(fmt::format("`{}` was killed by signal {} ({})", command_line(name, arguments), WTERMSIG(status),
                                   strsignal(WTERMSIG(status))));
  if (WEXITSTATUS(status) != 0)
    throw ProcessError(
        fmt::format("`{}` ended with status {}, expected 0", command_line(name, arguments), WEXITSTATUS(status)));
}

}  // namespace

void run_program(const std::string& program, const std::vector<std::string>& arguments, const LineSink& on_line,
                 Stderr errors, const std::filesystem::path& folder) {
  run(program, program, arguments, on_line, errors, folder);
}

void run_self(const std::vector<std::string>& arguments, const LineSink& on_line) {
  const std::string self = "/proc/self/exe";
  const std::string name = std::filesystem::read_symlink(self).filename().string();
  run(self, name, arguments, on_line, Stderr::shown);
}

}  // namespace dartboard
