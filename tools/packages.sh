#!/usr/bin/env bash
# Installs the Debian 12 packages that are missing, or does nothing.
#   tools/packages.sh [program] [png] [tests] [bench]      groups of packages; default: program
# Needs root only when something is missing: as root it installs directly, else through sudo after saying what.
set -euo pipefail

program=(build-essential cmake ninja-build pkg-config libeigen3-dev libspectra-dev libhdf5-dev libvtk9-dev
         libtomlplusplus-dev libcli11-dev libfmt-dev libspdlog-dev nlohmann-json3-dev libhwy-dev)
png=(librsvg2-dev)  # nsframe plot writes PNG too
tests=(doctest-dev librapidcheck-dev python3)
bench=(libbenchmark-dev)

wanted=()
for group in "${@:-program}"; do
  case "$group" in
    program) wanted+=("${program[@]}") ;;
    png) wanted+=("${png[@]}") ;;
    tests) wanted+=("${tests[@]}") ;;
    bench) wanted+=("${bench[@]}") ;;
    *) echo "packages.sh: unknown group '$group'; known: program png tests bench" >&2; exit 2 ;;
  esac
done

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
  echo "packages.sh: not a Debian system; the build needs what these packages have: ${wanted[*]}" >&2
  exit 0
fi

missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ "${#missing[@]}" -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo > /dev/null; then
    echo "packages.sh: run this as root, then start again:" >&2
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing Debian packages${as_root[0]:+ with sudo}: ${missing[*]}"
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0)
"${apt[@]}" update < /dev/null
"${apt[@]}" install -y --no-install-recommends "${missing[@]}" < /dev/null > /dev/null
