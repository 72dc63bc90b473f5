#pragma once
// Progress on standard error: one line rewritten in place on a terminal, a plain line now and then elsewhere.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dartboard {

/// Counts steps up to `total`, and says how long the rest will take; counts alone where the total is not known and 0. A
/// log gets at most one line every two seconds, a terminal ten updates a second; the last step is always shown.
class Progress {
 public:
  Progress(std::string label, std::size_t total, bool quiet = false);
  /// Ends the line that was being rewritten, so that what is printed next starts on its own.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more step is done; `detail` says in a few words which.
  void advance(std::string_view detail = "");
  /// Print at once how many are done, and what is being done.
  void show(std::string_view detail);

 private:
  void print(std::string_view detail);

  std::string label_;
  std::size_t total_, done_ = 0;
  bool quiet_, terminal_, line_open_ = false;
  std::int64_t start_ns_, first_ns_ = 0, next_print_ns_ = 0;
};

/// ", about 40 s left", once there is something to go by: half a second and a step.
std::string time_left(std::size_t done, std::size_t total, double elapsed_s);

}  // namespace dartboard
