#!/usr/bin/env bash
# Runs tools/packages.sh with stand-ins for dpkg-query, apt-get, id and sudo that record what they are asked.
set -euo pipefail
script=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
ln -s "$(command -v bash)" "$(command -v env)" "$folder/bin/"
log=$folder/log

stand_in() { printf '#!%s\n%s\n' "$(command -v bash)" "$2" > "$folder/bin/$1"; chmod +x "$folder/bin/$1"; }
# stand_in dpkg-query: everything is installed but what MISSING lists
stand_in dpkg-query 'for last; do :; done; case " $MISSING " in *" $last "*) exit 1 ;; *) printf installed ;; esac'
stand_in apt-get "echo apt-get \"\$@\" >> $log; [ \"\$DEBIAN_FRONTEND\" = noninteractive ]"
stand_in id 'echo "$USER_ID"'

# expect NAME EXIT_CODE LOG MESSAGE: runs with the environment set by the caller
expect() {
  local code=0 said
  : > "$log"
  said=$(PATH=$folder/bin "$(command -v bash)" "$script" "${groups[@]}" 2>&1 < /dev/null) || code=$?
  if [ "$code" != "$2" ] || [ "$(tr '\n' ';' < "$log")" != "$3" ] || [[ "$said" != *"$4"* ]]; then
    echo "$1: exit code $code, calls '$(tr '\n' ';' < "$log")', said '$said'"
    exit 1
  fi
}

export MISSING="" USER_ID=0
apt="apt-get -qq -o Dpkg::Use-Pty=0"
groups=(program tests bench)
expect "nothing missing" 0 "" ""
MISSING="ninja-build libhwy-dev doctest-dev"
groups=(program)
expect "as root" 0 "$apt update;$apt install -y --no-install-recommends ninja-build libhwy-dev;" "Installing"
groups=(program tests)
expect "tests too" 0 "$apt update;$apt install -y --no-install-recommends ninja-build libhwy-dev doctest-dev;" "doctest-dev"
groups=(programs)
expect "unknown group" 2 "" "unknown group 'programs'"
groups=()
USER_ID=1000
expect "no root, no sudo" 1 "" "apt-get install --no-install-recommends ninja-build libhwy-dev"
stand_in sudo "echo sudo >> $log; exec \"\$@\""
expect "through sudo" 0 "sudo;$apt update;sudo;$apt install -y --no-install-recommends ninja-build libhwy-dev;" "with sudo: ninja-build"
rm "$folder/bin/apt-get"
expect "not Debian" 0 "" "not a Debian system"
echo ok
