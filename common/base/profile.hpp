#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace fsi {

/// Seconds and calls spent in one named phase of a run, without phases that were entered in it.
struct Phase {
  double seconds = 0;
  std::int64_t calls = 0;
};

/// Where the time of a run goes and how often expensive things happen; ends up in summary.json. Not thread-safe: phases
/// are entered outside parallel regions.
class Profile {
 public:
  /// Adds the seconds from construction to destruction to the phase, without those of inner scopes, and one call.
  class Scope {
   public:
    Scope(Phase& phase, Scope*& innermost)
        : phase_(phase), innermost_(innermost), outer_(innermost), start_(std::chrono::steady_clock::now()) {
      innermost = this;
    }
    ~Scope() {
      const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
      phase_.seconds += all - inside_;
      ++phase_.calls;
      if (outer_) outer_->inside_ += all;
      innermost_ = outer_;
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Phase& phase_;
    Scope*& innermost_;
    Scope* outer_;
    double inside_ = 0;  ///< seconds of inner scopes
    std::chrono::steady_clock::time_point start_;
  };

  /// Times the enclosing block under `name`, e.g. "assembly: fluid jacobian".
  [[nodiscard]] Scope phase(const std::string& name) { return Scope(phases_[name], innermost_); }
  /// Adds to the counter `name`, e.g. "factorisations: coupled".
  void count(const std::string& name, std::int64_t by = 1) { counters_[name] += by; }

  const std::map<std::string, Phase>& phases() const { return phases_; }
  const std::map<std::string, std::int64_t>& counters() const { return counters_; }

 private:
  Scope* innermost_ = nullptr;  ///< of the scopes that live
  std::map<std::string, Phase> phases_;
  std::map<std::string, std::int64_t> counters_;
};

/// Largest resident memory of this process so far, in MiB.
double peak_memory_mib();

}  // namespace fsi
