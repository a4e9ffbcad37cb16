#!/bin/sh
# Fetches the meshes of Debian's package libcgal-demo into a directory, and prints where they are.
#
#   tests/peers/meshes.sh DIRECTORY
#
# Nothing is installed, and no root is needed. A second run finds what the first one left.
set -eu

if [ $# -ne 1 ]; then
  echo "usage: $0 DIRECTORY" >&2
  exit 2
fi
mkdir -p "$1"
directory=$(cd "$1" && pwd)
meshes=$directory/meshes

if [ ! -d "$meshes" ]; then
  scratch=$(mktemp -d "$directory/unpack.XXXXXX")
  trap 'rm -rf "$scratch"' EXIT
  cd "$scratch"
  apt-get -q download libcgal-demo >&2
  dpkg -x libcgal-demo_*.deb .
  tar -xzf usr/share/doc/libcgal-dev/data.tar.gz data/meshes
  # Only a complete directory ever has its final name.
  mv data/meshes "$meshes"
fi
echo "$meshes"
