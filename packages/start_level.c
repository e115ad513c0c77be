/* Stands in the Debian package for a program of which it holds one build for each x86-64 level, and becomes the build for
 * the highest level that this processor has: /usr/bin/fsi-monolithic becomes
 * /usr/lib/fsi-duo/x86-64-v3/fsi-monolithic. FSI_LEVEL=x86-64-v2 asks for no higher one.
 *
 * A level is what the x86-64 psABI says it is, asked of the C library as for its glibc-hwcaps folders: features that the
 * operating system keeps the registers of, and that GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F does not hide. */
#define _GNU_SOURCE
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/auxv.h>
#include <sys/platform/x86.h>
#include <unistd.h>

#define HAS(FEATURE) (CPU_FEATURE_ACTIVE(FEATURE) != 0)
#define LEVEL_COUNT 3
#define PATH_SIZE 4096

static const char* const levels[LEVEL_COUNT] = {"x86-64-v2", "x86-64-v3", "x86-64-v4"};

/* Levels that this processor has, from the lowest on. */
static int levels_of_processor(void) {
  if (!(HAS(CMPXCHG16B) && HAS(LAHF64_SAHF64) && HAS(POPCNT) && HAS(SSE3) && HAS(SSSE3) && HAS(SSE4_1) && HAS(SSE4_2)))
    return 0;
  if (!(HAS(AVX) && HAS(AVX2) && HAS(BMI1) && HAS(BMI2) && HAS(F16C) && HAS(FMA) && HAS(LZCNT) && HAS(MOVBE))) return 1;
  return HAS(AVX512F) && HAS(AVX512BW) && HAS(AVX512CD) && HAS(AVX512DQ) && HAS(AVX512VL) ? 3 : 2;
}

/* How many levels FSI_LEVEL allows; all of the processor's when it is not set. Otherwise 0, and `problem` says why. */
static int levels_allowed(const char* wanted, int available, const char** problem) {
  if (wanted == NULL || *wanted == '\0') return available;
  for (int i = 0; i < LEVEL_COUNT; ++i)
    if (strcmp(wanted, levels[i]) == 0) {
      if (i < available) return i + 1;
      *problem = "is a level that this processor does not have";
      return 0;
    }
  *problem = "is no level of x86-64 processors";
  return 0;
}

/* Writes at most 200 bytes of a text that anybody may have set, none of which moves a terminal's cursor. */
static void write_printable(const char* text) {
  for (int i = 0; i < 200 && text[i] != '\0'; ++i) fputc(text[i] < ' ' || text[i] == 127 ? '?' : text[i], stderr);
}

int main(int argc, char** argv) {
  (void)argc;
  const int available = levels_of_processor();
  /* The name that the program was started by, links followed, needs no /proc. */
  char* self = realpath((const char*)getauxval(AT_EXECFN), NULL);
  char* slash = self == NULL ? NULL : strrchr(self, '/');
  if (slash == NULL) {
    fprintf(stderr, "fsi-duo: error: cannot find its own file: %s; start it by its full name\n", strerror(errno));
    return 1;
  }
  *slash = '\0';
  const char* const name = slash + 1;
  if (available == 0) {
    fprintf(stderr,
            "%s: error: this processor lacks the instructions of x86-64-v2; build the program on this machine, "
            "with cmake --preset portable\n",
            name);
    return 1;
  }
  const char* const wanted = getenv("FSI_LEVEL");
  const char* problem = NULL;
  const int allowed = levels_allowed(wanted, available, &problem);
  if (problem != NULL) {
    fprintf(stderr, "%s: error: FSI_LEVEL: '", name);
    write_printable(wanted);
    fprintf(stderr, "' %s; leave it out, or give x86-64-v2", problem);
    for (int i = 1; i < available; ++i) fprintf(stderr, "%s%s", i + 1 < available ? ", " : " or ", levels[i]);
    fputc('\n', stderr);
    return 1;
  }
  for (int i = allowed - 1; i >= 0; --i) {
    char path[PATH_SIZE];
    const int length = snprintf(path, sizeof path, "%s/" FSI_LEVELS_FOLDER "/%s/%s", self, levels[i], name);
    if (length >= (int)sizeof path) errno = ENAMETOOLONG;
    if (length < (int)sizeof path) execv(path, argv);
    if (errno == ENOENT && i > 0) continue; /* not present: the next lower one */
    fprintf(stderr, "%s: error: %s: cannot be started: %s; install the package fsi-duo again\n", name, path,
            strerror(errno));
    return 1;
  }
  return 1;
}
