#pragma once
// Names that an attacker might choose, to make a program act on them.

#include <random>
#include <string>
#include <vector>

namespace dartboard {

inline std::vector<std::string> hostile_names() {
  return {"",
          "liver",
          "`touch canary`",
          "$(touch canary)",
          "'; system('touch canary'); '",
          "\"; !touch canary; \"",
          "\\\"`touch canary`\\",
          "<touch canary",
          "|touch canary",
          "../../canary",
          "-rf",
          ".hidden",
          "%n%s%x%1$n",
          "{/Symbol a}^{2}_{x} @x &{x}",
          "</script><script>alert(1)</script><!-- ]]>",
          "&lt;&#60;&amp; & a&b",
          "=cmd|' /C calc'!A0",
          "+1,2;3",
          "-1\t2",
          "@SUM(A1)",
          "\"quoted\", 'quoted'",
          "[link](javascript:alert(1)) ![x](y) [x]: z",
          "# heading **bold** _it_ ~~no~~ $x$ snake_case",
          "1. item",
          "two\nlines\r\nand | bars",
          "\x1b]0;owned\x07\x1b[2J\x1b[31mred",
          "\xc2\x9b"
          "31m\xe2\x80\xaetxt.exe\xe2\x80\xa8",
          std::string("nul\0nul", 7),
          "\xff\xfe\xc0\xaf\xed\xa0\x80\xf5\x80\x80\x80\xe2\x82",
          "\xc3\xa9t\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80",
          std::string(100000, 'a'),
          std::string(100000, '`')};
}

/// Random bytes: some with a meaning in some language, some of any value, and some letters beyond ASCII.
inline std::string drawn_name(std::mt19937& random) {
  static const std::string active = "`$(){}'\"\\<>|&;%@=+-*_~[]!#^,.:/\n\r\t\x1b\x07 ";
  static const std::vector<std::string> beyond{"\xc3\xa9",     "\xc2\x9b",         "\xe2\x80\xae", "\xe2\x80\xa8",
                                               "\xef\xbb\xbf", "\xf0\x9f\x98\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80"};
  std::string name;
  for (auto n = random() % 24; n > 0; --n) switch (random() % 4) {
      case 0: name += static_cast<char>(random() % 256); break;
      case 1: name += beyond[random() % beyond.size()]; break;
      case 2: name += static_cast<char>('a' + random() % 26); break;
      default: name += active[random() % active.size()];
    }
  return name;
}

/// The list, and that many random names.
inline std::vector<std::string> many_hostile_names(std::size_t drawn) {
  std::vector<std::string> names = hostile_names();
  std::mt19937 random(14);
  for (std::size_t k = 0; k < drawn; ++k) names.push_back(drawn_name(random));
  return names;
}

}  // namespace dartboard
