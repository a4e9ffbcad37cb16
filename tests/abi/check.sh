#!/bin/sh
# Compares the binary interface of today with that of version 0.1.0, kept beside this script: its header, and what abidw makes of
# it. `check.sh LIBRARY` fails on a break; `check.sh LIBRARY update` keeps the interface of today instead, which is right only
# until 0.1.0 is released.
#
# What is described is a library of stubs made from the header, in C: so the description has the names that C programs see. One of
# the library's own debug information has the paths of Rust modules and the inside of handles as well, which are nobody's
# business. That the header is what the library does is for tests/header.rs and tests/abi.rs to say.
set -eu

library=$1
here=tests/abi
kept_header=$here/umbilic-0.1.0.h
kept=$here/libumbilic.so.0.abi
built=target/abi
mkdir -p "$built"

# Every function of a header with a body.
stubs() {
  sed '/^UMB_API/,/);$/ s/);$/) { __builtin_trap(); }/' "$1" > "$built/stubs.c"
  "${CC:-cc}" -std=c11 -g -O0 -fPIC -shared -Wl,-soname,libumbilic.so.0 "$built/stubs.c" -o "$built/stubs.so"
  abidw --no-corpus-path --no-comp-dir-path --no-show-locs --no-elf-needed --no-architecture --type-id-style hash \
    "$built/stubs.so" | sed "s|path='[^']*stubs.c'|path='umbilic.h'|"
}

stubs include/umbilic.h > "$built/present.abi"

# abidw says nothing if it finds no debug information: then everything would agree with everything.
functions=$(grep -c '<function-decl' "$built/present.abi" || true)
if [ "$functions" -eq 0 ] || ! grep -q "<class-decl name='umb_points'" "$built/present.abi"; then
  echo "The description of the interface has only $functions functions: nothing is checked." >&2
  exit 1
fi

if [ "${2:-}" = update ]; then
  cp include/umbilic.h "$kept_header"
  cp "$built/present.abi" "$kept"
  echo "Kept as version 0.1.0: $kept_header and $kept"
  exit
fi

status=0
# The two kept files belong together.
stubs "$kept_header" > "$built/kept.abi"
abidiff "$built/kept.abi" "$kept" || { echo "$kept is not what abidw makes of $kept_header" >&2; status=1; }

# Types and functions. Functions may be added, and fields at the end of structs that start with their size.
"${PYTHON:-python3}" -B $here/without_new_fields.py "$kept" "$built/present.abi" > "$built/known.abi"
abidiff --no-added-syms "$kept" "$built/known.abi" || status=1

# Symbols and soname of the library itself, which has no debug information.
abidw --no-corpus-path --no-elf-needed --no-architecture "$library" > "$built/library.abi"
abidiff --no-added-syms "$kept" "$built/library.abi" || status=1

# What a description does not hold: the numbers of constants.
grep -q '^#define UMB_ERROR_INTERNAL 900' "$kept_header" || { echo "There are no constants to compare." >&2; status=1; }
sed -n 's/^#define \(UMB_[A-Z0-9_]* [-0-9A-Z_]*\)$/\1/p' "$kept_header" | grep -v '^UMB_\(VERSION_\|API \|NODISCARD \)' |
  while read -r constant; do
    grep -qx "#define $constant" include/umbilic.h || { echo "gone or changed: $constant" >&2; exit 1; }
  done || status=1

if [ $status -eq 0 ]; then
  echo "The binary interface holds all of version 0.1.0: $functions functions, the same structs and constants."
fi
exit $status
