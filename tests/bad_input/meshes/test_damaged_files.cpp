// Files damaged at random: whatever comes out, it is an error message or a mesh, never a crash.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tiny_tube.hpp"

namespace fsi::test {
namespace {

constexpr int trials = 500;

/// One to four random changes: a byte, a line taken out, doubled or exchanged, a number replaced, the tail cut off.
std::string damaged(std::string content, std::mt19937& random) {
  const auto below = [&](std::size_t bound) { return bound == 0 ? 0 : random() % bound; };
  const auto line = [&] {
    const auto at = below(content.size());
    const auto begin = content.rfind('\n', at);
    const auto first = begin == std::string::npos ? 0 : begin + 1;
    const auto end = content.find('\n', first);
    return std::make_pair(first, end == std::string::npos ? content.size() : end + 1);
  };
  for (auto left = 1 + below(4); left > 0; --left) {
    switch (below(7)) {
      case 0: {
        if (!content.empty()) content[below(content.size())] = static_cast<char>(random());
        break;
      }
      case 1: {
        if (!content.empty()) content[below(content.size())] ^= static_cast<char>(1u << below(8));
        break;
      }
      case 2: {
        const auto [first, end] = line();
        content.erase(first, end - first);
        break;
      }
      case 3: {
        const auto [first, end] = line();
        content.insert(first, content.substr(first, end - first));
        break;
      }
      case 4: {
        const auto at = content.find_first_of("0123456789", below(content.size()));
        if (at == std::string::npos) break;
        const auto end = content.find_first_not_of("0123456789", at);
        static const char* const numbers[] = {
            "0",   "-1", "2147483648", "9223372036854775807", "99999999999999999999", "1e308", "4294967295",
            "nan", "3",  "17"};
        content.replace(at, (end == std::string::npos ? content.size() : end) - at, numbers[below(10)]);
        break;
      }
      case 5: {
        if (below(3) == 0) content.resize(below(content.size()));
        break;
      }
      default: {
        for (int i = 0; i < 8 && content.size() > 8; ++i) content[below(content.size() - 1)] = '\xff';
      }
    }
  }
  return content;
}

/// Tries damaged versions; returns how many were still a good mesh.
int survivors(const std::string& content) {
  std::mt19937 random(20260101);
  int accepted = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto message = verdict(damaged(content, random));  // anything but an InputError ends the test here
    accepted += message == "accepted";
    if (message != "accepted") {
      EXPECT_EQ(message.substr(0, 9), "tube.msh:") << "trial " << trial;
    }
  }
  return accepted;
}

TEST(DamagedFile, Text41) {
  EXPECT_LT(survivors(tiny_tube().text_41()), trials / 2);
}

TEST(DamagedFile, Text22) {
  EXPECT_LT(survivors(tiny_tube().text_22()), trials / 2);
}

TEST(DamagedFile, Binary41) {
  EXPECT_LT(survivors(tiny_tube().binary_41()), trials / 2);
}

TEST(DamagedFile, Binary22) {
  EXPECT_LT(survivors(tiny_tube().binary_22()), trials / 2);
}

TEST(DamagedFile, EveryTruncationIsRefused) {
  for (const auto& content : {tiny_tube().text_22(), tiny_tube().binary_41()})
    for (std::size_t length = 0; length + 13 < content.size(); length += 97)
      EXPECT_NE(verdict(content.substr(0, length)), "accepted") << length;
}

}  // namespace
}  // namespace fsi::test
