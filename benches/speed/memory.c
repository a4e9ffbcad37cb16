#include "memory.h"

#include <malloc.h>
#include <stdio.h>
#include <string.h>

void set_memory(const char *kind) {
  if (!strcmp(kind, "warm")) {
    mallopt(M_MMAP_MAX, 0); /* glibc takes no threshold above 32 MB */
    mallopt(M_TRIM_THRESHOLD, -1);
    mallopt(M_TOP_PAD, 64 << 20);
  } else if (!strcmp(kind, "fresh")) {
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 0);
    mallopt(M_TOP_PAD, 0);
  }
}

double peak_memory(void) {
  /* getrusage would tell what the process had before it became this program, if that was more. */
  FILE *file = fopen("/proc/self/status", "r");
  double kilobytes = 0;
  char line[256];
  while (file && fgets(line, sizeof line, file))
    if (sscanf(line, "VmHWM: %lf", &kilobytes) == 1) break;
  if (file) fclose(file);
  return 1024 * kilobytes;
}
