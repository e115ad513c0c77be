#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "base/error.hpp"
#include "io/folder_lock.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

namespace fs = std::filesystem;

class Lock : public FolderTest {
 protected:
  fs::path run_, file_;
  void SetUp() override {
    FolderTest::SetUp();
    run_ = folder_ / "above" / "run";
    file_ = run_ / lock_name;
  }
  std::string refusal_of_taking() {
    try {
      const FolderLock lock(run_, "fsi-y");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::string refusal_of_looking() {
    try {
      require_no_run_in(run_, "REMEDY");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  /// The text of a lock, from the host's name on replaced.
  std::string text_on(const std::string& host) {
    std::string text;
    {
      const FolderLock lock(run_, "fsi-x");
      text = contents_of(file_);
    }
    return text.substr(0, text.find(" on host ")) + " on host " + host + "\n";
  }
};

TEST_F(Lock, NamesItsProcessAndGoesWithTheFoldersMadeForIt) {
  {
    const FolderLock lock(run_, "fsi-x");
    EXPECT_EQ(lock.said(), "");
    const auto text = contents_of(file_);
    EXPECT_EQ(text.find("fsi-x, process " + std::to_string(getpid()) + " on host "), 0U) << text;
    EXPECT_EQ(text.find('\n'), text.size() - 1) << text;
  }
  EXPECT_FALSE(fs::exists(folder_ / "above"));
}

TEST_F(Lock, LeavesFoldersThatHoldSomething) {
  {
    const FolderLock lock(run_, "fsi-x");
    write_text(run_ / "summary.json", "{}");
  }
  EXPECT_TRUE(fs::exists(run_ / "summary.json"));
  EXPECT_FALSE(fs::exists(file_));
  fs::remove(run_ / "summary.json");
  { const FolderLock lock(run_, "fsi-x"); }
  EXPECT_TRUE(fs::exists(run_)) << "was there before";
}

TEST_F(Lock, RefusesASecondRunAndALook) {
  const FolderLock lock(run_, "fsi-x");
  const auto whose = "fsi-x, process " + std::to_string(getpid()) + " on host ";
  EXPECT_NE(refusal_of_taking().find(run_.string() + ": a run works in it (" + whose), std::string::npos);
  EXPECT_NE(refusal_of_looking().find(whose), std::string::npos);
  EXPECT_NE(refusal_of_looking().find("; REMEDY"), std::string::npos);
  EXPECT_NO_THROW(lock.require_held());
}

TEST_F(Lock, OfAnEndedProcessIsTakenOver) {
  const pid_t child = fork();
  if (child == 0) {
    new FolderLock(run_, "fsi-x");
    _exit(0);  // as if killed: nothing is cleared up
  }
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(fs::exists(file_));
  EXPECT_EQ(refusal_of_looking(), "");
  const FolderLock lock(run_, "fsi-y");
  EXPECT_NE(lock.said().find("took over the lock of fsi-x, process " + std::to_string(child)), std::string::npos);
}

TEST_F(Lock, OfAnotherHostIsLeftToTheUser) {
  const auto text = text_on("elsewhere");
  fs::create_directories(run_);
  write_text(file_, text);
  for (const auto& said : {refusal_of_taking(), refusal_of_looking()}) {
    EXPECT_NE(said.find("on host elsewhere"), std::string::npos) << said;
    EXPECT_NE(said.find("if it does not, remove " + file_.string()), std::string::npos) << said;
  }
  EXPECT_EQ(contents_of(file_), text);
}

TEST_F(Lock, ThatNamesNobodyIsLeftToTheUser) {
  fs::create_directories(run_);
  for (const std::string text : {"mine\n", "program fsi-x\nhost h\n"}) {
    write_text(file_, text);
    for (const auto& said : {refusal_of_taking(), refusal_of_looking()})
      EXPECT_NE(said.find("does not say by whom; if no run works in the folder, remove that file"), std::string::npos)
          << said;
    EXPECT_EQ(contents_of(file_), text);
  }
  write_text(file_, "");  // its owner was killed before it could write its name
  EXPECT_EQ(refusal_of_looking(), "");
  EXPECT_EQ(FolderLock(run_, "fsi-y").said(), "");
}

TEST_F(Lock, ThatVanishesIsNoticed) {
  const FolderLock lock(run_, "fsi-x");
  fs::remove(file_);
  EXPECT_THROW(lock.require_held(), InputError);
  write_text(file_, "of another");
  EXPECT_THROW(lock.require_held(), InputError);
}

TEST_F(Lock, IsTakenByOneOfMany) {
  for (int round = 0; round < 20; ++round) {
    std::atomic<int> inside{0}, most{0}, taken{0};
    std::vector<std::thread> threads;
    for (int k = 0; k < 8; ++k)
      threads.emplace_back([&] {
        try {
          const FolderLock lock(run_, "fsi-x");
          const int now = ++inside;
          if (now > most) most = now;
          ++taken;
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
          --inside;
        } catch (const InputError&) {
        }
      });
    for (auto& thread : threads) thread.join();
    EXPECT_EQ(most, 1);
    EXPECT_GE(taken, 1);
    EXPECT_FALSE(fs::exists(file_));
  }
}

}  // namespace

}  // namespace fsi::test
