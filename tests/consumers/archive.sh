#!/bin/sh
# The archive of `make dist`, unpacked elsewhere, without network and without anything that cargo has fetched before: it has to be the same
# bytes each time, and is checked by the compiler; with the word `build` it is built, installed, and its program run. Run it at the root.
set -eu

# In what was unpacked from such an archive there is nothing to make one of.
if [ ! -e .git ]; then
  echo "No git repository here: the source archive is not checked."
  exit 0
fi
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml)
archive=target/dist/umbilic-$version.tar.gz
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

for time in first second; do
  ${MAKE:-make} dist > "$scratch/dist.log" 2>&1 || { cat "$scratch/dist.log"; exit 1; }
  sha256sum "$archive" > "$scratch/$time"
done
cmp "$scratch/first" "$scratch/second"

tar --extract --file="$archive" --directory="$scratch"
cd "$scratch/umbilic-$version"
mkdir "$scratch/cargo"
export CARGO_HOME="$scratch/cargo" CARGO_NET_OFFLINE=true
if [ "${1:-}" = build ]; then
  ${MAKE:-make} build
  ${MAKE:-make} --silent install DESTDIR="$scratch/stage" PREFIX=/usr > "$scratch/install.log"
  [ "$("$scratch/stage/usr/bin/umbilic" --version)" = "umbilic $version" ]
else
  # Resolves every crate that is asked for anywhere, and compiles those of the library.
  ${CARGO:-cargo} metadata --locked --format-version 1 > "$scratch/metadata.json"
  ${CARGO:-cargo} check --quiet --locked --lib
fi
echo "$(basename "$archive"): the same bytes twice, complete"
