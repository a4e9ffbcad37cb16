#!/bin/sh
# Unpacks the source of the MeshLab that Debian has, for its headers, and prints where.
#
#   bindings/meshlab/source.sh DIRECTORY
#
# The sources of apt are those of the system, asked for source packages, with lists in DIRECTORY: nothing of the system is altered, and no root
# is needed. A second run finds what the first one left.
set -eu

if [ $# -ne 1 ]; then
  echo "usage: $0 DIRECTORY" >&2
  exit 2
fi
mkdir -p "$1"
directory=$(cd "$1" && pwd)
source=$directory/source

if [ ! -d "$source" ]; then
  apt=$directory/apt
  mkdir -p "$apt/lists/partial" "$apt/cache"
  # shellcheck disable=SC2016 # apt fills these in
  apt-get indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' | sort -u > "$apt/sources.list"
  if [ ! -s "$apt/sources.list" ]; then
    echo "apt knows no packages of Debian: run \`apt-get update\` first" >&2
    exit 1
  fi
  own="-q -o Dir::Etc::sourcelist=$apt/sources.list -o Dir::Etc::sourceparts=- -o Dir::State::lists=$apt/lists -o Dir::Cache=$apt/cache
    -o APT::Sandbox::User=root"
  version=$(dpkg-query --show --showformat='${source:Version}' meshlab)
  scratch=$(mktemp -d "$directory/unpack.XXXXXX")
  trap 'rm -rf "$scratch"' EXIT
  cd "$scratch"
  # shellcheck disable=SC2086 # lists of words
  apt-get $own update >&2
  # shellcheck disable=SC2086
  apt-get $own source "meshlab=$version" >&2
  # Only a complete directory ever has its final name.
  mv meshlab-*/ "$source"
fi
echo "$source"
