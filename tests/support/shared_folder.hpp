#pragma once

#include <string>

#include "parallel/communicator.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

/// A test with an empty folder of all processes that run it together.
class SharedFolderTest : public FolderTest {
 protected:
  void SetUp() override {
    if (processes_.is_first()) FolderTest::SetUp();
    std::string name = folder_.string();
    processes_.broadcast(name);
    folder_ = name;
  }
  void TearDown() override {
    processes_.wait();
    if (processes_.is_first()) FolderTest::TearDown();
  }

  const Communicator& processes_ = Communicator::world();
};

}  // namespace fsi::test
