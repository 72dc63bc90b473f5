#pragma once
// Progress on standard error: one line rewritten in place on a terminal, a plain line now and then elsewhere.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dartboard {

/// Counts steps up to `total`, and says how long the rest will take; with a total of 0 (unknown) it only counts. A log
/// gets at most one line every two seconds, a terminal ten updates a second; the last step is always shown.
class Progress {
 public:
  Progress(std::string label, std::size_t total, bool quiet = false);
  /// Ends the line that was being rewritten, so that what is printed next starts on its own.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more step is done; `detail` names it in a few words.
  void advance(std::string_view detail = "");
  /// Print at once how many steps are done, and the present one.
  void show(std::string_view detail);

 private:
  void print(std::string_view detail);

  std::string label_;
  std::size_t total_, done_ = 0;
  bool quiet_, terminal_, line_open_ = false;
  std::int64_t start_ns_, first_ns_ = 0, next_print_ns_ = 0;
};

/// ", about 40 s left", once half a second and one step have passed; else nothing.
std::string time_left(std::size_t done, std::size_t total, double elapsed_s);

}  // namespace dartboard
