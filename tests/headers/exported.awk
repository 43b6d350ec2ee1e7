# Fails if a function that a public header declares and does not define is hidden in a shared library:
#
#   awk -f exported.awk HEADERS...
#
# By the format of headers: what begins in the first column with a type and a name is a function; a body begins on the
# line on which the parameters end.
function finish() {
  if (declaration == "") return
  if (declaration ~ /CELLTRACE_EXPORT/) ++exported
  else { print place ": not exported: " declaration; failed = 1 }
  declaration = ""
}
FNR == 1 { declaration = "" }
declaration != "" { declaration = declaration " " $0 }
declaration == "" && /^[A-Za-z][A-Za-z0-9_:<>,&* ]*( |$)/ &&
    !/^(inline|constexpr|template|static|friend|using|struct|class|enum|union|namespace|typedef|public|protected|private|FieldList)/ &&
    before !~ /^template/ {
  declaration = $0
  place = FILENAME ":" FNR
}
# A class with a member that is defined elsewhere.
/^(class|struct) [A-Z].*[{]$/ && before !~ /^template/ { type = $0 ~ /CELLTRACE_EXPORT/ ? "" : $0 }
/^}/ { type = "" }
type != "" && /^  [A-Za-z~][^{]*\)( const)?( noexcept)?;$/ && !/^  (using|friend|static_assert|return)|\/\/|operator/ {
  print FILENAME ":" FNR ": not exported: " type
  type = ""
  failed = 1
}
declaration ~ /[{]$/ { declaration = "" }
declaration ~ /;( *\/\/.*)?$/ {
  if (declaration ~ /\(/) finish()
  declaration = ""
}
{ before = $0 }
END {
  if (exported < 20) { print "only " exported + 0 " functions were found"; failed = 1 }
  exit failed
}
