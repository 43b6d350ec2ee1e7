#!/usr/bin/env bash
# Renders a small picture of examples/scenes/first.pov on an emulated Cell and prints its statistics as JSON.
#
#   cell.sh [options of `celltrace render`, such as --spes 4 --cache 1x8]
#
# $SCENE is another scene, $CELLTRACE another program than the `celltrace` on the path. The picture is cell.png.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
exec "${CELLTRACE:-celltrace}" "${SCENE:-$here/../scenes/first.pov}" -W 128 -H 96 \
  --backend cell_emu --schedule lockstep --quiet -o cell.png --stats - "$@"
