#include "host/machine.hpp"

#include <gtest/gtest.h>

#include <set>

#include "host/instruction_set.hpp"

namespace fsi::test {

namespace {

TEST(Machine, ReadsTheModelOfTheFirstProcessor) {
  EXPECT_EQ(processor_in("processor\t: 0\nvendor_id\t: X\nmodel\t\t: 17\nmodel name\t: Maker Model 7 @ 2.0GHz \n"
                         "processor\t: 1\nmodel name\t: another\n"),
            "Maker Model 7 @ 2.0GHz");
}

TEST(Machine, SaysWhereNoModelIsNamed) {
  for (const char* text : {"", "processor\t: 0\nBogoMIPS\t: 100\n", "model name\t:  \n", "model name\n"})
    EXPECT_EQ(processor_in(text), "unknown") << text;
}

TEST(Machine, GivesTheNumbersOfArmsDesigns) {
  EXPECT_EQ(processor_in("processor\t: 0\nCPU implementer\t: 0x41\nCPU architecture: 8\nCPU part\t: 0xd0c\n"),
            "Arm, implementer 0x41, part 0xd0c");
}

TEST(Machine, NamesInstructionSetAndCompiler) {
  const std::set<std::string> known = {"x86-64", "x86-64-v2", "x86-64-v3", "x86-64-v4", "aarch64", "other"};
  EXPECT_EQ(known.count(instruction_set()), 1u);
#ifdef __AVX512F__
  EXPECT_EQ(instruction_set(), "x86-64-v4");
#endif
  const std::string name = compiler();
  EXPECT_TRUE(name.rfind("gcc ", 0) == 0 || name.rfind("clang ", 0) == 0) << name;
  EXPECT_NE(name.find(__VERSION__[0] == 'C' || __VERSION__[0] == 'D' ? "clang" : "gcc"), std::string::npos) << name;
}

}  // namespace

}  // namespace fsi::test
