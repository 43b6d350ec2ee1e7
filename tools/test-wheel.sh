#!/usr/bin/env bash
# Builds the wheel of this checkout as `pip install .` does, installs it in a new virtual environment that sees the
# system's NumPy, and runs tests/python against what is installed there.
#
#   tools/test-wheel.sh [PYTHON]
#
# Without a network: what builds it (setuptools, wheel) is the system's, as with --no-build-isolation.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

python=${1:-/usr/bin/python3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

start=$SECONDS
"$python" -m pip wheel -q --no-index --no-build-isolation --no-deps --wheel-dir "$work" .
echo "built in $((SECONDS - start)) s: $(cd "$work" && echo *.whl)"
"$python" -m zipfile -l "$work"/celltrace-*.whl
"$python" -m venv --system-site-packages "$work/venv"
"$work/venv/bin/pip" install -q --no-index --no-deps "$work"/celltrace-*.whl

cd "$work"
unset PYTHONPATH
"$work/venv/bin/python" -c 'import celltrace, pathlib, sys
folder = pathlib.Path(celltrace.__file__).parent
assert sys.prefix in str(folder), folder
print(celltrace.__version__, folder)'
"$work/venv/bin/python" -m pytest -q -p no:cacheprovider "$OLDPWD/tests/python"
