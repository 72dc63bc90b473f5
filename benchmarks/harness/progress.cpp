#include "benchmarks/harness/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "benchmarks/harness/clock.h"
#include "core/base/escape.h"

namespace dartboard {
namespace {

constexpr std::int64_t terminal_period_ns = 100'000'000;
constexpr std::int64_t log_period_ns = 2'000'000'000;

/// A terminal that can rewrite a line; an editor's "dumb" one cannot.
bool is_terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80;
}

}  // namespace

Progress::Progress(std::string label, std::size_t total, bool quiet)
    : label_(std::move(label)), total_(total), quiet_(quiet), terminal_(is_terminal()), start_ns_(steady_wall_ns()) {}

Progress::~Progress() {
  if (line_open_) std::fputc('\n', stderr);
}

void Progress::advance(std::string_view detail) {
  ++done_;
  if (quiet_) return;
  const std::int64_t now = steady_wall_ns();
  if (done_ == 1) first_ns_ = now;
  if (now < next_print_ns_ && done_ != total_) return;
  next_print_ns_ = now + (terminal_ ? terminal_period_ns : log_period_ns);
  print(detail);
}

void Progress::show(std::string_view detail) {
  if (!quiet_) print(detail);
}

std::string time_left(std::size_t done, std::size_t total, double elapsed_s) {
  if (done == 0 || done >= total || elapsed_s < 0.5) return "";
  const double left_s = elapsed_s * static_cast<double>(total - done) / static_cast<double>(done);
  return left_s < 100.0 ? fmt::format(", about {:.0f} s left", std::max(1.0, left_s))
                        : fmt::format(", about {:.0f} min left", left_s / 60.0);
}

void Progress::print(std::string_view detail) {
  const std::int64_t now = steady_wall_ns();
  const double elapsed_s = 1e-9 * static_cast<double>(now - start_ns_);
  // the first step may prepare data that the others use, so they are timed by themselves
  const std::string left =
      done_ < 2 ? "" : time_left(done_ - 1, total_ - 1, 1e-9 * static_cast<double>(now - first_ns_));
  const std::string counted =
      total_ > 0 ? fmt::format("{}/{}{}", done_, total_, left) : fmt::format("{} done in {:.0f} s", done_, elapsed_s);
  std::string line = terminal_text(fmt::format("{}: {}{}{}", label_, counted, detail.empty() ? "" : "  ", detail));
  if (!terminal_) {
    fmt::print(stderr, "{}\n", line);
    return;
  }
  // a line that wraps could not be rewritten; bytes are at least as many as columns, so this may cut early, never late
  if (line.size() >= terminal_width()) {
    std::size_t end = terminal_width() - 1;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0U) == 0x80U) --end;
    line.resize(end);
  }
  // back to the first column, then erase the rest of the earlier line
  fmt::print(stderr, "\r{}\033[K", line);
  std::fflush(stderr);
  line_open_ = true;
}

}  // namespace dartboard
