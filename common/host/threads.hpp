#pragma once

namespace fsi {

/// Sets the number of threads of parallel loops; 0: one per core that this process may run on. Returns the number set.
int set_threads(int count);
/// The number last set; one per available core before that.
int threads();

/// begin_again_with_settings() with this process's environment, so that waiting threads sleep soon. To be called first
/// in main(): programs linked without settings_before_main.cpp, as beside a sanitizer, start themselves again here; the
/// others have all settings and go on.
/// \param argv  as main() has it, ended by a null pointer
void wait_briefly(const char* const* argv);

}  // namespace fsi
