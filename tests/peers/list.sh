#!/bin/sh
# Prints the meshes of meshes.txt, as paths in the directory given.
set -eu
sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$(dirname "$0")/meshes.txt" | sed -e "s|^|$1/|"
