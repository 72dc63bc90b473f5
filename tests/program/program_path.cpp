#include "tests/support/program_for_tests.h"

namespace dartboard {

// The build defines both for this source alone: they differ between checkouts, and so would every object compiled with
// them.
const std::string& program_path() {
  static const std::string path = DARTBOARD_BINARY;
  return path;
}
const std::string& folders_file() {
  static const std::string path = DARTBOARD_FOLDERS;
  return path;
}

}  // namespace dartboard
