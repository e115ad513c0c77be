#include "base/printable.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace fsi::test {

namespace {

TEST(Printable, LeavesWhatShows) {
  for (const auto* text : {"", "a b", "back\\slash", "Größe µ λ 血 🩸", "~"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatDoesNot) {
  EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(printable("\x1b[31m\x7f"), "\\x1b[31m\\x7f");
  EXPECT_EQ(printable(std::string(1, '\0')), "\\x00");
  EXPECT_EQ(printable("\u0085\u00a0\u00ad"), "\\u0085\\u00a0\\u00ad");
  EXPECT_EQ(printable("\u202egnp.exe"), "\\u202egnp.exe") << "right to left";
  EXPECT_EQ(printable("\u2028\ufeff\U000e0041"), "\\u2028\\ufeff\\U000e0041");
}

TEST(Printable, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\xff"
                      "a"),
            "\\xffa");
  EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut";
  EXPECT_EQ(printable("\xc3(\xe2\x82"), "\\xc3(\\xe2\\x82");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "overlong";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "surrogate";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "above U+10FFFF";
}

TEST(Printable, DoneTwiceChangesNothing) {
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  const auto once = printable(all);
  EXPECT_EQ(printable(once), once);
}

TEST(Printable, IsShortenedInCharacters) {
  EXPECT_EQ(shortened("0123456789", 10), "0123456789");
  EXPECT_EQ(shortened("0123456789a", 10), "0123...89a");
  EXPECT_EQ(shortened("äöüäöüäöüäöü", 9), "äöü...äöü");
  EXPECT_EQ(shortened("\n\n\n\n\n\n", 9), "\\n\\...n\\n");
  EXPECT_EQ(shortened_path("/very/long/folder/run", 10), "...der/run");
  EXPECT_EQ(shortened_path("run", 10), "run");
}

TEST(Printable, MakesEveryErrorOneLine) {
  const InputError error(std::string(5000, 'd') + "/c\nase.toml", "k\x1b", std::string(5000, 'v'), "a\nb");
  const std::string said = error.what();
  EXPECT_LT(said.size(), 1100u);
  EXPECT_EQ(said.rfind("...ddd", 0), 0u);
  EXPECT_NE(said.find("/c\\nase.toml: k\\x1b: vvv"), std::string::npos) << said;
  EXPECT_NE(said.find("vvv...vvv"), std::string::npos);
  EXPECT_NE(said.find("; a\\nb"), std::string::npos);
  EXPECT_STREQ(ConvergenceError("line\none", "two").what(), "line\\none; try two");
}

}  // namespace

}  // namespace fsi::test
