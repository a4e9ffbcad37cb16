/* Where malloc takes memory from, and how much a process has had. */
#ifndef UMBILIC_BENCHES_MEMORY_H
#define UMBILIC_BENCHES_MEMORY_H

#ifdef __cplusplus
extern "C" {
#endif

/* "warm": what was freed is used again, and the system is not asked for it anew. "fresh": blocks of 1 MB and more come
 * from the system, page by page, and go back to it. To be called before anything is allocated. */
void set_memory(const char *kind);

/* The largest resident set of the program so far, in bytes. */
double peak_memory(void);

#ifdef __cplusplus
}
#endif

#endif
