#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "io/step_record.hpp"

namespace fsi {

/// Progress of a run: one line that is rewritten on a terminal, a plain line per step when piped, nothing when quiet.
/// After a write that fails it stays quiet, and the run goes on; error() has the cause.
class Console {
 public:
  enum class Style { terminal, plain, quiet };

  /// \param last_step  number of the run's last step
  /// \param style      see style_for
  /// \param stream     where to write, not owned
  Console(std::int64_t last_step, Style style, std::FILE* stream = stdout);
  /// Leaves the cursor on a fresh line.
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// quiet when asked for, terminal when the stream is one, else plain.
  static Style style_for(bool quiet, std::FILE* stream = stdout);

  /// errno of the write that ended the output; 0: none failed.
  int error() const { return error_; }

  /// Whether the cursor may stand behind a line that is rewritten.
  bool rewrites() const { return style_ == Style::terminal; }

  /// Another number of the run's last step.
  void expect(std::int64_t last_step) { last_step_ = last_step; }
  /// A line of its own, e.g. the scene's size; not in quiet mode.
  void line(const std::string& text);
  /// What goes on inside a step, e.g. (3, "t = 0.375 ms", "newton 2, residual 1e-5"). Shown on a terminal only.
  /// \param time  by time_text()
  void working(std::int64_t step, const std::string& time, const std::string& what);
  /// Rewrites the line on a terminal, else prints a line; nothing when quiet. For all but the iterations of a step.
  void progress(const std::string& text);
  /// A finished step: time, iterations, estimated time left.
  /// \param time  of the record, by time_text()
  void step_done(const StepRecord& record, const std::string& time);

 private:
  void rewrite(const std::string& text);
  void end_rewritten_line();
  /// To the stream, on its way at once.
  void write(const std::string& text);

  std::int64_t last_step_;
  Style style_;
  std::FILE* stream_;
  int error_ = 0;
  bool line_open_ = false;
  std::int64_t steps_done_ = 0;
  double seconds_done_ = 0;
};

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string readable_duration(double seconds);

}  // namespace fsi
