#include "benchmarks/cli/hand_over.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "core/plain/error.h"

namespace dartboard {

void hand_over_to_harness(char** argv) {
  std::vector<char*> words(argv, argv + 1);
  std::string program, flag = "--harness";
  if (const char* script = std::getenv("DARTBOARD_SCRIPT")) {
    program = script;
    words.push_back(flag.data());
  } else {
    program = std::filesystem::read_symlink("/proc/self/exe").replace_filename("dartboard-harness").string();
  }
  for (char** word = argv + 1; *word != nullptr; ++word) words.push_back(*word);
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  const int reason = errno;
  throw IoError(fmt::format("{}: {}; expected the program that has every verb, which ./dartboard build builds", program,
                            reason == ENOENT ? "is not there" : std::generic_category().message(reason)));
}

}  // namespace dartboard
