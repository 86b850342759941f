# What tests/acceptance/plug_in promises of the package for Debian; to be sourced
# by it.

# package_built: the program for any x86-64, and its package. Sets `package`.
package_built() {
  local folder=$root/build/package
  say "building the package: as long as a first build"
  (cd "$root" && cmake --preset package && cmake --build --preset package) \
    >"$root/build/package.log" 2>&1 || {
    tail -n 40 "$root/build/package.log" >&2
    return 1
  }
  (cd "$folder" && rm -f ./*.deb && cpack) >>"$root/build/package.log" 2>&1
  package=$(echo "$folder"/*.deb)
}

# lines_that_differ A B: of two text files of as many lines.
lines_that_differ() {
  paste -d '\n' "$1" "$2" | awk 'NR % 2 { a = $0; next } a != $0 { n++ }
    END { printf "%d of %d lines", n, NR / 2 }'
}

# in_debian NAME COMMANDS: what they print in a bare Debian 12 in which the
# package is then installed; $work/NAME.log has the rest.
in_debian() {
  mmdebstrap --variant=minbase --format=null \
    --customize-hook="copy-in $package /tmp" \
    --customize-hook='chroot "$1" sh -c "apt-get install -y \
      --no-install-recommends /tmp/*.deb >/tmp/apt.log 2>&1 \
      || { cat /tmp/apt.log >&2; exit 1; }"' \
    --customize-hook="chroot \"\$1\" sh -c '$2' >$work/$1.out" \
    --customize-hook="copy-out /tmp/results $work" \
    bookworm /dev/null 2>"$work/$1.log"
}

deb() {
  [[ ! $short ]] || return 0
  local package= said folder
  for said in "mmdebstrap" "lintian" "dpkg-shlibdeps dpkg-dev"; do
    # shellcheck disable=SC2086 # a command and its package
    bash "$root/.ci/install" $said >&2 || true
  done
  package_built || { line "package built" no yes false; return 0; }
  line "package built" "$(du -k "$package" | cut -f1) KiB" "built" \
    test -s "$package"
  said=$(lintian --fail-on error "$package" 2>&1 | grep -c '^E:' || true)
  zero "lintian: errors" "$said"
  "$program" run "$root/config/ulm_lehr.toml" --quiet --out "$work/source"
  if ! in_debian debian "cd /tmp && sofof run ulm_lehr --quiet && sofof --version \
      && test -s /usr/share/sofof/schemas/scenario.json && dpkg -r sofof \
      >/dev/null && ! test -e /usr/bin/sofof && ! test -e /usr/share/sofof \
      && echo gone"; then
    tail -n 5 "$work/debian.log" >&2
    if grep -q 'apt-get update\|E: Failed to fetch\|resolve' "$work/debian.log" \
      && [[ ! -s $work/debian.out ]]; then
      say "no Debian could be set up (is there a network?): not measured"
      counted "in a bare Debian 12" "not measured: no mirror"
      return 0
    fi
  fi
  line "in a bare Debian 12: installs, main job, gone again" \
    "$(tail -n 1 "$work/debian.out")" "gone" grep -q '^gone$' "$work/debian.out"
  folder=$work/results/ulm_lehr-1
  line "its main job: collisions" "$(field "$folder" safety.collisions)" 0 \
    [ "$(field "$folder" safety.collisions)" = 0 ]
  counted "cycles.csv, other than of a source build" \
    "$(lines_that_differ "$work/source/cycles.csv" "$folder/cycles.csv")"
}
