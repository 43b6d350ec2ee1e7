# Finds calls that a code module could not return from: calls, direct or through other functions, of another
# module of the same region, which replaces the caller.
#
#   awk -f module_calls.awk SECTIONS SYMBOLS MAP
#
# SECTIONS is the output of `size -A` for the program, SYMBOLS that of `objdump -t`, MAP the linker's map with
# --stack-analysis, which lists all calls.

FILENAME == ARGV[1] { if ($1 ~ /^\.module\./) region[$1] = $3; next }
FILENAME == ARGV[2] { if (NF > 3 && $(NF - 2) ~ /^\.module\./) module[$NF] = $(NF - 2); next }
/^Stack size for functions/ { listed = 1; next }
listed && /^[^ ].*: 0x[0-9a-f]+ 0x[0-9a-f]+$/ { caller = $1; sub(/:$/, "", caller); callers[caller] = 1; next }
listed && /^   / { calls[caller] = calls[caller] " " $NF }

# Visits all functions that `name` calls, directly or not, on behalf of the module `home`.
function visit(name, home, path,    list, count, i, callee) {
  count = split(calls[name], list, " ")
  for (i = 1; i <= count; ++i) {
    callee = list[i]
    if ((callee in module) && module[callee] != home && region[module[callee]] == region[home]) {
      print home " calls " module[callee] " of its region: " path " > " callee
      failed = 1
    } else if (!((home, callee) in seen)) {
      seen[home, callee] = 1
      visit(callee, home, path " > " callee)
    }
  }
}

END {
  if (!listed) { print "no list of calls in " ARGV[3]; exit 1 }
  for (name in callers)
    if (name in module) visit(name, module[name], name)
  exit failed
}
