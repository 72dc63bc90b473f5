#pragma once
// The program, run as a user runs it.

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace dartboard {

struct Answer {
  int status = -1;
  std::string out;  // standard output and error together
};

/// The program under test, and the file with the allowed includes between folders: absolute paths.
const std::string& program_path();
const std::string& folders_file();

/// Runs a program with the arguments, through a shell.
inline Answer run_at(const std::string& program, const std::string& arguments, const char* redirect = "2>&1") {
  const std::string command = program + " " + arguments + " " + redirect;
  FILE* pipe = popen(command.c_str(), "r");
  Answer answer;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) answer.out.append(buffer.data(), n);
  const int status = pclose(pipe);
  answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return answer;
}
/// Runs the program under test.
inline Answer run(const std::string& arguments, const char* redirect = "2>&1") {
  return run_at(program_path(), arguments, redirect);
}

}  // namespace dartboard
