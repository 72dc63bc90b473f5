#include "benchmarks/cli/option_checks.h"

#include <fmt/format.h>

#include <charconv>
#include <string>
#include <system_error>

namespace dartboard {

CLI::Validator whole_number(std::uint64_t most) {
  return {[most](std::string& text) {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            const bool good = error == std::errc() && stop == end && value <= most;
            return good ? std::string{} : fmt::format("'{}' is not a whole number from 0 to {}", text, most);
          },
          "WHOLE"};
}

void check_common_options(CLI::App& app) {
  const CLI::Validator not_empty([](std::string& text) { return text.empty() ? "is empty" : std::string{}; }, "");
  for (CLI::App* verb : app.get_subcommands({})) check_common_options(*verb);
  for (CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->check_lname("out"); }))
    option->check(not_empty);
  for (CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->check_lname("steps"); }))
    option->check(whole_number(1000000000000));
  // as in scenes: numbers that every reader of JSON reads exactly
  for (CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->check_lname("seed"); }))
    option->check(whole_number((std::uint64_t{1} << 53) - 1));
}

}  // namespace dartboard
