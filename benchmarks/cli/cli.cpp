#include "benchmarks/cli/cli.h"

#include <fmt/format.h>

#include <cmath>

namespace dartboard {

CLI::Validator positive_number() {
  return {[](std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && value > 0.0 && std::isfinite(value);
            return good ? std::string{} : fmt::format("'{}' is not a number above 0", text);
          },
          "ABOVE 0"};
}

}  // namespace dartboard
