#!/usr/bin/env bash
# Builds CAF with our patch once per user, outside the checkout, and prints the
# prefix it is installed in.
#
# usage: build.sh [--prefix]    --prefix: only print it, build nothing
#
# The prefix is named after all that decides its content, so a changed patch or
# option builds anew. It appears by one rename: what exists is finished.
set -euo pipefail

version=0.18.7
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
patch=$here/caf-$version-sofof.patch
cache=${XDG_CACHE_HOME:-~/.cache}/sofof
options=(
  -DCMAKE_BUILD_TYPE=Release
  "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG"
  -DCMAKE_CXX_FLAGS=-w # its warnings are not ours to mend
  -DBUILD_SHARED_LIBS=OFF
  -DCMAKE_INSTALL_LIBDIR=lib
  -DCAF_ENABLE_EXAMPLES=OFF
  -DCAF_ENABLE_TESTING=OFF
  -DCAF_ENABLE_TOOLS=OFF
  -DCAF_ENABLE_OPENSSL_MODULE=OFF # TLS is network/tls
  -DCMAKE_UNITY_BUILD=ON # most time went into parsing the same headers
  -DCMAKE_UNITY_BUILD_BATCH_SIZE=12
)
recipe=$({ cat "$patch" && echo "${options[*]} $(uname -m)"; } | sha256sum)
prefix=$cache/caf-$version-${recipe:0:12}

if [[ ${1:-} == --prefix || -d $prefix ]]; then
  echo "$prefix"
  exit
fi

# One build at a time; who waited finds it done. The compilers inherit the
# lock, so that nobody cleans up under those of a killed build.
mkdir -p "$cache"
exec {lock}>"$cache/.lock"
flock "$lock"
if [[ ! -d $prefix ]]; then
  # Always the same folder: ccache knows an interrupted build again.
  work=$cache/.build
  rm -rf "$work"
  trap 'rm -rf "$work"' EXIT
  mkdir "$work"
  {
    tarball=$("$here/fetch.sh" "$cache/downloads")
    tar -xzf "$tarball" -C "$work" --strip-components=1
    patch --directory="$work" --strip=1 --no-backup-if-mismatch <"$patch"
    if command -v ccache >/dev/null; then
      options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    fi
    cmake -S "$work" -B "$work/build" -G Ninja "${options[@]}" \
      -DCMAKE_INSTALL_PREFIX="$prefix"
    ninja -C "$work/build"
    DESTDIR=$work/root cmake --install "$work/build" >"$work/install.log"
    install -D -m 644 "$work/LICENSE" "$work/root$prefix/share/doc/caf/LICENSE"
  } >&2
  mv -T "$work/root$prefix" "$prefix"
fi
echo "$prefix"
