#!/bin/sh
# The C and C++ programs of this folder under sanitizers and valgrind: `sanitize.sh [address] [undefined] [thread] [memcheck]
# [helgrind]`, without arguments all. Each first has to catch faults on purpose (planted.c), in C and in the library's own code: a
# sanitizer that is not linked, or a library that is not instrumented, finds nothing and proves nothing.
#
# There is no MemorySanitizer: it takes what code without its instrumentation has written for uninitialised, and Rust's standard library
# comes without (rustc refuses to mix them). It was tried, and every program ended in its first call, over what a vector had answered
# when asked for room. Memcheck needs no instrumentation and looks for the same.
#
# Run it at the root, after `make target/release/libumbilic.so`. It takes some ten minutes.
set -eu

here=tests/c
target=x86_64-unknown-linux-gnu
built=$PWD/target/sanitize
system="-lgcc_s -lutil -lrt -lpthread -lm -ldl -lc"
flags="-O1 -g -Wall -Wextra -Wpedantic -Wconversion -Werror -Iinclude"
mkdir -p "$built/bin"

# instrument NAME FLAGS: the library with these flags of rustc; its path becomes $library. Sanitizers are not stable in rustc, hence
# RUSTC_BOOTSTRAP. With optimisation a build takes ten times as long, and without any inlining a run does.
instrument() {
  echo "== $1: the library"
  RUSTC_BOOTSTRAP=1 RUSTFLAGS="-Zmir-opt-level=3 -Zinline-mir=yes $2" CARGO_INCREMENTAL=0 \
    CARGO_PROFILE_RELEASE_OPT_LEVEL=0 CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 \
    CARGO_PROFILE_RELEASE_DEBUG=line-tables-only CARGO_PROFILE_RELEASE_STRIP=none \
    "${CARGO:-cargo}" rustc --release --locked --lib --crate-type staticlib --target $target --target-dir "$built/$1"
  library=$built/$1/$target/release/libumbilic.a
}

# compile FLAGS LINK: all programs with $library.
# shellcheck disable=SC2086 # lists of words, here and below
compile() {
  for program in normals corners segments curvatures refusals threads early_late old_header planted; do
    "${CC:-cc}" -std=c11 $flags $1 -c $here/$program.c -o "$built/$program.o"
    "${CC:-cc}" "$built/$program.o" $library $2 -o "$built/bin/$program" $system
  done
  "${CXX:-c++}" -std=c++11 $flags $1 -c $here/host.cpp -o "$built/host.o"
  "${CXX:-c++}" "$built/host.o" $library $2 -o "$built/bin/host" $system
}

# catches FAULT WORD COMMAND...: under the command the fault must end in status 99, with the word in the report.
catches() {
  fault=$1 word=$2
  shift 2
  status=0
  "$@" "$built/bin/planted" "$fault" > "$built/report.txt" 2>&1 || status=$?
  if [ $status -ne 99 ] || ! grep -q "$word" "$built/report.txt"; then
    cat "$built/report.txt"
    echo "The planted fault $fault was not caught (status $status)." >&2
    exit 1
  fi
  echo "caught: $fault"
}

# clean COMMAND...: under it every program runs, and nothing is found.
clean() {
  "$@" "$built/bin/planted" none
  for program in normals corners segments curvatures refusals early_late old_header host; do "$@" "$built/bin/$program"; done
  "$@" "$built/bin/threads" 2
}

# Memory errors and leaks. Checks are calls, and Rust's stack, where all code is safe, is not checked: else compiling takes more than
# 20 GB.
address() {
  instrument address \
    "-Zsanitizer=address -Cllvm-args=-asan-instrumentation-with-call-threshold=0 -Cllvm-args=-asan-stack=0"
  compile -fsanitize=address -fsanitize=address
  export ASAN_OPTIONS=exitcode=99:detect_leaks=1
  catches overflow heap-buffer-overflow env
  catches library-overflow umbilic:: env
  catches leak LeakSanitizer env
  # The unwinder that needs no frame pointers: the standard library has none.
  catches library-leak umb_topology_create env ASAN_OPTIONS=exitcode=99:fast_unwind_on_malloc=0
  clean env
}

# In C what the standard leaves undefined; in Rust its counterpart, arithmetic that overflows and the assertions of unsafe functions.
undefined() {
  instrument undefined "-Coverflow-checks=on -Cdebug-assertions=on"
  nm "$library" 2>/dev/null | grep -q panic_const_add_overflow || { echo "Overflow is not checked." >&2; exit 1; }
  compile "-fsanitize=undefined -fno-sanitize-recover=all" -fsanitize=undefined
  export UBSAN_OPTIONS=exitcode=99
  catches undefined "signed integer overflow" env
  clean env
}

# Data races. The runtime is Rust's own: that of gcc lacks functions which rustc's instrumentation calls.
thread() {
  instrument thread "-Zsanitizer=thread -Cunsafe-allow-abi-mismatch=sanitizer"
  runtime=$(rustc --print sysroot)/lib/rustlib/$target/lib/librustc-stable_rt.tsan.a
  nm "$library" 2>/dev/null > "$built/symbols.txt" || true
  [ -f "$runtime" ] || { echo "This Rust has no ThreadSanitizer: $runtime" >&2; exit 1; }
  # What tsan_std.c stands in for, as far as the library uses it.
  lock=$(sed -n 's/^ *U \(.*Mutex14lock_contended.*\)$/\1/p' "$built/symbols.txt" | head -n 1)
  once=$(sed -n 's/^ *U \(.*4once5futex.*4Once4call.*\)$/\1/p' "$built/symbols.txt" | head -n 1)
  # shellcheck disable=SC2086 # a list of words
  "${CC:-cc}" -std=c11 $flags ${lock:+"-DLOCK_CONTENDED=$lock"} ${once:+"-DONCE_CALL=$once"} -c $here/tsan_std.c -o "$built/tsan_std.o"
  compile -fsanitize=thread \
    "$built/tsan_std.o ${lock:+-Wl,--wrap=$lock} ${once:+-Wl,--wrap=$once} -Wl,--whole-archive $runtime -Wl,--no-whole-archive"
  export TSAN_OPTIONS=exitcode=99
  catches race count_up env
  catches library-race umbilic:: env
  clean env
}

# Uninitialised memory, memory errors and leaks in the library as it is shipped, up to AVX2: valgrind knows no more.
memcheck() {
  library=target/release/libumbilic.a
  compile "" ""
  # In shorter pieces than it takes by itself: of the longest that the kernels consist of it has no room for a translation.
  set -- valgrind --quiet --error-exitcode=99 --vex-guest-max-insns=25 \
    --leak-check=full --errors-for-leak-kinds=definite,indirect,possible
  catches overflow "Invalid write" "$@"
  catches library-overflow umbilic:: "$@"
  catches leak "definitely lost" "$@"
  catches library-leak umb_topology_create "$@"
  catches uninitialised uninitialised "$@"
  catches library-uninitialised umbilic:: "$@"
  clean "$@"
}

# Data races in the library as it is shipped. Helgrind knows the locks of pthread, but neither Rust's nor atomic numbers, by which the
# threads of one call share its work: so here calls are concurrent, but each has one thread. (host.cpp throws on several threads, and
# gcc's unwinder has the same ways.)
helgrind() {
  library=target/release/libumbilic.a
  compile "" ""
  set -- valgrind --quiet --tool=helgrind --error-exitcode=99
  catches race count_up "$@"
  catches library-race umbilic:: "$@"
  for program in "planted none" refusals old_header "threads 2 apart"; do
    # shellcheck disable=SC2086 # a program and its arguments
    "$@" "$built"/bin/$program
  done
}

[ $# -gt 0 ] || set -- address undefined thread memcheck helgrind
for sanitizer in "$@"; do
  start=$(date +%s)
  (
    echo "== $sanitizer"
    $sanitizer
  )
  echo "== $sanitizer: nothing found, $(($(date +%s) - start)) s"
done
