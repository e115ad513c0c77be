#pragma once

#include <string>

namespace fsi {

/// To be called before a program opens its first file. Occupies descriptors 0 to 2 that are closed, so that no file
/// gets one of them and the text meant for a terminal; reading or writing them still fails. A reader that goes away
/// (SIGPIPE) and a file that reaches its allowed size (SIGXFSZ) make a write fail in place of ending the program.
void guard_standard_streams();

/// Switches the printing functions below off or on: off for all but one of several processes that would print the same.
void keep_streams_silent(bool silent) noexcept;
/// May be called by a signal handler.
bool streams_are_silent() noexcept;

/// Whether a write to a standard stream failed because nobody is there to read it: the reader has closed its end of a
/// pipe, or the stream was closed when the program began. \param error  errno of the write
bool nobody_reads(int error);

/// Writes text to the standard output and flushes it. \returns 0, or errno of the write that failed
int try_to_print(const std::string& text);

/// Writes text that the user asked for, such as a help, to the standard output. \throws InputError when that fails
void print(const std::string& text);

/// Writes a line to the standard error in one piece, after what is waiting for the standard output. It allocates
/// nothing and cannot fail: where that stream is full or closed, there is nobody left to tell.
void print_error(const char* line) noexcept;

}  // namespace fsi
