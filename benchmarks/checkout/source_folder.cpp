#include "benchmarks/checkout/source_folder.h"

namespace dartboard {

std::filesystem::path source_folder() { return DARTBOARD_SOURCE_DIR; }

}  // namespace dartboard
