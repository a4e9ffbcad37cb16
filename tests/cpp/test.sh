#!/bin/sh
# The C++ headers and their tests, under two compilers, in C++17 and C++20; the wrapper also under sanitizers and without exceptions. Run it at
# the root, after `make target/release/libumbilic.so`. LIBRARY names another directory with the library.
set -eu

here=tests/cpp
library=${LIBRARY:-$PWD/target/release}
built=target/cpp
strict="-O1 -Wall -Wextra -Wpedantic -Wconversion -Werror -Iinclude"
link="-L$library -lumbilic -Wl,-rpath,$library -lpthread"
mkdir -p "$built"

# shellcheck disable=SC2086 # lists of words, here and below
test_program() {
  program=$1
  shift
  "$@" $strict $here/$program.cpp -o $built/$program $link $libraries
  $built/$program
}
# Hosts' headers are found as the system's, so warnings are of ours alone.
libraries=
for compiler in "${CXX:-c++}" clang++; do
  for standard in c++17 c++20; do
    test_program wrapper "$compiler" -std=$standard
    test_program values "$compiler" -std=$standard -fno-exceptions -fno-rtti
    test_program eigen "$compiler" -std=$standard -isystem /usr/include/eigen3
  done
done
# Parts with and without exceptions in one program, the latter first, whose functions the linker would take for both.
# shellcheck disable=SC2086
"${CXX:-c++}" -std=c++17 $strict -fno-inline -fno-exceptions -c $here/mixed.cpp -o $built/mixed.o
test_program mixed "${CXX:-c++}" -std=c++17 -fno-inline $built/mixed.o
# The README's.
sed -n '/^```cpp$/,/^```$/p' README.md | grep -v '^```' > $built/readme.cpp
# shellcheck disable=SC2086
"${CXX:-c++}" -std=c++17 $strict -c $built/readme.cpp -o $built/readme.o
# Each of these takes half a minute to compile.
for compiler in "${CXX:-c++} -std=c++17" "clang++ -std=c++20"; do
  libraries="-lOpenMeshCore -lOpenMeshTools"
  test_program openmesh $compiler
  libraries="-lgmp -lmpfr"
  test_program cgal $compiler
done
libraries=
test_program wrapper "${CXX:-c++}" -std=c++17 -g -fsanitize=address,undefined -fno-sanitize-recover=all
libraries="-lOpenMeshCore -lOpenMeshTools"
test_program openmesh "${CXX:-c++}" -std=c++17 -g -fsanitize=address,undefined -fno-sanitize-recover=all
