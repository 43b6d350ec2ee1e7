#!/bin/sh
# Installs and removes, in a root of its own, packages that have nothing but what decides about /usr/bin/povray:
# celltrace's maintainer scripts and its link, and a povray with a file of that name, as Debian's has. Both have to
# be installable, in either order, and to go again.
#
#   povray_alternative.sh FOLDER_OF_SCRIPTS WORK_FOLDER
set -eu
scripts=$1
work=$2
rm -rf "$work"
mkdir -p "$work"

package() { # NAME, whose files are in $work/NAME
  mkdir -p "$work/$1/DEBIAN"
  cat > "$work/$1/DEBIAN/control" <<END
Package: $1
Version: ${2:-1}
Architecture: all
Maintainer: nobody <nobody@example.org>
Description: for a test
END
  dpkg-deb --root-owner-group -b "$work/$1" "$work/$1-${2:-1}.deb" > /dev/null
}
mkdir -p "$work/celltrace/DEBIAN" "$work/celltrace/usr/lib/celltrace" "$work/celltrace/usr/bin" "$work/povray/usr/bin"
echo celltrace > "$work/celltrace/usr/bin/celltrace"
ln -s ../../bin/celltrace "$work/celltrace/usr/lib/celltrace/povray"
install -m 755 "$scripts/postinst" "$scripts/prerm" "$work/celltrace/DEBIAN"
install -m 644 "$scripts/triggers" "$work/celltrace/DEBIAN"
echo povray > "$work/povray/usr/bin/povray"
package celltrace
package celltrace 2
package povray

root=$work/root
fresh() {
  rm -rf "$root"
  mkdir -p "$root/var/lib/dpkg/updates" "$root/var/lib/dpkg/info" "$root/var/lib/dpkg/triggers" \
    "$root/var/lib/dpkg/alternatives" "$root/etc/alternatives" "$root/var/log" "$root/usr/bin"
  : > "$root/var/lib/dpkg/status"
  : > "$root/var/lib/dpkg/available"
}
run_dpkg() {
  if ! dpkg --root="$root" --force-script-chrootless --force-not-root --log=/dev/null "$@" > "$work/log" 2>&1; then
    echo "dpkg $*:"
    cat "$work/log"
    exit 1
  fi
}
is() { # EXPECTED WHEN: whose /usr/bin/povray is
  found=none
  if [ -L "$root/usr/bin/povray" ]; then
    found=link-$(readlink "$root/usr/bin/povray")-$(readlink "$root/etc/alternatives/povray" || echo nothing)
  elif [ -e "$root/usr/bin/povray" ]; then
    found=$(cat "$root/usr/bin/povray")
  fi
  [ "$found" = "$1" ] || { echo "$2: /usr/bin/povray is $found, not $1"; cat "$work/log"; exit 1; }
}
ours=link-/etc/alternatives/povray-/usr/lib/celltrace/povray

fresh
run_dpkg -i "$work/celltrace-1.deb"
is $ours "celltrace alone"
run_dpkg -i "$work/celltrace-2.deb"
is $ours "an upgrade"
run_dpkg -i "$work/povray-1.deb"
is povray "povray after celltrace"
run_dpkg -i "$work/celltrace-2.deb"
is povray "celltrace again"
run_dpkg -r povray
is $ours "povray gone"
run_dpkg -r celltrace
is none "both gone"

fresh
run_dpkg -i "$work/povray-1.deb"
run_dpkg -i "$work/celltrace-1.deb"
is povray "celltrace after povray"
run_dpkg -r celltrace
is povray "celltrace gone"
run_dpkg -i "$work/celltrace-1.deb"
run_dpkg -i "$work/povray-1.deb"
run_dpkg -P celltrace
is povray "celltrace purged"
run_dpkg -P povray
is none "povray purged"

fresh
ln -s /opt/povray "$root/usr/bin/povray"
run_dpkg -i "$work/celltrace-1.deb"
is link-/opt/povray-nothing "an administrator's link"
run_dpkg -r celltrace
is link-/opt/povray-nothing "an administrator's link, celltrace gone"
echo "Installed and removed in either order."
