#pragma once
// Several processes that do something at the same time.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <functional>
#include <vector>

namespace dartboard {

/// Processes that do the same at once; their exit statuses.
inline std::vector<int> at_once(int count, const std::function<int(int)>& work) {
  std::array<int, 2> gate{};
  EXPECT_EQ(pipe(gate.data()), 0);
  std::vector<pid_t> children;
  for (int k = 0; k < count; ++k) {
    children.push_back(fork());
    if (children.back() != 0) continue;
    close(gate[1]);
    char nothing;
    (void)!read(gate[0], &nothing, 1);  // returns when the gate is closed
    _exit(work(k));
  }
  close(gate[0]);
  close(gate[1]);
  std::vector<int> statuses;
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    statuses.push_back(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
  }
  return statuses;
}

}  // namespace dartboard
