#pragma once

#include <gmsh.h>

#include <string>
#include <vector>

namespace fsi {

/// The gmsh library between its initialize and finalize. There is one at a time: the library has one global model.
class GmshSession {
 public:
  /// \param arguments  of gmsh's own command line
  explicit GmshSession(const std::vector<std::string>& arguments = {}) {
    std::vector<std::string> words{"gmsh"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (auto& word : words) pointers.push_back(word.data());
    // No configuration files: a user's own options must not change the mesh.
    gmsh::initialize(static_cast<int>(pointers.size()), pointers.data(), false);
    gmsh::option::setNumber("General.Terminal", 0);
  }
  ~GmshSession() { gmsh::finalize(); }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// The last error, for use where a call has thrown: the type thrown differs between versions of the library.
  static std::string last_error() {
    std::string said;
    gmsh::logger::getLastError(said);
    return said.empty() ? "unknown reason" : said;
  }
};

}  // namespace fsi
