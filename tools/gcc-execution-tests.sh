#!/usr/bin/env bash
# Runs GCC's execution tests on the emulated SPU: small programs that end with exit code 0 unless compiler, C library
# or simulator are wrong.
#
#   tools/gcc-execution-tests.sh [OPTIONS] PROGRAM
#
# PROGRAM is a built celltrace.
#   --levels "O0 O2"   optimization levels
#   --every N          only every Nth test
#   --jobs N           at the same time; all processors unless said otherwise
#   --limit CYCLES     a test that takes longer fails
#   --timeout SECONDS  so does one that takes longer here
#   --work FOLDER      keeps sources and compiled tests, so that the next run is quick; build/gcc-execution-tests
#   --compile-only     runs nothing; needs no PROGRAM
#
# Needs spu-elf-gcc (see tools/spu-compiler.sh); without one all is skipped. The sources are those of Debian's package
# gcc-12-source, installed or downloaded.
#
# Exit code 0: at least 99 % of the tests that compile pass, and each that fails is in gcc-execution-tests.expected
# with a reason. Lines there: NAME LEVELS REASON, where LEVELS is * or a list such as O0,O2.
set -euo pipefail

tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
expected=$tools/gcc-execution-tests.expected
package="gcc-12-source"
levels="O0 O2" every=1 jobs=$(nproc) limit=2000000000 timeout=120 compile_only=no program=
work=$tools/../build/gcc-execution-tests

usage() {
  sed -n '2,/^set/p' "${BASH_SOURCE[0]}" | sed -e '/^set/d' -e 's/^# \{0,1\}//'
}

while [ $# -gt 0 ]; do
  case $1 in
    --levels) levels=$2; shift ;;
    --every) every=$2; shift ;;
    --jobs) jobs=$2; shift ;;
    --limit) limit=$2; shift ;;
    --timeout) timeout=$2; shift ;;
    --work) work=$2; shift ;;
    --compile-only) compile_only=yes ;;
    --help) usage; exit 0 ;;
    -*) echo "$0: unknown option '$1'" >&2; exit 2 ;;
    *) program=$1 ;;
  esac
  shift
done
[ -n "$program" ] || [ $compile_only = yes ] || { usage >&2; exit 2; }

cxx=$("$tools/spu-compiler.sh")
[ -n "$cxx" ] || { echo "skipped: no compiler for the SPU"; exit 0; }
gcc=${cxx%g++}gcc

mkdir -p "$work"
work=$(cd "$work" && pwd)
sources=$work/sources

# --- the sources ------------------------------------------------------------------------------------------------------

# Leaves the package's archive of GCC's sources in the current directory.
find_archive() {
  if compgen -G "/usr/src/gcc-12/gcc-12.*.tar.xz" >/dev/null; then
    cp /usr/src/gcc-12/gcc-12.*.tar.xz .
  else
    apt-get download -q "$package" >&2
    dpkg-deb --fsys-tarfile "$package"_*.deb | tar -x --wildcards --strip-components=4 './usr/src/gcc-12/gcc-12.*.tar.xz'
  fi
}

fetch_sources() {
  local room
  room=$(mktemp -d "$work/download-XXXXXX")
  (
    cd "$room"
    find_archive
    tar -xf gcc-12.*.tar.xz --wildcards --no-wildcards-match-slash '*/gcc/testsuite/gcc.c-torture/execute/*.[ch]'
    mkdir all
    find . -path '*/execute/*.[ch]' -exec mv -t all {} +
  )
  mv "$room/all" "$sources"
  rm -rf "$room"
}

[ -d "$sources" ] || fetch_sources

# --- compiling --------------------------------------------------------------------------------------------------------

# Of the 256 KB: what tests take whose stack or data has a size of their choice, and what one can have at most.
chosen_bytes=$((128 * 1024)) most_bytes=$((200 * 1024))

# The options that a test asks for wherever it runs, not only on some targets.
options_of() {
  sed -nE 's/.*dg-(additional-)?options +(\{ *)?"([^"]*)"( *\})? *\}.*/\3/p' "$1" | tr '\n' ' '
  if grep -q 'dg-add-options stack_size' "$1"; then echo "-DSTACK_SIZE=$chosen_bytes"; fi
}

# Why a test cannot run on an SPU, or nothing.
obstacle_of() {
  local stack
  stack=$(sed -nE 's/.*dg-require-stack-size "([^"]*)".*/\1/p' "$1")
  if [ -n "$stack" ] && ((stack > most_bytes)); then echo "needs a stack of $((stack / 1024)) KB"; fi
}

# compile LEVEL SOURCE: leaves LEVEL/NAME.elf, or LEVEL/NAME.none with the reason.
compile() {
  local level=$1 source=$2 name base reason
  name=$(basename "$source" .c)
  base=$work/$level/$name
  if [ -e "$base.elf" ] || [ -e "$base.none" ]; then return; fi
  reason=$(obstacle_of "$source")
  if [ -z "$reason" ]; then
    # As GCC tests itself, with its own choice of a standard; some of the oldest tests keep to an older one.
    local standard options
    rm -f "$base.log"
    read -ra options <<<"$(options_of "$source")"
    for standard in gnu17 gnu89; do
      if "$gcc" -w "-$level" "-std=$standard" "${options[@]}" -I "$sources" "$source" -lm -o "$base.part" 2>>"$base.log"; then
        mv "$base.part" "$base.elf"
        rm "$base.log"
        return
      fi
    done
    reason=$(grep -m 1 -oE 'error: .*|undefined reference.*|ld: \..*' "$base.log" || echo "does not compile")
  fi
  echo "$reason" >"$base.none"
  rm -f "$base.log" "$base.part"
}

# A compiler that is another one makes other programs.
stamp=$("$gcc" --version | head -n 1)
for level in $levels; do
  if [ -d "$work/$level" ] && [ "$(cat "$work/$level/compiler" 2>/dev/null)" != "$stamp" ]; then
    rm -rf "${work:?}/$level"
  fi
  mkdir -p "$work/$level"
  echo "$stamp" >"$work/$level/compiler"
done

mapfile -t tests < <(find "$sources" -name '*.c' | LC_ALL=C sort | awk -v every="$every" 'NR % every == 0')

# each FUNCTION: calls it with every level and test, several at a time.
each() {
  local level
  for level in $levels; do
    printf '%s\n' "${tests[@]}" | awk -v level="$level" '{ print level; print }'
  done | xargs -d '\n' -n 2 -P "$jobs" bash -c "set -euo pipefail; $1 \"\$@\"" each
}

export work sources gcc program limit timeout chosen_bytes most_bytes
export -f options_of obstacle_of compile
each compile

# --- running ----------------------------------------------------------------------------------------------------------

# run LEVEL SOURCE: prints "LEVEL NAME passed", "... failed REASON" or "... none REASON".
run() {
  local level=$1 name code=0 output folder
  name=$(basename "$2" .c)
  if [ ! -e "$work/$level/$name.elf" ]; then
    echo "$level $name none $(cat "$work/$level/$name.none")"
    return
  fi
  output=$(mktemp)
  folder=$(mktemp -d) # for temporary files
  timeout -k 5 "$timeout" "$program" spu "$work/$level/$name.elf" --limit "$limit" --allow "$folder" --quiet \
    </dev/null >"$output" 2>&1 || code=$?
  case $code in
    0) echo "$level $name passed" ;;
    124 | 137) echo "$level $name failed takes more than $limit cycles or $timeout s" ;;
    *) echo "$level $name failed exit code $code: $(tail -n 1 "$output" | tr -cd '[:print:]' | cut -c 1-100)" ;;
  esac
  rm -rf "$output" "$folder"
}

export -f run
results=$work/results.txt
if [ $compile_only = yes ]; then
  for level in $levels; do
    echo "$level: $(find "$work/$level" -name '*.elf' | wc -l) compiled, $(find "$work/$level" -name '*.none' | wc -l) not"
  done
  exit 0
fi
each run | LC_ALL=C sort >"$results"

# --- the summary ------------------------------------------------------------------------------------------------------

awk -v expected="$expected" '
  function is_expected(level, name) {
    return (name, "*") in known || (name, level) in known
  }
  BEGIN {
    while ((getline line < expected) > 0) {
      if (line ~ /^(#|$)/) continue
      split(line, field, " ")
      count = split(field[2], levels, ",")
      for (i = 1; i <= count; ++i) known[field[1], levels[i]] = 1
    }
  }
  $3 == "none" { ++none; text = $0; sub(/ none /, ": ", text); skipped[none] = text; next }
  { ++compiled }
  $3 == "passed" { ++passed; if (is_expected($1, $2)) print "better than expected: " $1 " " $2 }
  $3 == "failed" {
    ++failed
    text = $0; sub(/ failed /, ": ", text)
    if (is_expected($1, $2)) text = text " (expected)"; else ++unexpected
    print "failed: " text
  }
  END {
    for (i = 1; i <= none; ++i) print "not compiled: " skipped[i]
    percentage = compiled > 0 ? 100 * passed / compiled : 0
    printf "%d tests, %d compiled, %.2f %% of those pass, %d failures not expected\n", \
      compiled + none, compiled, percentage, unexpected
    printf "%d passed, %d failed, %d skipped\n", passed, failed, none
    exit !(percentage >= 99 && unexpected == 0)
  }' "$results"
