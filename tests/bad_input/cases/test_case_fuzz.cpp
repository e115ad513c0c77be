#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "case/case_hash.hpp"
#include "case/case_reader.hpp"
#include "example_cases.hpp"

namespace fsi::test {

namespace {

/// Marsaglia's xorshift64: the same numbers everywhere, unlike the standard library's distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t bound) {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<std::size_t>(state_ % bound);
  }

 private:
  std::uint64_t state_;
};

/// One random edit: a byte changed, inserted or removed, or a line doubled, removed or moved.
std::string mutated(std::string text, Random& random) {
  static const std::string bytes = "0123456789-+.eE\"'[]{}=#,\n \tabnix_\\\x01\x7f\xc3\xff";
  if (text.empty()) return text;
  const auto at = random.below(text.size());
  const auto line_begin = text.rfind('\n', at == 0 ? 0 : at - 1);
  const auto begin = line_begin == std::string::npos ? 0 : line_begin + 1;
  const auto line = text.substr(begin, text.find('\n', at) - begin);
  switch (random.below(6)) {
    case 0:
      text[at] = bytes[random.below(bytes.size())];
      break;
    case 1:
      text.insert(at, 1, bytes[random.below(bytes.size())]);
      break;
    case 2:
      text.erase(at, 1);
      break;
    case 3:
      text.insert(begin, line + "\n");
      break;
    case 4:
      text.erase(begin, line.size());
      break;
    default:
      text.erase(begin, line.size());
      text.insert(random.below(text.size() + 1), "\n" + line + "\n");
  }
  return text;
}

/// Reads the text; true when it is a case. Anything thrown but InputError fails the test.
bool accepted(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    const auto scene = parse_case(text, "case.toml", overrides);
    EXPECT_EQ(hash_of_case(scene).size(), 16u);
    EXPECT_TRUE(scene.fluid || scene.structure);
    if (scene.time) {
      EXPECT_GE(scene.time->steps(), 1);
    }
    return true;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return false;
  }
}

TEST(CaseFuzz, MutatedFilesAreReadOrRefused) {
  for (const auto* valid : {&coupled_case, &fluid_case, &static_case}) {
    Random random(42);
    int cases = 0, refusals = 0;
    for (int i = 0; i < 2000; ++i) {
      std::string text = *valid;
      for (std::size_t edits = 1 + random.below(4); edits > 0; --edits) text = mutated(text, random);
      ++(accepted(text) ? cases : refusals);
    }
    // Both happen, or the mutations are too tame or too wild to test anything. Of 20,000 mutations of each, 3.5 to 5.3 %
    // are cases.
    EXPECT_GT(cases, 40);
    EXPECT_GT(refusals, 400);
  }
}

TEST(CaseFuzz, TruncatedFilesAreReadOrRefused) {
  for (std::size_t size = 0; size <= coupled_case.size(); ++size) accepted(coupled_case.substr(0, size));
}

TEST(CaseFuzz, MutatedOverridesAreReadOrRefused) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    std::string text = "structure.layers.media.c10=3.5";
    for (std::size_t edits = 1 + random.below(4); edits > 0; --edits) text = mutated(text, random);
    accepted(coupled_case, {text});
  }
}

}  // namespace

}  // namespace fsi::test
