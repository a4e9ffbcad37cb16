#!/bin/sh
# The header and the C and C++ programs of this folder, under two compilers, with the shared and the static library. Run it at
# the root, after `make target/release/libumbilic.so`.
set -eu

here=tests/c
library=target/release
built=target/c
strict="-Wall -Wextra -Wpedantic -Wconversion -Werror"
shared="-L$library -lumbilic -Wl,-rpath,$PWD/$library -lm -lpthread -ldl"
static="$library/libumbilic.a -lgcc_s -lutil -lrt -lpthread -lm -ldl -lc"
mkdir -p "$built"

# The header in every language version that it promises.
# shellcheck disable=SC2086 # lists of words, here and below
header() {
  "$@" $strict -Iinclude $here/header.c -o $built/header $shared
  $built/header
}
for compilers in "${CC:-cc} ${CXX:-c++}" "clang clang++"; do
  c=${compilers% *} cpp=${compilers#* }
  for standard in c99 c11 c17; do header "$c" -std=$standard; done
  for standard in c++11 c++14 c++17 c++20; do header "$cpp" -x c++ -std=$standard; done
  "$c" -std=c11 $strict -Iinclude -c $here/layout.c -o $built/layout.o
  "$c" -std=c99 $strict -Iinclude $here/header.c -o $built/header $static
  $built/header

  for program in normals corners segments curvatures refusals threads early_late old_header reload; do
    "$c" -std=c11 -O1 $strict -Iinclude $here/$program.c -o $built/$program $shared
  done
  "$cpp" -std=c++11 -O1 $strict -Iinclude $here/host.cpp -o $built/host $shared
  "$c" -std=c11 -O1 $strict -Iinclude $here/two_copies.c -o $built/two_copies $static
  # The same with the program's symbols in sight of the libraries that it opens: these must use their own all the same.
  "$c" -std=c11 -O1 $strict -Iinclude -rdynamic $here/two_copies.c -o $built/two_copies_in_sight $static
  for program in normals corners segments curvatures refusals threads early_late old_header host; do $built/$program; done
done

# A copy under another name, and a plugin of a host's own that the static library is linked into.
cp $library/libumbilic.so $built/libumbilic_copy.so
"${CC:-cc}" -shared -o $built/libplugin.so -Wl,-soname,libplugin.so \
  -Wl,--whole-archive $library/libumbilic.a -Wl,--no-whole-archive -lgcc_s -lutil -lrt -lpthread -lm -ldl -lc
for program in two_copies two_copies_in_sight; do
  $built/$program "$PWD/$library/libumbilic.so" "$PWD/$built/libumbilic_copy.so" "$PWD/$built/libplugin.so"
done
# The shared library asks to stay in memory until the process ends (build.rs says why); the plugin is unmapped every time.
$built/reload "$PWD/$library/libumbilic.so" 1000 stays
$built/reload "$PWD/$built/libplugin.so" 1000 goes
