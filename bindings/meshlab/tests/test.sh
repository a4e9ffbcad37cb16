#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The MeshLab plugin: its polygons, its filters in process, and its filters in an unmodified meshlabserver; at last what they cost. Run it at the
# root, after `cmake --build target/meshlab/build` with UMBILIC_MESHLAB_TESTS.
#
#   bindings/meshlab/tests/test.sh PYTHON MESHES
set -eu

python=$1
meshes=$2
built=$PWD/target/meshlab/build
plugin=$built/libfilter_umbilic.so
installed=$(dirname "$(dpkg-query --listfiles meshlab | grep '/libmeshlab-common\.so$')")

exported=$(nm -D --defined-only "$plugin" | awk '{print $3}' | sort | xargs)
if [ "$exported" != "qt_plugin_instance qt_plugin_query_metadata" ]; then
  echo "the plugin exports: $exported" >&2
  exit 1
fi

quietly() {
  QT_QPA_PLATFORM=offscreen "$@" 2>"$built/said" || { grep -v '^LOG' "$built/said" >&2; return 1; }
}
quietly "$built/polygons"
quietly "$built/filters" "$plugin"

# MeshLab looks for plugins beside its own program: a copy of it, into which the plugin is installed, leaves the system's alone.
copy=$PWD/target/meshlab/copy
rm -rf "$copy" target/meshlab/out
mkdir -p "$copy/usr/bin" "$copy$installed" target/meshlab/out
cp /usr/bin/meshlabserver "$copy/usr/bin/"
cp -R "$installed/." "$copy$installed/"
DESTDIR=$copy cmake --install "$built" --strip >/dev/null
xvfb-run -a "$python" -B bindings/meshlab/tests/server.py target/release/umbilic "$meshes" "$copy/usr/bin/meshlabserver" \
  target/meshlab/out

quietly "$built/timing" "$plugin" "$meshes/bunny00.off"
