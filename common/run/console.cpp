#include "run/console.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "base/printable.hpp"

namespace fsi {

namespace {

/// "4 coupling, 9 Newton, 120 linear iterations"; what a step did not need is left out.
std::string iterations_text(const StepRecord& record) {
  std::string text;
  const auto add = [&](std::int64_t count, const char* kind) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  };
  if (record.outer_iterations > 1) add(record.outer_iterations, "coupling");
  add(record.newton_iterations, "Newton");
  add(record.linear_iterations, "linear");
  return text.empty() ? "no iterations" : text + " iterations";
}

/// Columns of the terminal; a longer line would wrap and could not be rewritten.
std::size_t terminal_width(std::FILE* stream) {
  winsize size{};
  if (ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 1) return size.ws_col;
  return 80;
}

}  // namespace

std::string readable_duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "?";
  const auto whole = static_cast<std::int64_t>(std::min(std::ceil(seconds), 1e15));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

Console::Console(std::int64_t last_step, Style style, std::FILE* stream)
    : last_step_(last_step), style_(style), stream_(stream) {}

Console::~Console() {
  end_rewritten_line();
}

Console::Style Console::style_for(bool quiet, std::FILE* stream) {
  if (quiet) return Style::quiet;
  return isatty(fileno(stream)) ? Style::terminal : Style::plain;
}

void Console::line(const std::string& text) {
  if (style_ == Style::quiet) return;
  end_rewritten_line();
  write(printable(text) + "\n");
}

void Console::working(std::int64_t step, const std::string& time, const std::string& what) {
  if (style_ == Style::terminal) rewrite(fmt::format("step {}/{}, {}: {}", step, last_step_, time, what));
}

void Console::progress(const std::string& text) {
  if (style_ == Style::terminal)
    rewrite(text);
  else
    line(text);
}

void Console::step_done(const StepRecord& record, const std::string& time) {
  if (style_ == Style::quiet) return;
  ++steps_done_;
  seconds_done_ += record.wall_seconds;
  const double seconds_left = seconds_done_ / steps_done_ * static_cast<double>(last_step_ - record.step);
  const auto text = fmt::format("step {}/{}, {}: {}, {:.3g} s, {} left", record.step, last_step_, time,
                                iterations_text(record), record.wall_seconds, readable_duration(seconds_left));
  progress(text);
}

void Console::rewrite(const std::string& text) {
  write("\r\033[K" + printable(text).substr(0, terminal_width(stream_) - 1));
  line_open_ = true;
}

void Console::end_rewritten_line() {
  if (line_open_) write("\n");
  line_open_ = false;
}

void Console::write(const std::string& text) {
  if (error_ != 0) return;
  errno = 0;
  const bool taken = std::fwrite(text.data(), 1, text.size(), stream_) == text.size();
  if (std::fflush(stream_) != 0 || !taken) {
    error_ = errno != 0 ? errno : EIO;
    style_ = Style::quiet;
  }
}

}  // namespace fsi
