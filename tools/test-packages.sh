#!/usr/bin/env bash
# Installs the packages that tools/make-packages.sh has made into a bare Debian 12, each with nothing but what it depends
# on, and uses them: the program, the Python package, and projects of tests/consumers by CMake and by pkg-config. Needs
# root and debootstrap, and says that it is skipped where they are missing.
#
#   tools/test-packages.sh [FOLDER]
#
# The bare system is kept in FOLDER/base, by default build-packages/bare, for the next run. DEBIAN_MIRROR says where it
# comes from, unless that is debootstrap's choice.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

skip() {
  echo "Skipped: $*" >&2
  exit 0
}
[ "$(id -u)" -eq 0 ] || skip "only root can install a system into a folder."
command -v debootstrap >/dev/null || skip "there is no debootstrap."
compgen -G "build-packages/celltrace_*.deb" >/dev/null || { echo "First: tools/make-packages.sh" >&2; exit 1; }

folder=${1:-build-packages/bare}
root=$folder/system
mkdir -p "$folder"
if [ ! -d "$folder/base" ]; then
  rm -rf "$folder/unfinished"
  debootstrap --variant=minbase bookworm "$folder/unfinished" ${DEBIAN_MIRROR:+"$DEBIAN_MIRROR"} > "$folder/debootstrap.log"
  mv "$folder/unfinished" "$folder/base"
fi
rm -rf "$root"
cp -a --reflink=auto "$folder/base" "$root"
mkdir "$root/celltrace"
cp -r build-packages/*.deb tests/consumers examples "$root/celltrace"

say() {
  echo "---- $*"
}
add() {
  say "apt-get install $*"
  apt-get install -y -q --no-install-recommends "$@"
}
consumer() { # FOLDER ARGUMENTS...
  say "consumer $*"
  cmake -DCONSUMER=/celltrace/consumers/"$1" -DWORK=/celltrace/work -DCOMPILER=g++ -DPREFIX=/usr "${@:2}" -P consumers/run.cmake
}

use_packages() {
  cd /celltrace
  apt-get update -q

  add ./celltrace_*.deb
  celltrace --version
  local backend name
  for backend in native cell_emu; do
    celltrace render --backend "$backend" -W 80 -H 60 -o "$backend.png" examples/scenes/first.pov
  done
  cmp native.png cell_emu.png
  say "in place of povray, with Debian's package and without it"
  whose_povray() { # WORD in what its --version says
    povray --version 2>&1 | grep "$1" >/dev/null
    PATH=/usr/lib/celltrace:$PATH povray --version 2>&1 | grep celltrace >/dev/null
  }
  whose_povray celltrace
  povray +Iexamples/scenes/first.pov +W80 +H60 +Opovray.png
  cmp native.png povray.png
  add povray
  whose_povray Persistence
  apt-get purge -y -q celltrace
  povray --version 2>&1 | grep Persistence >/dev/null
  add ./celltrace_*.deb
  whose_povray Persistence
  apt-get purge -y -q povray
  whose_povray celltrace
  say "a window without SDL2, which is recommended only"
  if DISPLAY=:0 celltrace view examples/scenes/first.pov 2> view.log; then false; fi
  grep "a window needs SDL2" view.log

  add ./libcelltrace0_*.deb ./python3-celltrace_*.deb
  say "a picture by Python"
  python3 -c 'if True:
    import celltrace
    pixels = celltrace.render("examples/scenes/first.pov", width=80, height=60)
    assert pixels.shape == (60, 80, 4)
    assert (pixels == celltrace.load("native.png")).all()'

  add ./libcelltrace-dev_*.deb cmake g++ ninja-build pkg-config
  for name in render emulator parts plugin; do
    consumer "$name"
  done
  consumer render -DPKG_CONFIG=celltrace
  consumer emulator -DPKG_CONFIG=celltrace-sdk

  say "what is left when the packages are gone"
  apt-get purge -y -q libcelltrace0 libcelltrace-dev celltrace python3-celltrace
  rm -r /celltrace
  if find / -xdev -name '*celltrace*' | grep .; then false; fi
}

# What it mounts and runs ends with it.
unshare --mount --pid --fork --mount-proc="$root/proc" chroot "$root" \
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
  bash -euo pipefail -c "$(declare -f say add consumer use_packages); use_packages" < /dev/null
rm -rf "$root"
echo "The packages work in a bare Debian 12."
