#!/usr/bin/env bash
# Gets CAF's source tarball, verified, and prints where it lies.
#
# usage: fetch.sh FOLDER    where to keep it
#   SOFOF_CAF_TARBALL=FILE  use this file instead of the network
#   SOFOF_CAF_SHA256=SUM    trust this checksum instead of the pinned one
#
# Sources, in this order: the given file, an earlier download, the Debian
# mirror this machine uses (experimental has 0.18.7), the project's own
# archive. The last two are the same bytes, so one checksum guards both.
set -euo pipefail

version=0.18.7
debian_version=$version-1~exp1
tarball=actor-framework_$version.orig.tar.gz
archive=https://github.com/actor-framework/actor-framework/archive/$version.tar.gz
# Debian's signed index and Homebrew's formula for caf 0.18.7 agree on it.
pinned=d5c3abe8fd67a729aab1baeece10367637d903ba335f4c79378bcadfbcd34552
wanted=${SOFOF_CAF_SHA256:-$pinned}

die() {
  printf 'sofof: %s\n' "$*" >&2
  exit 1
}

verified() { echo "$wanted  $1" | sha256sum --check --status 2>/dev/null; }

# Stops with one sentence unless the file is what we expect.
insist() {
  verified "$1" && return
  local found
  found=$(sha256sum "$1" | cut -d ' ' -f 1)
  die "$1 is not the CAF $version we know (sha256 $found, not $wanted)." \
    "If you checked it yourself, say so: SOFOF_CAF_SHA256=$found ./sofof"
}

# The mirror among the machine's own apt sources, never its -security sibling.
debian_mirror() {
  cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null |
    sed 's/#.*//' | grep -oE '[a-z+]+:[^][ ]+/debian/?( |$)' |
    sed -n '1s/ *$//p' || true
}

# Asks apt for the tarball in folders of its own: the machine's suites stay as
# they are, nothing is installed, and apt checks the signed index.
from_debian() {
  local keyring=/usr/share/keyrings/debian-archive-keyring.gpg mirror apt
  mirror=$(debian_mirror)
  [[ $mirror && -r $keyring ]] && command -v apt-get >/dev/null || return 1
  mkdir -p "$work"/{sources,lists/partial,cache/archives/partial}
  cat >"$work/sources/caf.sources" <<END
Types: deb-src
URIs: $mirror
Suites: experimental
Components: main
Signed-By: $keyring
END
  # An old index of experimental is good enough: the checksum is pinned.
  # Without --tar-only apt also wants the packaging, which mirrors may lack.
  apt=(apt-get -qq -o Dir::Etc::sourcelist=/dev/null
    -o "Dir::Etc::sourceparts=$work/sources" -o "Dir::State::lists=$work/lists"
    -o "Dir::Cache=$work/cache" -o Acquire::Languages=none
    -o Acquire::Check-Valid-Until=false -o APT::Sandbox::User=root
    -o Acquire::Retries=3)
  "${apt[@]}" update >&2 &&
    (cd "$work" && "${apt[@]}" source --tar-only --download-only \
      "actor-framework=$debian_version" >&2) &&
    [[ -f $work/$tarball ]]
}

from_upstream() {
  echo "file(DOWNLOAD $archive $work/$tarball STATUS status)
    list(GET status 0 code)
    if(code)
      message(FATAL_ERROR \"$archive: \${status}\")
    endif()" >"$work/download.cmake"
  cmake -P "$work/download.cmake" >&2
}

if [[ ${SOFOF_CAF_TARBALL:-} ]]; then
  [[ -r $SOFOF_CAF_TARBALL ]] || die "cannot read $SOFOF_CAF_TARBALL."
  insist "$SOFOF_CAF_TARBALL"
  realpath "$SOFOF_CAF_TARBALL"
  exit
fi

mkdir -p "${1:?usage: fetch.sh FOLDER}"
folder=$(realpath "$1")
if ! verified "$folder/$tarball"; then
  work=$(mktemp -d "$folder/.fetch-XXXXXX")
  trap 'rm -rf "$work"' EXIT
  from_debian || from_upstream ||
    die "neither the Debian mirror nor $archive answers." \
      "Fetch it elsewhere and start with SOFOF_CAF_TARBALL=FILE."
  mv "$work/$tarball" "$folder/$tarball.unverified" # to look at, if refused
  insist "$folder/$tarball.unverified"
  mv "$folder/$tarball.unverified" "$folder/$tarball"
fi
echo "$folder/$tarball"
