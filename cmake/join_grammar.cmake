# Writes OUTPUT, one grammar of the PARTS (separated by |) in their order. bison and the compiler name the parts.
string(REPLACE "|" ";" parts "${PARTS}")
set(grammar "")
foreach(part IN LISTS parts)
  file(READ "${part}" text)
  string(APPEND grammar "#line 1 \"${part}\"\n${text}")
endforeach()
file(WRITE "${OUTPUT}" "${grammar}")
