#!/usr/bin/env bash
# Makes the documents as a site by MkDocs, with the reference of the public headers by Doxygen in its folder reference/.
# Warnings of either are errors; 77 where the one that is asked for is not installed.
#
#   tools/make-site.sh [site|reference|all] [FOLDER]       default: all, into out/site
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
part=${1:-all}
folder=$(realpath -m "${2:-out/site}")

needs() {
  command -v "$1" >/dev/null || { echo "skipped: there is no $1 (tools/install-dependencies.sh docs)"; exit 77; }
}

if [ "$part" != reference ]; then
  needs mkdocs
  mkdocs --quiet build --strict --clean --site-dir "$folder"
  echo "The site is $folder/index.html."
fi
if [ "$part" != site ]; then
  needs doxygen
  mkdir -p "$folder"
  { cat tools/site/Doxyfile; printf 'OUTPUT_DIRECTORY = "%s"\nHTML_OUTPUT = reference\n' "$folder"; } | doxygen -
  echo "The reference is $folder/reference/index.html."
fi
