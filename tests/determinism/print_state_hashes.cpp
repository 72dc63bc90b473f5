// Prints the hash of the end of each run, "HASH NAME" a line; with --supernodal that of the run that depends on the
// BLAS.

#include <cstdio>
#include <exception>
#include <string_view>

#include "tests/determinism/state_hashes.h"

int main(int argc, char** argv) {
  using namespace dartboard;
  try {
    if (argc == 2 && std::string_view(argv[1]) == "--supernodal") {
      std::printf("%016llx a supernodal factor\n", static_cast<unsigned long long>(hash_with_supernodal_factor()));
      return 0;
    }
    if (argc != 1) {
      std::fputs("usage: state_hashes [--supernodal]\n", stderr);
      return 2;
    }
    bool equal = true;
    for (const HashedRun& run : hashed_runs()) {
      const std::uint64_t hash = run.run();
      std::printf("%016llx %s\n", static_cast<unsigned long long>(hash), run.name.c_str());
      equal = equal && hash == run.pinned;
    }
    return equal ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "state_hashes: %s\n", error.what());
    return 1;
  }
}
