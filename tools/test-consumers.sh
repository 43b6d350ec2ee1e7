#!/usr/bin/env bash
# Builds celltrace from a copy of what git knows, shared and static, installs it, moves copy and build away, and has the
# projects of tests/consumers use what was installed. CTest does a shorter form of this with its own build.
#
#   tools/test-consumers.sh [shared|static]...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
top=$PWD
work=$top/build-consumers
kinds=("$@")
[ ${#kinds[@]} -gt 0 ] || kinds=(shared static)

consumer() { # FOLDER NAME ARGUMENTS...
  local folder=$1 name=$2
  shift 2
  echo "---- $kind: $name"
  cmake -DCONSUMER="$folder" -DWORK="$work/$kind/$name" -DCOMPILER="${CXX:-g++}" -DLAUNCHER="$launcher" \
    "$@" -P "$work/consumers/run.cmake" > "$work/$kind-$name.log" 2>&1 || { cat "$work/$kind-$name.log"; return 1; }
}

launcher=$(command -v ccache || true)
# The copy lies elsewhere than what the cache may have been filled from.
export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$top} CCACHE_NOHASHDIR=1
rm -rf "$work"
mkdir -p "$work/sources"
git ls-files -z --cached --others --exclude-standard | while IFS= read -r -d '' file; do
  [ -e "$file" ] && printf '%s\0' "$file"
done | xargs -0 cp --parents -t "$work/sources"
cp -r tests/consumers examples "$work"
for kind in "${kinds[@]}"; do
  shared=OFF
  [ "$kind" = shared ] && shared=ON
  prefix=$work/prefix-$kind
  mkdir -p "$work/$kind"
  (cd "$work/sources" && tools/configure.sh ci -B "build-$kind" -DBUILD_SHARED_LIBS=$shared \
    -DCELLTRACE_TESTS=OFF -DCELLTRACE_BENCH=OFF -DCELLTRACE_EXAMPLES=OFF && cmake --build "build-$kind")
  cmake -DBUILD="$work/sources/build-$kind" -DPREFIX="$prefix" "-DFORBIDDEN=$work/sources" \
    -P "$work/consumers/install.cmake"

  # The sources as part of another project, which compiles them.
  if [ "$kind" = static ]; then
    consumer "$work/consumers/subdirectory" subdirectory -DSOURCE="$work/sources" -DCOMPONENTS=celltrace \
      -DPROGRAM="$work/consumers/render/main.cpp" -DOPTIONS=-DCMAKE_BUILD_TYPE=Release
    consumer "$work/consumers/fetch" fetch -DSOURCE="$work/sources" -DCOMPONENTS=emulator,sdk \
      -DPROGRAM="$work/consumers/emulator/main.cpp" -DOPTIONS=-DCMAKE_BUILD_TYPE=Release
  fi

  mv "$work/sources" "$work/moved-away"
  for name in render emulator parts plugin; do
    consumer "$work/consumers/$name" "$name" -DPREFIX="$prefix"
  done
  consumer "$work/consumers/render" pkg-config -DPREFIX="$prefix" -DPKG_CONFIG=celltrace
  consumer "$work/consumers/emulator" pkg-config-sdk -DPREFIX="$prefix" -DPKG_CONFIG=celltrace-sdk
  consumer "$work/examples/render_scene" render_scene -DPREFIX="$prefix" -DTARGET=render_scene \
    "-DARGUMENTS=$work/examples/scenes/first.pov,picture.png"
  consumer "$work/examples/own_geometry" own_geometry -DPREFIX="$prefix" -DTARGET=own_geometry -DARGUMENTS=picture.png
  "$prefix/bin/celltrace" --version
  mv "$work/moved-away" "$work/sources"
done
rm -rf "$work"
echo "All consumers pass: ${kinds[*]}."
