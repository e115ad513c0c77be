#pragma once

#include <string>

namespace fsi {

/// To be called before a program opens its first file. Descriptors 0 to 2 that are closed are taken, so that no file
/// gets one of them and text meant for a terminal ends in it; reading or writing them fails as it did. A reader that
/// goes away (SIGPIPE) and a file that reaches its allowed size (SIGXFSZ) make a write fail in place of ending the
/// program.
void guard_standard_streams();

/// From now on, or no longer, nothing is printed by the functions below: for all but one of several processes that would
/// print the same.
void keep_streams_silent(bool silent) noexcept;
/// May be asked by a signal handler.
bool streams_are_silent() noexcept;

/// Whether a write to a standard stream failed because nobody is there to read it: the reader has closed its end of a
/// pipe, or the stream was closed when the program began. \param error  errno of the write
bool nobody_reads(int error);

/// Writes text to the standard output, on its way at once. \returns 0, or errno of the write that failed
int try_to_print(const std::string& text);

/// Writes text that was asked for, such as a help, to the standard output. \throws InputError when that cannot be done
void print(const std::string& text);

/// Writes a line to the standard error in one piece, after what is waiting for the standard output. It allocates
/// nothing and cannot fail: where that stream is full or closed, there is nobody left to tell.
void print_error(const char* line) noexcept;

}  // namespace fsi
