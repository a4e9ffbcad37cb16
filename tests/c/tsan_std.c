/*
 * Tells ThreadSanitizer what two functions of Rust's standard library do, which comes without instrumentation: waiting for a mutex
 * that another thread holds, and running what is to be run once. Else it sees a race where a lock was waited for. sanitize.sh
 * has the linker put these in their place (--wrap), and defines the names of those that the library uses.
 */
#include <stdint.h>

void __tsan_acquire(void *address);
void __tsan_release(void *address);

/* Two levels, so that the names are replaced before they are put together. */
#define LABEL(prefix, name) LABEL_(prefix, name)
#define LABEL_(prefix, name) prefix #name

#ifdef LOCK_CONTENDED
void real_lock_contended(void *mutex) __asm__(LABEL("__real_", LOCK_CONTENDED));
void lock_contended(void *mutex) __asm__(LABEL("__wrap_", LOCK_CONTENDED));

/* The lock is taken in there; whoever had it has let it go by code that is instrumented. */
void lock_contended(void *mutex) {
  real_lock_contended(mutex);
  __tsan_acquire(mutex);
}
#endif

#ifdef ONCE_CALL
/* Its arguments are nobody's business: as many as any call could have in registers. */
typedef uintptr_t word;
void real_once(void *once, word a, word b, word c, word d, word e) __asm__(LABEL("__real_", ONCE_CALL));
void once(void *once, word a, word b, word c, word d, word e) __asm__(LABEL("__wrap_", ONCE_CALL));

/* What was run is seen by all that find it done. */
void once(void *state, word a, word b, word c, word d, word e) {
  real_once(state, a, b, c, d, e);
  __tsan_acquire(state);
  __tsan_release(state);
}
#endif
