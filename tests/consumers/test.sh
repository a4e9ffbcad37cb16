#!/bin/sh
# What `make install` and `make deb` put in place, as those who use it see it: the files, programs in C and C++ that are built
# against them outside this tree, manual pages, completions; that `make uninstall` takes away no more and no less. Run it at the
# root, after `make build`.
set -eu

here=$PWD/tests/consumers
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# The scratch directory by its real name, as programs will tell it.
scratch=$(cd "$scratch" && pwd -P)
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml)

fail() {
  echo "$*" >&2
  exit 1
}

# Files and links below a directory.
listing() {
  (cd "$1" && find . -type l -printf '%P -> %l\n' -o ! -type d -printf '%P\n' | LC_ALL=C sort)
}

quiet_make() { ${MAKE:-make} --silent --no-print-directory "$@"; }

# The programs of this folder, against what is installed below a prefix, by both ways of finding it: all print the same.
consumers() {
  name=$1 prefix=$2 library=$3
  cp -r "$here" "$scratch/$name"
  PKG_CONFIG_LIBDIR=$library/pkgconfig quiet_make -C "$scratch/$name/pkg-config" all
  cmake -S "$scratch/$name/cmake" -B "$scratch/$name/cmake" -DCMAKE_PREFIX_PATH="$prefix" -DWANTED="$version" \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON > "$scratch/$name/cmake.log"
  cmake --build "$scratch/$name/cmake" > "$scratch/$name/cmake.log"
  ! grep -F "$PWD" "$scratch/$name/cmake/compile_commands.json" || fail "the source tree was used"
  for program in pkg-config/c-shared cmake/c-shared pkg-config/cpp-shared cmake/cpp-shared; do
    LD_LIBRARY_PATH=$library ldd "$scratch/$name/$program" | grep -qF "libumbilic.so.0 => $library/libumbilic.so.0 " ||
      fail "$name/$program: does not ask for $library/libumbilic.so.0"
  done
  for program in pkg-config/c-static cmake/c-static pkg-config/cpp-static cmake/cpp-static pkg-config/c-all-static \
    pkg-config/cpp-all-static; do
    ! ldd "$scratch/$name/$program" 2>&1 | grep umbilic || fail "$name/$program: asks for the shared library"
  done
  count=0
  for program in "$scratch/$name"/*/c-* "$scratch/$name"/*/cpp-*; do
    LD_LIBRARY_PATH=$library "$program" > "$scratch/printed.txt" || fail "$program: failed"
    [ "$(wc -l < "$scratch/printed.txt")" -eq 288 ] || fail "$program: prints something else"
    [ $count -gt 0 ] || mv "$scratch/printed.txt" "$scratch/first.txt"
    [ $count -eq 0 ] || cmp "$scratch/first.txt" "$scratch/printed.txt"
    count=$((count + 1))
  done
  [ $count -eq 10 ] || fail "$name: $count programs instead of 10"
  echo "$name: $count programs find the library and print the same bits"
}

# ---- make install ----

quiet_make install DESTDIR="$scratch/stage" PREFIX=/opt/umbilic > "$scratch/install.log"
sed "s/VERSION/$version/" "$here/installed.txt" > "$scratch/expected.txt"
listing "$scratch/stage/opt/umbilic" | diff "$scratch/expected.txt" - || fail "other files are installed than installed.txt lists"
[ "$(ls "$scratch/stage")" = opt ] || fail "something is installed outside the prefix"
! grep -r '@[A-Z]*@' "$scratch/stage/opt/umbilic/lib/cmake" "$scratch/stage/opt/umbilic/lib/pkgconfig" || fail "left open"

for prefix in "/opt/two words" opt/umbilic ""; do
  ! quiet_make install DESTDIR="$scratch/refused" PREFIX="$prefix" > "$scratch/refused.log" 2>&1 || fail "installed to PREFIX=$prefix"
  grep -q 'no absolute path' "$scratch/refused.log" || fail "PREFIX=$prefix: $(cat "$scratch/refused.log")"
done
[ -z "$(find "$scratch" -path "$scratch/refused*" ! -name refused.log)" ] || fail "something is installed to a place that is refused"
quiet_make install DESTDIR="$scratch/two words" PREFIX=/usr/ > "$scratch/install.log"
[ "$(PKG_CONFIG_LIBDIR="$scratch/two words/usr/lib/pkgconfig" pkg-config --variable=prefix umbilic)" = /usr ] || fail "PREFIX=/usr/ is not /usr"

# It is used where it was not installed to.
moved=$scratch/moved/to/umbilic
mkdir -p "$scratch/moved/to"
mv "$scratch/stage/opt/umbilic" "$moved"
[ "$("$moved/bin/umbilic" --version)" = "umbilic $version" ] || fail "umbilic --version"
consumers installed "$moved" "$moved/lib"

# ---- find_package ----

cmake -DTEMPLATE="$PWD/cmake/umbilicConfigVersion.cmake.in" -DSCRATCH="$scratch/versions" -P "$here/versions.cmake"
refused() {
  ! cmake -S "$scratch/installed/cmake" -B "$scratch/refused" -DCMAKE_PREFIX_PATH="$moved" -DWANTED="$1" > "$scratch/refused.log" 2>&1 ||
    fail "find_package(umbilic $1) has found $version"
  tr -s ' \n' ' ' < "$scratch/refused.log" | grep -qF "$2" || fail "find_package(umbilic $1): $(cat "$scratch/refused.log")"
}
refused "99.0" "version: $version"
refused "COMPONENTS;fast" "component fast is not installed"
cmake -S "$scratch/installed/cmake" -B "$scratch/components" -DCMAKE_PREFIX_PATH="$moved" -DWANTED="COMPONENTS;shared;static" \
  > "$scratch/components.log"
# Where a project has a target of this name already, its own stays.
mkdir "$scratch/own"
printf '%s\n' 'cmake_minimum_required(VERSION 3.18)' 'project(own LANGUAGES C)' 'add_library(own INTERFACE)' \
  'add_library(umbilic::umbilic ALIAS own)' 'find_package(umbilic REQUIRED)' > "$scratch/own/CMakeLists.txt"
cmake -S "$scratch/own" -B "$scratch/own/build" -DCMAKE_PREFIX_PATH="$moved" > "$scratch/own.log"
rm "$moved/lib/libumbilic.a"
refused "COMPONENTS;static" "component static is not installed"

# ---- manual pages and completions ----

for page in "$moved"/share/man/man1/*; do
  warnings=$(LC_ALL=C.UTF-8 man --warnings -l "$page" 2>&1 >/dev/null)
  [ -z "$warnings" ] || fail "$page: $warnings"
done
# As an interactive shell does at the first Tab: the script is looked up by the name of the command.
completed=$(XDG_DATA_DIRS=$moved/share bash --norc -c '
  . /usr/share/bash-completion/bash_completion
  _completion_loader umbilic
  COMP_WORDS=(umbilic segment --smallest) COMP_CWORD=2 COMP_LINE="umbilic segment --smallest"
  $(complete -p umbilic | sed "s/.*-F \([^ ]*\).*/\1/") umbilic --smallest segment
  echo "${COMPREPLY[@]}"')
case $completed in *--smallest-share*) ;; *) fail "bash completes nothing: $completed" ;; esac
for shell in zsh fish; do
  ! command -v $shell >/dev/null || $shell -n "$moved"/share/$shell/*/*umbilic* || fail "$shell: completions do not parse"
done

# ---- make uninstall ----

quiet_make install DESTDIR="$scratch/stage" PREFIX=/opt/umbilic > "$scratch/install.log"
touch "$scratch/stage/opt/umbilic/include/umbilic/other.h" "$scratch/stage/opt/umbilic/lib/libumbilic_other.so.0"
quiet_make uninstall DESTDIR="$scratch/stage" PREFIX=/opt/umbilic > "$scratch/install.log"
listing "$scratch/stage" > "$scratch/left.txt"
printf '%s\n' opt/umbilic/include/umbilic/other.h opt/umbilic/lib/libumbilic_other.so.0 | diff - "$scratch/left.txt" ||
  fail "uninstall has removed what was not installed, or left what was"
[ ! -e "$scratch/stage/opt/umbilic/lib/cmake/umbilic" ] || fail "uninstall has left a directory"

# ---- make deb ----

maintainer="Miles O'Brien / packaging"
DEBFULLNAME=$maintainer DPKG_DEB_COMPRESSOR_LEVEL=1 quiet_make deb DEBIAN="$scratch/packages" > "$scratch/deb.log" 2>&1 || fail "$(cat "$scratch/deb.log")"
sed -n '/^[EW]: /p' "$scratch/deb.log"
for package in "$scratch"/packages/*.deb; do dpkg-deb --extract "$package" "$scratch/unpacked"; done
[ "$(dpkg-deb --field "$scratch"/packages/umbilic_*.deb Maintainer)" = "$maintainer <${DEBEMAIL:-umbilic@localhost}>" ] || fail "maintainer"
architecture=$(dpkg-architecture -q DEB_HOST_MULTIARCH)
dpkg-deb --field "$scratch"/packages/libumbilic0_*.deb Depends | grep -q 'libc6 (>=' || fail "libumbilic0 does not depend on libc6"
dpkg-deb --info "$scratch"/packages/libumbilic0_*.deb shlibs | grep -qF "libumbilic 0 libumbilic0 (>= $version)" || fail "shlibs"
dpkg-deb --info "$scratch"/packages/libumbilic0_*.deb triggers | grep -q '^activate-noawait ldconfig' || fail "no ldconfig"
# Compilers need not be told of directories below /usr; here these stand elsewhere, like the system of another machine.
[ "$(PKG_CONFIG_LIBDIR=$scratch/unpacked/usr/lib/$architecture/pkgconfig pkg-config --cflags --libs umbilic | tr -d ' ')" = -lumbilic ] ||
  fail "pkg-config names the system's own directories"
export PKG_CONFIG_SYSROOT_DIR="$scratch/unpacked" PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 PKG_CONFIG_ALLOW_SYSTEM_LIBS=1
consumers debian "$scratch/unpacked/usr" "$scratch/unpacked/usr/lib/$architecture"

# The examples come along, and find the library by themselves.
examples=$scratch/unpacked/usr/share/doc/libumbilic-dev/examples
cmake -S "$examples" -B "$scratch/examples" -DCMAKE_PREFIX_PATH="$scratch/unpacked/usr" > "$scratch/examples.log"
cmake --build "$scratch/examples" --target normals > "$scratch/examples.log"
LD_LIBRARY_PATH=$scratch/unpacked/usr/lib/$architecture "$scratch/examples/normals" > "$scratch/examples.log"
