// Prints the hash of the end of each run, "HASH NAME" a line; with --supernodal that of the run that depends on the
// BLAS. Several threads share large bodies with --threads N, and --one-by-one takes one number at a time.

#include <charconv>
#include <cstdio>
#include <exception>
#include <span>
#include <string_view>

#include "core/base/lanes.h"
#include "core/base/thread_team.h"
#include "tests/determinism/state_hashes.h"

namespace dartboard {
namespace {

int usage() {
  std::fputs("usage: state_hashes [--supernodal] [--threads N] [--one-by-one]\n", stderr);
  return 2;
}

int print_hash_with_supernodal_factor() {
  std::printf("%016llx a supernodal factor\n", static_cast<unsigned long long>(hash_with_supernodal_factor()));
  return 0;
}

int print_hashes() {
  bool equal = true;
  for (const HashedRun& run : hashed_runs()) {
    const std::uint64_t hash = run.run();
    std::printf("%016llx %s\n", static_cast<unsigned long long>(hash), run.name.c_str());
    equal = equal && hash == run.pinned;
  }
  return equal ? 0 : 1;
}

int print(std::span<char*> arguments) {
  bool supernodal = false;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string_view option = arguments[k];
    if (option == "--supernodal") {
      supernodal = true;
    } else if (option == "--one-by-one") {
      use_lanes(false);
    } else if (option == "--threads" && k + 1 < arguments.size()) {
      const std::string_view value = arguments[++k];
      unsigned threads = 0;
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), threads);
      if (error != std::errc{} || end != value.data() + value.size() || threads == 0) return usage();
      use_threads(threads);
    } else {
      return usage();
    }
  }
  return supernodal ? print_hash_with_supernodal_factor() : print_hashes();
}

}  // namespace
}  // namespace dartboard

int main(int argc, char** argv) {
  try {
    return dartboard::print(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "state_hashes: %s\n", error.what());
    return 1;
  }
}
