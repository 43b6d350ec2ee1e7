#!/usr/bin/env bash
# Makes the Debian packages libcelltrace0, libcelltrace-dev, celltrace and, where it can be built, python3-celltrace in
# build-packages, and has lintian look at them where it is installed. DEBFULLNAME and DEBEMAIL say who maintains them.
#
#   tools/make-packages.sh [more arguments for cmake]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/configure.sh release -B build-packages -DCMAKE_INSTALL_PREFIX=/usr -DBUILD_SHARED_LIBS=ON \
  -DCELLTRACE_TESTS=OFF -DCELLTRACE_BENCH=OFF -DCELLTRACE_EXAMPLES=OFF "$@"
cmake --build build-packages
rm -f build-packages/*.deb
(cd build-packages && cpack -G DEB)
if command -v lintian >/dev/null; then
  lintian --fail-on error build-packages/*.deb
else
  echo "No lintian: the packages were not checked." >&2
fi
